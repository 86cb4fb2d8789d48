// SPDX-License-Identifier: LGPL-2.1-or-later
// An L: arm 12 x 4 x 4 along x and arm 4 x 4 x 12 along z, three glued blocks, one re-entrant edge.
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.75, algorithm = 1 ];
Box(1) = {0, 0, 0, 4, 4, 4};
Box(2) = {4, 0, 0, 8, 4, 4};
Box(3) = {0, 0, 4, 4, 4, 8};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; }

Physical Volume("KNEE") = {1};
Physical Volume("ARM_X") = {2};
Physical Volume("ARM_Z") = {3};
Physical Volume("LOWER") = {1, 2};
Physical Volume("UPPER") = {1, 3};
Physical Surface("FIX") = Surface In BoundingBox{-0.1, -0.1, 11.9, 4.1, 4.1, 12.1};
Physical Surface("LOAD") = Surface In BoundingBox{11.9, -0.1, -0.1, 12.1, 4.1, 4.1};
Physical Surface("INNER") = {Surface In BoundingBox{3.9, -0.1, 3.9, 12.1, 4.1, 4.1},
                             Surface In BoundingBox{3.9, -0.1, 3.9, 4.1, 4.1, 12.1}};
Physical Curve("NOTCH") = Curve In BoundingBox{3.9, -0.1, 3.9, 4.1, 4.1, 4.1};
Physical Point("TIP") = Point In BoundingBox{11.9, -0.1, -0.1, 12.1, 4.1, 4.1};

Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.Algorithm3D = algorithm;
Mesh.SaveGroupsOfNodes = 1;
