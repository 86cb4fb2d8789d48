// SPDX-License-Identifier: LGPL-2.1-or-later
// A steel caisson: a closed plate box with a diaphragm and two longitudinal stiffeners under its floor, hung on six T
// stiffeners that run up its sides and stand out above the roof as hangers. Lengths in mm.
//   -setnumber solid 0  plate mid-surfaces, triangles (default)
//   -setnumber solid 1  plates with their thickness, tetrahedra
// Groups whose name starts with SUPPORT, POINT or GAUGE are meant as groups of nodes.
SetFactory("OpenCASCADE");
DefineConstant[ solid = 0, order = 1, size = 36 ];

length = 1200;   // of the box along x, outside
width = 480;     // along y
height = 360;    // along z
t = 24;          // thickness of every plate
hanger = 160;    // height of a hanger above the roof
web = 80;        // T stiffener: depth of its web
flange = 100;    //              breadth of its flange
deep = 60;       // depth of a longitudinal stiffener
manhole = 90;    // radius of the hole in the diaphragm
rows[] = {200, 600, 1000};  // x of the T stiffeners

// Solids end where the next plate begins, mid-surfaces meet.
h = t / 2;
o = solid ? 0 : h;  // from the outside of the box to the end of a plate that reaches it
i = solid ? t : h;  // same, for a plate that ends at another's inside

// Makes the plate {x0,x1} x {y0,y1} x {z0,z1}, or its mid-surface normal to the axis `thin` (0, 1, 2).
Macro Plate
  p = newp;
  If (solid)
    Point(p) = {x0, y0, z0};
  ElseIf (thin == 0)
    Point(p) = {(x0 + x1) / 2, y0, z0};
  ElseIf (thin == 1)
    Point(p) = {x0, (y0 + y1) / 2, z0};
  Else
    Point(p) = {x0, y0, (z0 + z1) / 2};
  EndIf
  If (thin == 0)
    e[] = Extrude{0, y1 - y0, 0}{ Point{p}; };
    f[] = Extrude{0, 0, z1 - z0}{ Curve{e[1]}; };
  ElseIf (thin == 1)
    e[] = Extrude{x1 - x0, 0, 0}{ Point{p}; };
    f[] = Extrude{0, 0, z1 - z0}{ Curve{e[1]}; };
  Else
    e[] = Extrude{x1 - x0, 0, 0}{ Point{p}; };
    f[] = Extrude{0, y1 - y0, 0}{ Curve{e[1]}; };
  EndIf
  If (solid)
    g[] = Extrude{(thin == 0) * (x1 - x0), (thin == 1) * (y1 - y0), (thin == 2) * (z1 - z0)}{ Surface{f[1]}; };
    made = g[1];
  Else
    made = f[1];
  EndIf
Return

// The box.
thin = 2; x0 = o; x1 = length - o; y0 = o; y1 = width - o;
z0 = 0; z1 = t; Call Plate;
z0 = height - t; z1 = height; Call Plate;
thin = 1; z0 = i; z1 = height - i;
y0 = 0; y1 = t; Call Plate;
y0 = width - t; y1 = width; Call Plate;
thin = 0; y0 = i; y1 = width - i;
x0 = 0; x1 = t; Call Plate;
x0 = length - t; x1 = length; Call Plate;
x0 = length / 2 - h; x1 = length / 2 + h; Call Plate;
diaphragm = made;
If (solid)
  hole = newv;
  Cylinder(hole) = {x0 - t, width / 2, height / 2, 3 * t, 0, 0, manhole};
  BooleanDifference{ Volume{diaphragm}; Delete; }{ Volume{hole}; Delete; }
Else
  hole = news;
  Disk(hole) = {length / 2, width / 2, height / 2, manhole};
  Rotate{ {0, 1, 0}, {length / 2, width / 2, height / 2}, Pi / 2 }{ Surface{hole}; }
  BooleanDifference{ Surface{diaphragm}; Delete; }{ Surface{hole}; Delete; }
EndIf

