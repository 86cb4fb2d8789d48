// SPDX-License-Identifier: LGPL-2.1-or-later
// An angle bracket: two plates with a fillet between them, a bore with a boss in the one, two screw holes in the other.
// With -order 2, mid-side nodes lie on the curved skin.
SetFactory("OpenCASCADE");
DefineConstant[ size = 1 ];
Box(1) = {0, 0, 0, 20, 12, 3};
Box(2) = {0, 0, 0, 3, 12, 16};
Cylinder(3) = {13, 6, 0, 0, 0, 5, 4};
Box(4) = {2.9, 0, 2.9, 2.6, 12, 2.6};
Cylinder(5) = {5.5, -1, 5.5, 0, 14, 0, 2.5};
corner[] = BooleanDifference{ Volume{4}; Delete; }{ Volume{5}; Delete; };
body[] = BooleanUnion{ Volume{1}; Delete; }{ Volume{2, 3, corner[0]}; Delete; };
Cylinder(12) = {13, 6, -1, 0, 0, 7, 2.2};
Cylinder(13) = {-1, 3, 12, 5, 0, 0, 1.2};
Cylinder(14) = {-1, 9, 12, 5, 0, 0, 1.2};
part[] = BooleanDifference{ Volume{body[]}; Delete; }{ Volume{12:14}; Delete; };

Physical Volume("BRACKET") = {part[]};
Physical Surface("FOOT") = Surface In BoundingBox{-0.1, -0.1, -0.1, 20.1, 12.1, 0.1};
Physical Surface("BORE") = Surface In BoundingBox{10.7, 3.7, -0.1, 15.3, 8.3, 5.1};
Physical Surface("SCREWS") = Surface In BoundingBox{-0.1, 1.7, 10.7, 3.1, 10.3, 13.3};

Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.HighOrderOptimize = 2;
