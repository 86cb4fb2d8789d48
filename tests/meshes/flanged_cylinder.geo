// SPDX-License-Identifier: LGPL-2.1-or-later
// A cylinder of radius 4 with a flange of radius 7 at its foot, glued; curved and flat skin, concave feature line.
SetFactory("OpenCASCADE");
DefineConstant[ size = 1, algorithm = 1 ];
Cylinder(1) = {0, 0, 2, 0, 0, 14, 4};
Cylinder(2) = {0, 0, 0, 0, 0, 2, 7};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }

Physical Volume("STEM") = Volume In BoundingBox{-4.1, -4.1, 1.9, 4.1, 4.1, 16.1};
Physical Volume("FLANGE") = Volume In BoundingBox{-7.1, -7.1, -0.1, 7.1, 7.1, 2.1};
Physical Volume("ALL") = {Volume In BoundingBox{-7.1, -7.1, -0.1, 7.1, 7.1, 16.1}};
Physical Surface("FOOT") = Surface In BoundingBox{-7.1, -7.1, -0.1, 7.1, 7.1, 0.1};
Physical Surface("HEAD") = Surface In BoundingBox{-4.1, -4.1, 15.9, 4.1, 4.1, 16.1};
Physical Surface("GLUE") = Surface In BoundingBox{-4.1, -4.1, 1.9, 4.1, 4.1, 2.1};
Physical Surface("STEM_SKIN") = Surface In BoundingBox{-4.1, -4.1, 1.9, 4.1, 4.1, 16.1};
Physical Curve("CORNER") = Curve In BoundingBox{-4.1, -4.1, 1.9, 4.1, 4.1, 2.1};
Physical Point("SEAM_POINTS") = Point In BoundingBox{-7.1, -7.1, -0.1, 7.1, 7.1, 16.1};

Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.Algorithm3D = algorithm;
Mesh.SaveGroupsOfNodes = 1;