// Longitudinal stiffeners.
thin = 1; x0 = o; x1 = length - o; z0 = -deep; z1 = o;
For k In {1:2}
  y0 = k * width / 3 - h; y1 = k * width / 3 + h; Call Plate;
EndFor

// T stiffeners, numbered 1 2 3 on the side y = 0 and 4 5 6 on the other; the lower part, then the hanger.
For side In {0:1}
  For k In {0:2}
    For upper In {0:1}
      If (upper)
        z0 = height - o; z1 = height + hanger;
      Else
        z0 = o; z1 = height - o;
      EndIf
      thin = 0; x0 = rows[k] - h; x1 = rows[k] + h;
      y0 = side ? width - o : -web - o; y1 = side ? width + web + o : o; Call Plate;
      thin = 1; x0 = rows[k] - flange / 2; x1 = rows[k] + flange / 2;
      y0 = side ? width + web : -web - t; y1 = side ? width + web + t : -web; Call Plate;
    EndFor
  EndFor
EndFor

// A line along the roof that carries equipment.
p = newp;
roof = height - o;
Point(p) = {length / 4, width / 2, roof};
Point(p + 1) = {3 * length / 4, width / 2, roof};
equipment = newl;
Line(equipment) = {p, p + 1};
If (solid)
  BooleanFragments{ Volume{:}; Delete; }{ Curve{equipment}; Delete; }
Else
  BooleanFragments{ Surface{:}; Delete; }{ Curve{equipment}; Delete; }
EndIf

// Groups. InBox puts what lies in the box {x0,x1} x {y0,y1} x {z0,z1} into the group `name`, or adds it if `more`:
// entities of dimension `dim`, where 3 stands for a part of the structure: volumes or, in shells, surfaces.
tol = 0.1;
Macro InBox
  If (dim == 3 && solid)
    found[] = Volume In BoundingBox{x0 - tol, y0 - tol, z0 - tol, x1 + tol, y1 + tol, z1 + tol};
    If (more)
      Physical Volume(Str(name)) += found[];
    Else
      Physical Volume(Str(name)) = found[];
    EndIf
  ElseIf (dim >= 2)
    found[] = Surface In BoundingBox{x0 - tol, y0 - tol, z0 - tol, x1 + tol, y1 + tol, z1 + tol};
    If (more)
      Physical Surface(Str(name)) += found[];
    Else
      Physical Surface(Str(name)) = found[];
    EndIf
  ElseIf (dim == 1)
    found[] = Curve In BoundingBox{x0 - tol, y0 - tol, z0 - tol, x1 + tol, y1 + tol, z1 + tol};
    If (more)
      Physical Curve(Str(name)) += found[];
    Else
      Physical Curve(Str(name)) = found[];
    EndIf
  Else
    found[] = Point In BoundingBox{x0 - tol, y0 - tol, z0 - tol, x1 + tol, y1 + tol, z1 + tol};
    If (more)
      Physical Point(Str(name)) += found[];
    Else
      Physical Point(Str(name)) = found[];
    EndIf
  EndIf
  more = 0;
Return
more = 0;

// Plates; each is also in the group of its material.
dim = 3;
x0 = 0; x1 = length; y0 = 0; y1 = width;
z0 = 0; z1 = t; name = "FLOOR"; Call InBox;
z0 = height - t; z1 = height; name = "ROOF"; Call InBox;
z0 = 0; z1 = height; y1 = t; name = "SIDE_A"; Call InBox;
y0 = width - t; y1 = width; name = "SIDE_B"; Call InBox;
y0 = 0; x1 = t; name = "END_A"; Call InBox;
x0 = length - t; x1 = length; name = "END_B"; Call InBox;
x0 = length / 2 - h; x1 = length / 2 + h; name = "DIAPHRAGM"; Call InBox;
name = "ZONE_MIDDLE"; Call InBox;
x0 = 0; x1 = length; name = "MAT_S355"; Call InBox;
z0 = -deep; z1 = solid ? 0 : h; name = "LONGITUDINALS"; Call InBox;
name = "MAT_S460"; Call InBox;

