// SPDX-License-Identifier: LGPL-2.1-or-later
// Quadratic: a bolt of radius 3 with six round grooves for a thread, meshed too coarsely for them: strongly curved elements.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 10, 3};
Torus(2) = {0, 0, 1.5, 3.2, 0.6};
Torus(3) = {0, 0, 2.9, 3.2, 0.6};
Torus(4) = {0, 0, 4.3, 3.2, 0.6};
Torus(5) = {0, 0, 5.699999999999999, 3.2, 0.6};
Torus(6) = {0, 0, 7.1, 3.2, 0.6};
Torus(7) = {0, 0, 8.5, 3.2, 0.6};
BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{2:7}; Delete; };
Physical Volume("BOLT") = {20};
Physical Surface("HEAD") = Surface In BoundingBox{-4, -4, -0.01, 4, 4, 0.01};

DefineConstant[ size = 0.8 ];
Mesh.CharacteristicLengthMin = 0.3 * size;
Mesh.CharacteristicLengthMax = size;
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 1;
Mesh.MinimumCirclePoints = 0;
Mesh.CharacteristicLengthFromCurvature = 0;
Mesh.Algorithm = 6;
