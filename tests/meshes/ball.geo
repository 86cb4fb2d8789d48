// SPDX-License-Identifier: LGPL-2.1-or-later
// A ball of radius 5, its upper half a group of its own. With -order 2, mid-side nodes lie on the curved skin.
SetFactory("OpenCASCADE");
DefineConstant[ size = 1 ];
Sphere(1) = {0, 0, 0, 5, -Pi / 2, 0};
Sphere(2) = {0, 0, 0, 5, 0, Pi / 2};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }

Physical Volume("LOWER") = Volume In BoundingBox{-5.1, -5.1, -5.1, 5.1, 5.1, 0.1};
Physical Volume("UPPER") = Volume In BoundingBox{-5.1, -5.1, -0.1, 5.1, 5.1, 5.1};

Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.HighOrderOptimize = 2;
