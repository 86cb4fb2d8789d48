// SPDX-License-Identifier: LGPL-2.1-or-later
// Two glued boxes 10 x 10 x 10 along x. The defaults give the property tests' mesh of about 5 k tetrahedra, the same on
// every run. The reference meshes of the quality and speed figures come from HXT, which is not repeatable to the last
// element:
//   -setnumber algorithm 10 -setnumber size 0.6     39.2 k tetrahedra
//   -setnumber algorithm 10 -setnumber size 0.25   505 k
//   -setnumber algorithm 10 -setnumber size 0.145    2.5 M
SetFactory("OpenCASCADE");
DefineConstant[ size = 1.25, algorithm = 1 ];
Box(1) = {0, 0, 0, 10, 10, 10};
Box(2) = {10, 0, 0, 10, 10, 10};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }

Physical Volume("LEFT") = {1};
Physical Volume("RIGHT") = {2};
Physical Volume("ALL") = {1, 2};
Physical Surface("GLUE") = Surface In BoundingBox{9.9, -0.1, -0.1, 10.1, 10.1, 10.1};
Physical Surface("END_LEFT") = Surface In BoundingBox{-0.1, -0.1, -0.1, 0.1, 10.1, 10.1};
Physical Surface("END_RIGHT") = Surface In BoundingBox{19.9, -0.1, -0.1, 20.1, 10.1, 10.1};
Physical Surface("TOP") = Surface In BoundingBox{-0.1, -0.1, 9.9, 20.1, 10.1, 10.1};
Physical Curve("EDGE") = Curve In BoundingBox{-0.1, -0.1, 9.9, 20.1, 0.1, 10.1};
Physical Point("CORNERS") = Point In BoundingBox{-0.1, -0.1, -0.1, 0.1, 10.1, 10.1};

Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.Algorithm3D = algorithm;
Mesh.SaveGroupsOfNodes = 1;
