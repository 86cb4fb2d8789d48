// SPDX-License-Identifier: LGPL-2.1-or-later
// Quadratic: a quarter bend (bend radius 8) of thick pipe (radii 2 and 3.5) with a straight end of length 4, glued.
// Mid-side nodes lie on the curved skin.
SetFactory("OpenCASCADE");
DefineConstant[ size = 1 ];
Disk(1) = {8, 0, 0, 3.5};
Disk(2) = {8, 0, 0, 2};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Rotate{ {1, 0, 0}, {0, 0, 0}, Pi / 2 }{ Surface{3}; }
bend[] = Extrude{ {0, 0, 1}, {0, 0, 0}, Pi / 2 }{ Surface{3}; };
end[] = Extrude{ 0, -4, 0 }{ Surface{3}; };
BooleanFragments{ Volume{bend[1]}; Delete; }{ Volume{end[1]}; Delete; }

Physical Volume("BEND") = Volume In BoundingBox{-0.1, -0.1, -4, 12, 12, 4};
Physical Volume("STRAIGHT") = Volume In BoundingBox{4, -4.1, -4, 12, 0.1, 4};
Physical Surface("INLET") = Surface In BoundingBox{4, -4.1, -4, 12, -3.9, 4};
Physical Surface("OUTLET") = Surface In BoundingBox{-0.1, 4, -4, 0.1, 12, 4};
Physical Surface("GLUE") = Surface In BoundingBox{4, -0.1, -4, 12, 0.1, 4};
Physical Surface("BORE") = {Surface In BoundingBox{5.9, -4.1, -2.1, 10.1, 0.1, 2.1},
                            Surface In BoundingBox{-0.1, -0.1, -2.1, 10.1, 10.1, 2.1}};
Physical Curve("RIM") = Curve In BoundingBox{-0.1, 4, -4, 0.1, 12, 4};
Physical Point("SEAM_POINTS") = Point In BoundingBox{-0.1, -4.1, -4, 12, 12, 4};

Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 2;
Mesh.SaveGroupsOfNodes = 1;