// T stiffeners with their hangers and welds.
For side In {0:1}
  For k In {0:2}
    number = 3 * side + k + 1;
    dim = 3;
    x0 = rows[k] - flange / 2; x1 = rows[k] + flange / 2;
    y0 = side ? width - o : -web - t; y1 = side ? width + web + t : o;
    z0 = 0; z1 = height + hanger; name = Sprintf("STIFFENER_%g", number); Call InBox;
    name = "MAT_S460"; more = 1; Call InBox;
    If (k == 1)
      name = "ZONE_MIDDLE"; more = 1; Call InBox;
    EndIf
    z0 = height - o; name = "HANGERS"; more = number > 1; Call InBox;
    If (number == 1)
      name = "ZONE_CRACK"; Call InBox;
    EndIf
    dim = solid ? 2 : 1;
    z0 = z1; name = Sprintf("SUPPORT_%g", number); Call InBox;
    name = "SUPPORTS"; more = number > 1; Call InBox;
    dim = 1;
    x0 = rows[k] - h; x1 = rows[k] + h;
    y0 = side ? width - o : o; y1 = y0;
    z0 = 0; z1 = height; name = "WELD_STIFFENERS"; more = number > 1; Call InBox;
  EndFor
EndFor

// Stiffener 1, which the crack will cross: outer face of its flange, its weld of web and flange, its free edges.
z0 = o; z1 = height + hanger;
dim = 2; x0 = rows[0] - flange / 2; x1 = rows[0] + flange / 2;
y0 = solid ? -web - t : -web - h; y1 = y0; name = "FACE_FLANGE_1"; Call InBox;
dim = 1; z0 = height - o;
x1 = x0; y0 = -web - t; y1 = solid ? y0 : -web; name = "EDGE_FLANGE_1"; Call InBox;
x0 = rows[0] + flange / 2; x1 = x0; more = 1; Call InBox;
x0 = rows[0] - h; x1 = rows[0] + h;
y0 = solid ? -web : -web - h; y1 = y0; name = "WELD_FLANGE_1"; Call InBox;

// Loads.
dim = 2; x0 = i; y0 = i; y1 = width - i; z0 = solid ? t : h; z1 = z0;
x1 = solid ? length / 2 - h : length / 2; name = "PRESSURE"; Call InBox;
x0 = length - x1; x1 = length - i; more = 1; Call InBox;
x0 = length / 4; x1 = 3 * length / 4; y0 = width / 2; y1 = y0; z0 = roof; z1 = roof;
dim = 1; name = "LINE_LOAD"; Call InBox;
x1 = x0; dim = 0; name = "POINT_LOAD"; Call InBox;
x0 = 3 * length / 4; x1 = x0; more = 1; Call InBox;

// Where displacements are read off.
x0 = 0; x1 = length; y0 = 0; y1 = width; z0 = -deep; z1 = z0; name = "GAUGE_FLOOR"; Call InBox;
x0 = rows[0] - flange / 2; x1 = rows[0] + flange / 2; y0 = -web - t; y1 = o; z0 = height - o; z1 = z0;
name = "GAUGE_HANGER_1"; Call InBox;

// Size `size`, half of it in the hanger that will be cracked.
Field[1] = Box;
Field[1].VIn = size / 2;
Field[1].VOut = size;
Field[1].Thickness = 2 * size;
Field[1].XMin = rows[0] - flange / 2; Field[1].XMax = rows[0] + flange / 2;
Field[1].YMin = -web - t;             Field[1].YMax = 0;
Field[1].ZMin = height;               Field[1].ZMax = height + hanger;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeMin = size / 2;
Mesh.MeshSizeMax = size;
Mesh.ElementOrder = order;
Mesh.SecondOrderLinear = 1;
Mesh.Algorithm3D = 10;  // HXT: well-shaped in thin plates, though not repeatable to the last element
Mesh.SaveGroupsOfNodes = 1;
