// SPDX-License-Identifier: LGPL-2.1-or-later
// A pipe (radii 2.5 and 4) with three round fins. With -order 2, mid-side nodes lie on the curved skin.
SetFactory("OpenCASCADE");
DefineConstant[ size = 1 ];
Cylinder(1) = {0, 0, 0, 0, 0, 14, 4};
Cylinder(2) = {0, 0, 3, 0, 0, 1.2, 7};
Cylinder(3) = {0, 0, 6.4, 0, 0, 1.2, 7};
Cylinder(4) = {0, 0, 9.8, 0, 0, 1.2, 7};
BooleanUnion(5) = { Volume{1}; Delete; }{ Volume{2:4}; Delete; };
Cylinder(6) = {0, 0, -1, 0, 0, 16, 2.5};
BooleanDifference(7) = { Volume{5}; Delete; }{ Volume{6}; Delete; };

Physical Volume("PIPE") = {7};
Physical Surface("INLET") = Surface In BoundingBox{-4.1, -4.1, -0.1, 4.1, 4.1, 0.1};

Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.HighOrderOptimize = 2;
