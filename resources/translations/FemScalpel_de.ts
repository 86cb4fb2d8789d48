<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
  <context>
    <name>AdditionInput</name>
    <message>
      <source>Addition</source>
      <translation>Zusatz</translation>
    </message>
    <message>
      <source>Click the mesh in the 3-D view or in the tree</source>
      <translation>Klicken Sie in der 3D-Ansicht oder im Baum auf das Netz</translation>
    </message>
    <message>
      <source>Mesh to add</source>
      <translation>Neues Netz</translation>
    </message>
    <message>
      <source>Pick</source>
      <translation>Wählen</translation>
    </message>
    <message>
      <source>The FEM mesh that is added, where its placement puts it: also one that FreeCAD has made of a part</source>
      <translation>Das FEM-Netz, das hinzukommt, dort, wo seine Platzierung es hinstellt: auch eines, das FreeCAD aus einem Teil gemacht hat</translation>
    </message>
  </context>
  <context>
    <name>AxisInput</name>
    <message>
      <source>2 nodes</source>
      <translation>2 Knoten</translation>
    </message>
    <message>
      <source>A point of the axis: x</source>
      <translation>Ein Punkt der Achse: x</translation>
    </message>
    <message>
      <source>A point of the axis: y</source>
      <translation>Ein Punkt der Achse: y</translation>
    </message>
    <message>
      <source>A point of the axis: z</source>
      <translation>Ein Punkt der Achse: z</translation>
    </message>
    <message>
      <source>Axis</source>
      <translation>Achse</translation>
    </message>
    <message>
      <source>Centre</source>
      <translation>Mitte</translation>
    </message>
    <message>
      <source>Click a cylindrical face, a straight or circular edge, a datum line, or a point on a face: the axis is normal to it there</source>
      <translation>Klicken Sie auf eine Zylinderfläche, eine gerade oder runde Kante, eine Bezugslinie oder einen Punkt einer Fläche: dort steht die Achse senkrecht</translation>
    </message>
    <message>
      <source>Click two nodes of the mesh in the 3-D view: the axis goes through them</source>
      <translation>Klicken Sie in der 3D-Ansicht auf zwei Knoten des Netzes: die Achse geht hindurch</translation>
    </message>
    <message>
      <source>Direction of the axis: x</source>
      <translation>Richtung der Achse: x</translation>
    </message>
    <message>
      <source>Direction of the axis: y</source>
      <translation>Richtung der Achse: y</translation>
    </message>
    <message>
      <source>Direction of the axis: z</source>
      <translation>Richtung der Achse: z</translation>
    </message>
    <message>
      <source>Geometry</source>
      <translation>Geometrie</translation>
    </message>
    <message>
      <source>Moves the point to the middle of the mesh</source>
      <translation>Setzt den Punkt in die Mitte des Netzes</translation>
    </message>
    <message>
      <source>Point</source>
      <translation>Punkt</translation>
    </message>
    <message>
      <source>R</source>
      <translation>R</translation>
    </message>
    <message>
      <source>Radius of the cylinder</source>
      <translation>Radius des Zylinders</translation>
    </message>
    <message>
      <source>The axis is the view direction</source>
      <translation>Die Achse ist die Blickrichtung</translation>
    </message>
    <message>
      <source>View</source>
      <translation>Ansicht</translation>
    </message>
    <message>
      <source>x</source>
      <translation>x</translation>
    </message>
    <message>
      <source>y</source>
      <translation>y</translation>
    </message>
    <message>
      <source>z</source>
      <translation>z</translation>
    </message>
  </context>
  <context>
    <name>CylinderPart</name>
    <message>
      <source>Angle about the axis where the crack begins; 0 to 360: all around. 0 is towards x when the axis is z; the preview shows it</source>
      <translation>Winkel um die Achse, wo der Riss beginnt; 0 bis 360: ringsum. 0 zeigt nach x, wenn die Achse z ist; die Vorschau zeigt es</translation>
    </message>
    <message>
      <source>Only a part of the cylinder cracks, between two heights along its axis and two angles about it; its border is the crack front</source>
      <translation>Nur ein Teil des Zylinders reißt, zwischen zwei Höhen entlang seiner Achse und zwei Winkeln um sie; sein Rand ist die Rissfront</translation>
    </message>
    <message>
      <source>Only from</source>
      <translation>Nur von</translation>
    </message>
    <message>
      <source>Part of the cylinder</source>
      <translation>Teil des Zylinders</translation>
    </message>
    <message>
      <source>Where the crack begins: from the point, along the axis</source>
      <translation>Wo der Riss beginnt: vom Punkt aus längs der Achse</translation>
    </message>
    <message>
      <source>Where the crack ends about the axis, counter-clockwise seen against it</source>
      <translation>Wo der Riss um die Achse endet, gegen den Uhrzeigersinn bei Blick gegen die Achse</translation>
    </message>
    <message>
      <source>Where the crack ends: from the point, along the axis</source>
      <translation>Wo der Riss endet: vom Punkt aus längs der Achse</translation>
    </message>
    <message>
      <source>to</source>
      <translation>bis</translation>
    </message>
  </context>
  <context>
    <name>EdgeInput</name>
    <message>
      <source>Clear</source>
      <translation>Leeren</translation>
    </message>
    <message>
      <source>Click near an edge of the mesh in the 3-D view; it is rounded as far as it goes on without a corner</source>
      <translation>Klicken Sie in der 3D-Ansicht nahe an eine Kante des Netzes; sie wird so weit gerundet, wie sie ohne Ecke weiterläuft</translation>
    </message>
    <message>
      <source>Edge</source>
      <translation>Kante</translation>
    </message>
    <message>
      <source>Forgets what was picked</source>
      <translation>Vergisst, was gewählt wurde</translation>
    </message>
    <message>
      <source>Pick</source>
      <translation>Wählen</translation>
    </message>
    <message>
      <source>Picked places do not move with the mesh: when it changes, the edge that is there then is rounded. A group goes with the mesh.</source>
      <translation>Gewählte Stellen bewegen sich nicht mit dem Netz: Ändert es sich, wird die Kante gerundet, die dann dort ist. Eine Gruppe geht mit dem Netz.</translation>
    </message>
    <message>
      <source>What is rounded: what was picked, or a group of segments or nodes on an edge</source>
      <translation>Was gerundet wird: was gewählt wurde oder eine Gruppe von Strecken oder Knoten auf einer Kante</translation>
    </message>
  </context>
  <context>
    <name>FaceGroupInput</name>
    <message>
      <source>Faces</source>
      <translation>Flächen</translation>
    </message>
    <message>
      <source>Faces of</source>
      <translation>Flächen von</translation>
    </message>
    <message>
      <source>The group whose faces come apart: of faces inside the part (of a shell: edges), or of their nodes</source>
      <translation>Die Gruppe, deren Flächen sich trennen: von Flächen im Bauteil (einer Schale: Kanten) oder von ihren Knoten</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel</name>
    <message>
      <source>%1 % of the area</source>
      <translation>%1 % der Fläche</translation>
    </message>
    <message>
      <source>%1 % of the length</source>
      <translation>%1 % der Länge</translation>
    </message>
    <message>
      <source>%1 % of the volume</source>
      <translation>%1 % des Volumens</translation>
    </message>
    <message>
      <source>%1 '%2' has an error; mend it first</source>
      <translation>%1 „%2“ hat einen Fehler; beheben Sie ihn zuerst</translation>
    </message>
    <message>
      <source>%1 '%2' has no mesh; make it first</source>
      <translation>%1 „%2“ hat kein Netz; erzeugen Sie es zuerst</translation>
    </message>
    <message>
      <source>%1 '%2' is not a FEM mesh</source>
      <translation>%1 „%2“ ist kein FEM-Netz</translation>
    </message>
    <message>
      <source>%1 and %2</source>
      <translation>%1 und %2</translation>
    </message>
    <message>
      <source>%1 and %2 more</source>
      <translation>%1 und %2 weitere</translation>
    </message>
    <message>
      <source>%1 beam elements</source>
      <translation>%1 Balkenelemente</translation>
    </message>
    <message>
      <source>%1 cannot be added. Click another FEM mesh.</source>
      <translation>%1 kann nicht hinzukommen. Klicken Sie auf ein anderes FEM-Netz.</translation>
    </message>
    <message>
      <source>%1 cannot be written: %2. Choose another folder or name.</source>
      <translation>%1 kann nicht geschrieben werden: %2. Wählen Sie einen anderen Ordner oder Namen.</translation>
    </message>
    <message>
      <source>%1 does not hold %2: files of this kind cannot</source>
      <translation>%1 enthält nicht: %2. Dateien dieser Art können das nicht</translation>
    </message>
    <message>
      <source>%1 element(s) would be flat or inverted (%2): the tool passes too close to a corner or crease there. Move it a little</source>
      <translation>%1 Element(e) würden flach oder umgestülpt (%2): Das Werkzeug geht dort zu nah an einer Ecke oder einem Knick vorbei. Verschieben Sie es ein wenig</translation>
    </message>
    <message>
      <source>%1 elements; smallest %2, mean %3.</source>
      <translation>%1 Elemente; kleinster Wert %2, Mittel %3.</translation>
    </message>
    <message>
      <source>%1 exists already. Replace it?</source>
      <translation>%1 gibt es schon. Ersetzen?</translation>
    </message>
    <message>
      <source>%1 faces of %2</source>
      <translation>%1 Flächen von %2</translation>
    </message>
    <message>
      <source>%1 groups, %2 nodes, %3 elements.</source>
      <translation>%1 Gruppen, %2 Knoten, %3 Elemente.</translation>
    </message>
    <message>
      <source>%1 has an error. Mend it, or select another mesh.</source>
      <translation>%1 hat einen Fehler. Beheben Sie ihn oder wählen Sie ein anderes Netz.</translation>
    </message>
    <message>
      <source>%1 has no mesh any more. Undo what took it away, or cancel.</source>
      <translation>%1 hat kein Netz mehr. Machen Sie rückgängig, was es genommen hat, oder brechen Sie ab.</translation>
    </message>
    <message>
      <source>%1 has no mesh yet: it is empty. Make the mesh first.</source>
      <translation>%1 hat noch kein Netz: es ist leer. Erzeugen Sie zuerst das Netz.</translation>
    </message>
    <message>
      <source>%1 has no radius any more; pick it again in the operation's panel, or set Follow to Numbers</source>
      <translation>%1 hat keinen Radius mehr; wählen Sie die Stelle im Fenster der Operation neu, oder setzen Sie Follow auf Numbers</translation>
    </message>
    <message>
      <source>%1 has no source mesh. Set its property Source to a FEM mesh first.</source>
      <translation>%1 hat kein Ausgangsnetz. Setzen Sie zuerst die Eigenschaft Source auf ein FEM-Netz.</translation>
    </message>
    <message>
      <source>%1 is not a FEM mesh. Select the mesh in the tree.</source>
      <translation>%1 ist kein FEM-Netz. Wählen Sie das Netz im Baum.</translation>
    </message>
    <message>
      <source>%1 is not set; choose the FEM mesh to add</source>
      <translation>%1 ist nicht gesetzt; wählen Sie das FEM-Netz, das hinzukommt</translation>
    </message>
    <message>
      <source>%1 is not set; choose the FEM mesh to work on</source>
      <translation>%1 ist nicht gesetzt; wählen Sie das FEM-Netz, das bearbeitet wird</translation>
    </message>
    <message>
      <source>%1 is not the mesh that was imported any more, as it was moved or changed: what its file held beside nodes, elements and groups (a deck's cards, as materials and sections; fields; groups of element faces) is left behind</source>
      <translation>%1 ist nicht mehr das importierte Netz, da es verschoben oder geändert wurde: Was seine Datei außer Knoten, Elementen und Gruppen enthielt (die Karten einer Eingabedatei, wie Materialien und Querschnitte; Felder; Gruppen von Elementflächen), bleibt zurück</translation>
    </message>
    <message>
      <source>%1 is not there any more, so its panel was closed.</source>
      <translation>%1 gibt es nicht mehr, darum wurde der Dialog geschlossen.</translation>
    </message>
    <message>
      <source>%1 is the source of another operation. Take %2, the latest, instead?</source>
      <translation>%1 ist schon das Ausgangsnetz einer anderen Operation. Stattdessen das neueste nehmen, %2?</translation>
    </message>
    <message>
      <source>%1 million</source>
      <translation>%1 Millionen</translation>
    </message>
    <message>
      <source>%1 nodes moved, %2 added; %3 elements added, %4 removed. Mean ratio at least %5 (before: %6).</source>
      <translation>%1 Knoten verschoben, %2 hinzugefügt; %3 Elemente hinzugefügt, %4 entfernt. Mean ratio mindestens %5 (vorher: %6).</translation>
    </message>
    <message>
      <source>%1 nodes moved; boundary at most %2 mm from where it was</source>
      <translation>%1 Knoten verschoben; Rand höchstens %2 mm von seiner alten Lage</translation>
    </message>
    <message>
      <source>%1 picked places</source>
      <translation>%1 gewählte Stellen</translation>
    </message>
    <message>
      <source>%1 second-order element(s) would be folded (%2): the mesh is too coarse for its curvature there. Move the tool a little, or refine the mesh</source>
      <translation>%1 Element(e) zweiter Ordnung würden gefaltet (%2): Das Netz ist dort zu grob für seine Krümmung. Verschieben Sie das Werkzeug ein wenig, oder verfeinern Sie das Netz</translation>
    </message>
    <message>
      <source>%1 shell elements</source>
      <translation>%1 Schalenelemente</translation>
    </message>
    <message>
      <source>%1 smaller ones</source>
      <translation>%1 kleinere</translation>
    </message>
    <message>
      <source>%1 was read.</source>
      <translation>%1 wurde gelesen.</translation>
    </message>
    <message>
      <source>%1 was set, so it does not follow %2 any more</source>
      <translation>%1 wurde gesetzt und folgt daher %2 nicht mehr</translation>
    </message>
    <message>
      <source>%1 was set, so it is not that of %2 any more</source>
      <translation>%1 wurde gesetzt und ist daher nicht mehr das von %2</translation>
    </message>
    <message>
      <source>%1 was written.</source>
      <translation>%1 wurde geschrieben.</translation>
    </message>
    <message>
      <source>%1, where this was picked, is not there any more or may be another one. Pick it again, or press Unlink: then the numbers stay.</source>
      <translation>%1, woher dies stammt, gibt es nicht mehr, oder es ist vielleicht etwas anderes. Wählen Sie es neu, oder drücken Sie Lösen: Dann bleiben die Zahlen.</translation>
    </message>
    <message>
      <source>%1, which %2 follows, is not there any more; pick it again in the operation's panel, or set Follow to Numbers</source>
      <translation>%1, dem %2 folgt, gibt es nicht mehr; wählen Sie es im Fenster der Operation neu, oder setzen Sie Follow auf Numbers</translation>
    </message>
    <message>
      <source>%1, which %2 follows, may be another face, edge or vertex now: its part has others than before; pick it again in the operation's panel, or set Follow to Numbers</source>
      <translation>%1, dem %2 folgt, kann jetzt eine andere Fläche, Kante oder Ecke sein: Ihr Teil hat andere als zuvor; wählen Sie es im Fenster der Operation neu, oder setzen Sie Follow auf Numbers</translation>
    </message>
    <message>
      <source>%1: %2 is %3; it must be positive</source>
      <translation>%1: %2 ist %3; es muss positiv sein</translation>
    </message>
    <message>
      <source>%1: %2 is the zero vector; give a direction</source>
      <translation>%1: %2 ist der Nullvektor; geben Sie eine Richtung an</translation>
    </message>
    <message>
      <source>%1: 0 to %2</source>
      <translation>%1: 0 bis %2</translation>
    </message>
    <message>
      <source>%1: FreeCAD will not find these nodes by geometry, so that a load, support or material on it is incomplete</source>
      <translation>%1: FreeCAD findet diese Knoten nicht über die Geometrie, sodass eine Last, ein Lager oder ein Material darauf unvollständig ist</translation>
    </message>
    <message>
      <source>%1: names of groups are not UTF-8; they are read as Windows-1252 (Latin-1). Look at those with letters beyond A to Z</source>
      <translation>%1: Gruppennamen sind nicht UTF-8; sie werden als Windows-1252 (Latin-1) gelesen. Prüfen Sie die mit anderen Buchstaben als A bis Z</translation>
    </message>
    <message>
      <source>%1: the text is not UTF-8, here for the first time; it is read as Windows-1252 (Latin-1). Look at names with letters beyond A to Z</source>
      <translation>%1: Der Text ist nicht UTF-8, hier zum ersten Mal; er wird als Windows-1252 (Latin-1) gelesen. Prüfen Sie Namen mit anderen Buchstaben als A bis Z</translation>
    </message>
    <message>
      <source>%1: this is text in UTF-16 or UTF-32, which is not read; save it as UTF-8</source>
      <translation>%1: Dies ist Text in UTF-16 oder UTF-32, der nicht gelesen wird; speichern Sie ihn als UTF-8</translation>
    </message>
    <message>
      <source>'%1' has no mesh; mend what its error says first</source>
      <translation>„%1“ hat kein Netz; beheben Sie zuerst, was sein Fehler sagt</translation>
    </message>
    <message>
      <source>'%1' is in no analysis</source>
      <translation>„%1“ ist in keiner Analyse</translation>
    </message>
    <message>
      <source>1 node</source>
      <translation>1 Knoten</translation>
    </message>
    <message>
      <source>1 picked place</source>
      <translation>1 gewählte Stelle</translation>
    </message>
    <message>
      <source>3 nodes</source>
      <translation>3 Knoten</translation>
    </message>
    <message>
      <source>A disk</source>
      <translation>Eine Kreisscheibe</translation>
    </message>
    <message>
      <source>A half plane</source>
      <translation>Eine Halbebene</translation>
    </message>
    <message>
      <source>A polygon</source>
      <translation>Ein Polygon</translation>
    </message>
    <message>
      <source>Addition and Source are the same mesh; choose another mesh to add</source>
      <translation>Addition und Source sind dasselbe Netz; wählen Sie ein anderes Netz, das hinzukommt</translation>
    </message>
    <message>
      <source>Advanced</source>
      <translation>Erweitert</translation>
    </message>
    <message>
      <source>After</source>
      <translation>Nachher</translation>
    </message>
    <message>
      <source>All commands</source>
      <translation>Alle Befehle</translation>
    </message>
    <message>
      <source>Along and AlongPoints both say which edge is rounded; give one of them</source>
      <translation>Along und AlongPoints sagen beide, welche Kante gerundet wird; geben Sie nur eins an</translation>
    </message>
    <message>
      <source>An ellipse</source>
      <translation>Eine Ellipse</translation>
    </message>
    <message>
      <source>Another task panel is open. Close it first.</source>
      <translation>Ein anderer Aufgabenbereich ist offen. Schließen Sie ihn zuerst.</translation>
    </message>
    <message>
      <source>At the bottom it has</source>
      <translation>Am Grund, den es hat</translation>
    </message>
    <message>
      <source>Back</source>
      <translation>Zurück</translation>
    </message>
    <message>
      <source>Before</source>
      <translation>Vorher</translation>
    </message>
    <message>
      <source>Bounding (BE)</source>
      <translation>Begrenzend (BE)</translation>
    </message>
    <message>
      <source>By group</source>
      <translation>Nach Gruppe</translation>
    </message>
    <message>
      <source>By quality</source>
      <translation>Nach Güte</translation>
    </message>
    <message>
      <source>CAD face</source>
      <translation>CAD-Fläche</translation>
    </message>
    <message>
      <source>CSV…</source>
      <translation>CSV…</translation>
    </message>
    <message>
      <source>Cancel</source>
      <translation>Abbrechen</translation>
    </message>
    <message>
      <source>Cancelled. OK, or a change, computes again.</source>
      <translation>Abgebrochen. OK oder eine Änderung rechnet neu.</translation>
    </message>
    <message>
      <source>Cancelled: no file was written.</source>
      <translation>Abgebrochen: Es wurde keine Datei geschrieben.</translation>
    </message>
    <message>
      <source>Cancelled: nothing was changed.</source>
      <translation>Abgebrochen: nichts wurde geändert.</translation>
    </message>
    <message>
      <source>Cancelled: nothing was imported.</source>
      <translation>Abgebrochen: Nichts wurde importiert.</translation>
    </message>
    <message>
      <source>Centre</source>
      <translation>Mitte</translation>
    </message>
    <message>
      <source>Change</source>
      <translation>Änderung</translation>
    </message>
    <message>
      <source>Changed part</source>
      <translation>Geänderter Teil</translation>
    </message>
    <message>
      <source>Choose the mesh to add, or pick it.</source>
      <translation>Wählen Sie das Netz, das hinzukommt, in der Liste oder durch einen Klick.</translation>
    </message>
    <message>
      <source>Click a cylindrical face, a straight or circular edge, a datum line, or a point on a face (the axis is normal to it). Escape stops.</source>
      <translation>Klicken Sie auf eine Zylinderfläche, eine gerade oder runde Kante, eine Bezugslinie oder einen Punkt einer Fläche (die Achse steht senkrecht darauf). Escape bricht ab.</translation>
    </message>
    <message>
      <source>Click a face of a part, or a part in the tree. Escape stops.</source>
      <translation>Klicken Sie auf die Fläche eines Teils oder auf ein Teil im Baum. Escape bricht ab.</translation>
    </message>
    <message>
      <source>Click a face of the mesh. Escape stops.</source>
      <translation>Klicken Sie auf eine Fläche des Netzes. Escape beendet.</translation>
    </message>
    <message>
      <source>Click a node of the mesh. Escape stops.</source>
      <translation>Klicken Sie auf einen Knoten des Netzes. Escape bricht ab.</translation>
    </message>
    <message>
      <source>Click a planar face, an edge (the plane is normal to it), a datum or a sketch. Escape stops.</source>
      <translation>Klicken Sie auf eine ebene Fläche, eine Kante (die Ebene steht senkrecht darauf), einen Bezug oder eine Skizze. Escape bricht ab.</translation>
    </message>
    <message>
      <source>Click a round face, a straight or circular edge, a datum line, or a point on a face. Escape stops.</source>
      <translation>Klicken Sie auf eine runde Fläche, eine gerade oder runde Kante, eine Bezugslinie oder einen Punkt einer Fläche. Escape bricht ab.</translation>
    </message>
    <message>
      <source>Click node %1 of %2 on the mesh, or a vertex of a part. Escape stops.</source>
      <translation>Klicken Sie auf Knoten %1 von %2 des Netzes oder auf eine Ecke eines Bauteils. Escape bricht ab.</translation>
    </message>
    <message>
      <source>Click the mesh itself, near the edge.</source>
      <translation>Klicken Sie auf das Netz selbst, nahe an der Kante.</translation>
    </message>
    <message>
      <source>Click the mesh near the edge to round. Escape stops.</source>
      <translation>Klicken Sie auf das Netz nahe an der Kante, die gerundet wird. Escape beendet.</translation>
    </message>
    <message>
      <source>Click the mesh to add, here or in the tree. Escape stops.</source>
      <translation>Klicken Sie auf das Netz, das hinzukommt, hier oder im Baum. Escape beendet.</translation>
    </message>
    <message>
      <source>Colour of %1</source>
      <translation>Farbe von %1</translation>
    </message>
    <message>
      <source>Compute it all the same</source>
      <translation>Trotzdem berechnen</translation>
    </message>
    <message>
      <source>Computing the new mesh…</source>
      <translation>Neues Netz wird berechnet…</translation>
    </message>
    <message>
      <source>Cone</source>
      <translation>Kegel</translation>
    </message>
    <message>
      <source>Copies all rows that are shown, for a spreadsheet</source>
      <translation>Kopiert alle gezeigten Zeilen, für eine Tabellenkalkulation</translation>
    </message>
    <message>
      <source>Copy</source>
      <translation>Kopieren</translation>
    </message>
    <message>
      <source>Copy the command</source>
      <translation>Befehl kopieren</translation>
    </message>
    <message>
      <source>Crack</source>
      <translation>Riss</translation>
    </message>
    <message>
      <source>Crack along faces</source>
      <translation>Riss entlang Flächen</translation>
    </message>
    <message>
      <source>Cracks, drills and cuts FEM meshes and keeps their groups</source>
      <translation>Reißt, bohrt und schneidet FEM-Netze und erhält ihre Gruppen</translation>
    </message>
    <message>
      <source>Curved crack</source>
      <translation>Gekrümmter Riss</translation>
    </message>
    <message>
      <source>Cut away</source>
      <translation>Aufgeschnitten</translation>
    </message>
    <message>
      <source>Cylinder</source>
      <translation>Zylinder</translation>
    </message>
    <message>
      <source>Cylindrical crack</source>
      <translation>Zylindrischer Riss</translation>
    </message>
    <message>
      <source>Direction, as its expressions say it, is zero; give it a length</source>
      <translation>Direction ist nach ihren Ausdrücken null; geben Sie ihr eine Länge</translation>
    </message>
    <message>
      <source>Document %1 has objects of FemScalpel (%2), which do not recompute while a part of FemScalpel is missing, nor after the document was saved without it. Close it without saving.</source>
      <translation>Dokument %1 hat Objekte von FemScalpel (%2), die nicht neu berechnet werden, solange ein Teil von FemScalpel fehlt, und auch nicht mehr, wenn das Dokument ohne ihn gespeichert wurde. Schließen Sie es, ohne zu speichern.</translation>
    </message>
    <message>
      <source>Double-click to change the colour</source>
      <translation>Doppelklick ändert die Farbe</translation>
    </message>
    <message>
      <source>Down to the point</source>
      <translation>Bis zum Punkt</translation>
    </message>
    <message>
      <source>Drill</source>
      <translation>Bohrung</translation>
    </message>
    <message>
      <source>Edit</source>
      <translation>Bearbeiten</translation>
    </message>
    <message>
      <source>Element</source>
      <translation>Element</translation>
    </message>
    <message>
      <source>Elementary groups</source>
      <translation>Elementargruppen</translation>
    </message>
    <message>
      <source>Enter an expression (=)</source>
      <translation>Einen Ausdruck eingeben (=)</translation>
    </message>
    <message>
      <source>Export mesh</source>
      <translation>Netz exportieren</translation>
    </message>
    <message>
      <source>Expression</source>
      <translation>Ausdruck</translation>
    </message>
    <message>
      <source>FemScalpel cannot run: %1</source>
      <translation>FemScalpel kann nicht arbeiten: %1</translation>
    </message>
    <message>
      <source>FemScalpel: help</source>
      <translation>FemScalpel: Hilfe</translation>
    </message>
    <message>
      <source>Fillet</source>
      <translation>Rundung</translation>
    </message>
    <message>
      <source>Filter by name</source>
      <translation>Nach Namen filtern</translation>
    </message>
    <message>
      <source>First became triangles or tetrahedra: %1.</source>
      <translation>Zuerst wurden zu Dreiecken oder Tetraedern: %1.</translation>
    </message>
    <message>
      <source>FreeCAD takes the mesh over…</source>
      <translation>FreeCAD übernimmt das Netz…</translation>
    </message>
    <message>
      <source>FreeCAD would not apply everything in '%1' to '%2': %3. Move the tool a little, or refine the mesh there</source>
      <translation>FreeCAD würde nicht alles in „%1“ auf „%2“ anwenden: %3. Verschieben Sie das Werkzeug ein wenig, oder verfeinern Sie dort das Netz</translation>
    </message>
    <message>
      <source>Group</source>
      <translation>Gruppe</translation>
    </message>
    <message>
      <source>Group inspector</source>
      <translation>Gruppen-Inspektor</translation>
    </message>
    <message>
      <source>Group is not set; choose the mesh group to crack along</source>
      <translation>Group ist nicht gesetzt; wählen Sie die Netzgruppe, an der gerissen wird</translation>
    </message>
    <message>
      <source>Group is not set; choose the mesh group to move</source>
      <translation>Group ist nicht gesetzt; wählen Sie die Netzgruppe, die verschoben wird</translation>
    </message>
    <message>
      <source>Groups</source>
      <translation>Gruppen</translation>
    </message>
    <message>
      <source>How nodes are moved, which of them, and what must keep its shape</source>
      <translation>Wie Knoten bewegt werden, welche, und was seine Form behalten muss</translation>
    </message>
    <message>
      <source>Import mesh</source>
      <translation>Netz importieren</translation>
    </message>
    <message>
      <source>Incision</source>
      <translation>Einschnitt</translation>
    </message>
    <message>
      <source>Isolated (IE)</source>
      <translation>Einzeln (IE)</translation>
    </message>
    <message>
      <source>KeepToShape is set, but the mesh does not know the geometry it was made from (its property Part or Shape)</source>
      <translation>KeepToShape ist gesetzt, aber das Netz kennt die Geometrie nicht, aus der es erzeugt wurde (seine Eigenschaft Part oder Shape)</translation>
    </message>
    <message>
      <source>Kind</source>
      <translation>Art</translation>
    </message>
    <message>
      <source>Linking (LE)</source>
      <translation>Verbindend (LE)</translation>
    </message>
    <message>
      <source>Mean ratio</source>
      <translation>Mean ratio</translation>
    </message>
    <message>
      <source>Measure</source>
      <translation>Maß</translation>
    </message>
    <message>
      <source>Members</source>
      <translation>Mitglieder</translation>
    </message>
    <message>
      <source>Merge</source>
      <translation>Anfügen</translation>
    </message>
    <message>
      <source>Mesh quality</source>
      <translation>Netzgüte</translation>
    </message>
    <message>
      <source>Mesh: %1</source>
      <translation>Netz: %1</translation>
    </message>
    <message>
      <source>Meshes</source>
      <translation>Netze</translation>
    </message>
    <message>
      <source>No group of the mesh covers faces inside it (of a shell: edges). Make one of them, or of their nodes, first.</source>
      <translation>Keine Gruppe des Netzes bedeckt Flächen in seinem Inneren (einer Schale: Kanten). Machen Sie erst eine davon oder von ihren Knoten.</translation>
    </message>
    <message>
      <source>No longer follows %1: other numbers were entered.</source>
      <translation>Folgt %1 nicht mehr: Es wurden andere Zahlen eingegeben.</translation>
    </message>
    <message>
      <source>No preview yet: see the question above.</source>
      <translation>Noch keine Vorschau: siehe die Frage oben.</translation>
    </message>
    <message>
      <source>No preview.</source>
      <translation>Keine Vorschau.</translation>
    </message>
    <message>
      <source>No preview: see the message in red.</source>
      <translation>Keine Vorschau: siehe die Meldung in Rot.</translation>
    </message>
    <message>
      <source>Normal</source>
      <translation>Normale</translation>
    </message>
    <message>
      <source>Nothing is moved yet. Enter where the wall is to be.</source>
      <translation>Noch wird nichts verschoben. Geben Sie ein, wo die Wand liegen soll.</translation>
    </message>
    <message>
      <source>Nothing to refine: the elements that the tool reaches have no edge longer than the size. Move the tool, give it a larger reach, or choose a smaller size.</source>
      <translation>Nichts zu verfeinern: Die Elemente, die das Werkzeug erreicht, haben keine Kante, die länger als die Größe ist. Werkzeug verschieben, Reichweite vergrößern oder eine kleinere Größe wählen.</translation>
    </message>
    <message>
      <source>Number of elements by mean ratio (1: equilateral, 0: flat). Bars: after; line: before</source>
      <translation>Anzahl der Elemente nach Mean ratio (1: gleichseitig, 0: flach). Balken: nachher; Linie: vorher</translation>
    </message>
    <message>
      <source>Open a document with a FEM mesh first.</source>
      <translation>Öffnen Sie zuerst ein Dokument mit einem FEM-Netz.</translation>
    </message>
    <message>
      <source>Opening the panel…</source>
      <translation>Der Dialog wird geöffnet…</translation>
    </message>
    <message>
      <source>Pick a cylindrical face, a straight or circular edge, a datum line, or a point on a face.</source>
      <translation>Wählen Sie eine Zylinderfläche, eine gerade oder runde Kante, eine Bezugslinie oder einen Punkt einer Fläche.</translation>
    </message>
    <message>
      <source>Pick a planar face, an edge, a datum plane or line, a sketch, or a face of the mesh.</source>
      <translation>Wählen Sie eine ebene Fläche, eine Kante, eine Bezugsebene oder -linie, eine Skizze oder eine Seite des Netzes.</translation>
    </message>
    <message>
      <source>Pick a sketch with one closed line of straight sides: that is the polygon.</source>
      <translation>Wählen Sie eine Skizze mit einem geschlossenen Zug gerader Seiten: Der ist das Polygon.</translation>
    </message>
    <message>
      <source>Plane</source>
      <translation>Ebene</translation>
    </message>
    <message>
      <source>Press Pick and click a face of a part.</source>
      <translation>Drücken Sie Wählen und klicken Sie auf die Fläche eines Teils.</translation>
    </message>
    <message>
      <source>Press Pick and click near the edge, or choose a group.</source>
      <translation>Drücken Sie Wählen und klicken Sie nahe an die Kante, oder wählen Sie eine Gruppe.</translation>
    </message>
    <message>
      <source>Put into the analysis</source>
      <translation>In die Analyse einsetzen</translation>
    </message>
    <message>
      <source>Putting nodes onto the geometry…</source>
      <translation>Knoten werden auf die Geometrie gesetzt…</translation>
    </message>
    <message>
      <source>Radius of the circle in the middle of the tube</source>
      <translation>Radius des Kreises in der Mitte des Rohrs</translation>
    </message>
    <message>
      <source>Radius of the cone at the point; it opens along the axis</source>
      <translation>Radius des Kegels am Punkt; er öffnet sich entlang der Achse</translation>
    </message>
    <message>
      <source>Radius of the cylinder</source>
      <translation>Radius des Zylinders</translation>
    </message>
    <message>
      <source>Radius of the hole: %1.</source>
      <translation>Radius des Lochs: %1.</translation>
    </message>
    <message>
      <source>Radius of the sphere</source>
      <translation>Radius der Kugel</translation>
    </message>
    <message>
      <source>Reading the file…</source>
      <translation>Die Datei wird gelesen…</translation>
    </message>
    <message>
      <source>Reading the mesh…</source>
      <translation>Netz wird gelesen…</translation>
    </message>
    <message>
      <source>Refine</source>
      <translation>Verfeinern</translation>
    </message>
    <message>
      <source>Refine to edges of %1 instead</source>
      <translation>Stattdessen auf Kanten von %1 verfeinern</translation>
    </message>
    <message>
      <source>Refinement</source>
      <translation>Verfeinerung</translation>
    </message>
    <message>
      <source>Refining first to edges of %1 would make %2. That is above the limit set in the preferences.</source>
      <translation>Vorher auf Kanten von %1 zu verfeinern ergäbe %2. Das ist mehr als die in den Einstellungen gesetzte Grenze.</translation>
    </message>
    <message>
      <source>Refining first, to edges of %1: %2…</source>
      <translation>Vorher wird verfeinert, auf Kanten von %1: %2…</translation>
    </message>
    <message>
      <source>Report: %1</source>
      <translation>Bericht: %1</translation>
    </message>
    <message>
      <source>Report…</source>
      <translation>Bericht…</translation>
    </message>
    <message>
      <source>Reshape</source>
      <translation>Umformen</translation>
    </message>
    <message>
      <source>Saves all rows that are shown as CSV</source>
      <translation>Speichert alle gezeigten Zeilen als CSV</translation>
    </message>
    <message>
      <source>Save…</source>
      <translation>Speichern…</translation>
    </message>
    <message>
      <source>Scaled Jacobian</source>
      <translation>Skalierte Jacobi-Determinante</translation>
    </message>
    <message>
      <source>Several FEM meshes are selected. Select one.</source>
      <translation>Mehrere FEM-Netze sind gewählt. Wählen Sie eines.</translation>
    </message>
    <message>
      <source>Show crack</source>
      <translation>Riss zeigen</translation>
    </message>
    <message>
      <source>Size</source>
      <translation>Größe</translation>
    </message>
    <message>
      <source>Smallest angle (dihedral in solids)</source>
      <translation>Kleinster Winkel (bei Volumen zwischen Seiten)</translation>
    </message>
    <message>
      <source>Sphere</source>
      <translation>Kugel</translation>
    </message>
    <message>
      <source>Status</source>
      <translation>Zustand</translation>
    </message>
    <message>
      <source>Such as Box.Length / 2. With nothing entered the field takes numbers again.</source>
      <translation>Etwa Box.Length / 2. Wird nichts eingegeben, nimmt das Feld wieder Zahlen an.</translation>
    </message>
    <message>
      <source>Take out of the analysis</source>
      <translation>Aus der Analyse nehmen</translation>
    </message>
    <message>
      <source>Text</source>
      <translation>Text</translation>
    </message>
    <message>
      <source>That edge is curved. Pick a straight or a circular edge.</source>
      <translation>Diese Kante ist gekrümmt. Wählen Sie eine gerade oder eine runde Kante.</translation>
    </message>
    <message>
      <source>That face is curved. Pick a planar face.</source>
      <translation>Diese Fläche ist gekrümmt. Wählen Sie eine ebene Fläche.</translation>
    </message>
    <message>
      <source>That face is in no group. Click another one, or make a group of it first.</source>
      <translation>Diese Fläche ist in keiner Gruppe. Klicken Sie auf eine andere, oder machen Sie zuerst eine Gruppe daraus.</translation>
    </message>
    <message>
      <source>That is %1; it must be a number, or in %2.</source>
      <translation>Das ist %1; es muss eine Zahl sein oder in %2.</translation>
    </message>
    <message>
      <source>That is no face of a part. Click one.</source>
      <translation>Das ist keine Fläche eines Teils. Klicken Sie auf eine.</translation>
    </message>
    <message>
      <source>That is not the mesh. Click a face of the mesh.</source>
      <translation>Das ist nicht das Netz. Klicken Sie auf eine Fläche des Netzes.</translation>
    </message>
    <message>
      <source>That is not the mesh. Click a node of the mesh.</source>
      <translation>Das ist nicht das Netz. Klicken Sie auf einen Knoten des Netzes.</translation>
    </message>
    <message>
      <source>The direction is zero. Give one, or pick it from the 3-D view.</source>
      <translation>Die Richtung ist null. Geben Sie eine an oder wählen Sie sie in der 3D-Ansicht.</translation>
    </message>
    <message>
      <source>The document has %1 FEM meshes. Select the one you mean in the tree.</source>
      <translation>Das Dokument hat %1 FEM-Netze. Wählen Sie das gemeinte im Baum.</translation>
    </message>
    <message>
      <source>The document has no FEM mesh. Make one in the FEM workbench, or import a mesh file.</source>
      <translation>Das Dokument hat kein FEM-Netz. Erzeugen Sie eines im Arbeitsbereich FEM oder importieren Sie eine Netzdatei.</translation>
    </message>
    <message>
      <source>The document has no other FEM mesh. Draw the part to add, and mesh it in the FEM workbench, or import a mesh file.</source>
      <translation>Das Dokument hat kein anderes FEM-Netz. Zeichnen Sie das Teil, das hinzukommt, und vernetzen Sie es im Arbeitsbereich FEM, oder importieren Sie eine Netzdatei.</translation>
    </message>
    <message>
      <source>The file holds %1 meshes. Which one?</source>
      <translation>Die Datei enthält %1 Netze. Welches?</translation>
    </message>
    <message>
      <source>The mesh has %1 pieces now, %3 before: %2.</source>
      <translation>Das Netz hat jetzt %1 Stücke, vorher %3: %2.</translation>
    </message>
    <message>
      <source>The mesh has neither faces nor volumes.</source>
      <translation>Das Netz hat weder Flächen noch Volumen.</translation>
    </message>
    <message>
      <source>The mesh has no group of faces or nodes. Make one first.</source>
      <translation>Das Netz hat keine Gruppe von Flächen oder Knoten. Machen Sie zuerst eine.</translation>
    </message>
    <message>
      <source>The mesh has no such group any more.</source>
      <translation>Diese Gruppe hat das Netz nicht mehr.</translation>
    </message>
    <message>
      <source>The numbers stay as they are when the geometry changes</source>
      <translation>Die Zahlen bleiben, wie sie sind, wenn sich die Geometrie ändert</translation>
    </message>
    <message>
      <source>The object could not be computed; see the report view.</source>
      <translation>Das Objekt konnte nicht berechnet werden; siehe die Ausgabeansicht.</translation>
    </message>
    <message>
      <source>The part falls into %1 pieces: %2.</source>
      <translation>Das Bauteil zerfällt in %1 Stücke: %2.</translation>
    </message>
    <message>
      <source>The radius must be larger than 0.</source>
      <translation>Der Radius muss größer als 0 sein.</translation>
    </message>
    <message>
      <source>The three nodes lie on a line. Pick nodes that span a plane.</source>
      <translation>Die drei Knoten liegen auf einer Geraden. Wählen Sie Knoten, die eine Ebene aufspannen.</translation>
    </message>
    <message>
      <source>The whole plane</source>
      <translation>Die ganze Ebene</translation>
    </message>
    <message>
      <source>These pages are in English.</source>
      <translation>Diese Seiten sind auf Englisch.</translation>
    </message>
    <message>
      <source>This command brings it; start FreeCAD anew then:

%1</source>
      <translation>Dieser Befehl bringt es; starten Sie FreeCAD danach neu:

%1</translation>
    </message>
    <message>
      <source>This workbench was built without its example: Gmsh was not there.</source>
      <translation>Diese Arbeitsumgebung wurde ohne ihr Beispiel gebaut: Gmsh war nicht da.</translation>
    </message>
    <message>
      <source>Through the whole part</source>
      <translation>Durch das ganze Teil</translation>
    </message>
    <message>
      <source>ToolFace is not set; choose the face of the geometry to cut with</source>
      <translation>ToolFace ist nicht gesetzt; wählen Sie die Fläche der Geometrie, mit der geschnitten wird</translation>
    </message>
    <message>
      <source>Torus</source>
      <translation>Torus</translation>
    </message>
    <message>
      <source>Type</source>
      <translation>Typ</translation>
    </message>
    <message>
      <source>Unlink</source>
      <translation>Lösen</translation>
    </message>
    <message>
      <source>Used by</source>
      <translation>Verwendet von</translation>
    </message>
    <message>
      <source>Value</source>
      <translation>Wert</translation>
    </message>
    <message>
      <source>Vector</source>
      <translation>Vektor</translation>
    </message>
    <message>
      <source>What nothing holds has no solution: hold it, or let the tool end inside the part.</source>
      <translation>Was nichts hält, hat keine Lösung: Halten Sie es fest, oder lassen Sie das Werkzeug im Bauteil enden.</translation>
    </message>
    <message>
      <source>Whether elements are divided first, and how small they become</source>
      <translation>Ob Elemente zuerst geteilt werden, und wie klein sie werden</translation>
    </message>
    <message>
      <source>Whether elements near the tool (of a crack that ends inside: near its front) are divided first</source>
      <translation>Ob Elemente nahe dem Werkzeug (bei einem Riss, der innen endet: nahe seiner Front) zuerst geteilt werden</translation>
    </message>
    <message>
      <source>Whether elements of both are divided first where the two meet</source>
      <translation>Ob Elemente von beiden zuerst geteilt werden, wo die zwei sich treffen</translation>
    </message>
    <message>
      <source>Whole part</source>
      <translation>Ganzes Teil</translation>
    </message>
    <message>
      <source>Worse than your threshold of %1.</source>
      <translation>Schlechter als Ihre Schwelle von %1.</translation>
    </message>
    <message>
      <source>Worst elements</source>
      <translation>Schlechteste Elemente</translation>
    </message>
    <message>
      <source>Writing the file…</source>
      <translation>Die Datei wird geschrieben…</translation>
    </message>
    <message>
      <source>Writing the mesh for FreeCAD…</source>
      <translation>Netz wird für FreeCAD geschrieben…</translation>
    </message>
    <message>
      <source>a second-order element near (%1) would be folded where the two meet: they are too coarse there for how they are curved. Refine both there first, or move the addition a little</source>
      <translation>Ein Element zweiter Ordnung bei (%1) würde gefaltet, wo sich die beiden treffen: Sie sind dort zu grob für ihre Krümmung. Verfeinern Sie zuerst beide dort, oder verschieben Sie das hinzukommende Netz ein wenig</translation>
    </message>
    <message>
      <source>a slot of width %1 removes nothing: it is narrower than what the elements there can show. Make it wider, or refine the mesh there first</source>
      <translation>Ein Schlitz der Breite %1 nimmt nichts weg: Er ist schmaler, als die Elemente dort zeigen können. Machen Sie ihn breiter, oder verfeinern Sie das Netz dort zuerst</translation>
    </message>
    <message>
      <source>all kept</source>
      <translation>alle bleiben</translation>
    </message>
    <message>
      <source>along: edges meet at (%1), a convex and a concave one: these cannot be rounded at once. Round one after the other</source>
      <translation>Kanten treffen sich bei (%1), eine nach außen und eine nach innen gewölbte: Diese lassen sich nicht zugleich runden. Runden Sie eine nach der anderen</translation>
    </message>
    <message>
      <source>along: group '%1' is no edge: no feature line of the skin (sharper than feature_angle) runs along it</source>
      <translation>Die Gruppe „%1“ ist keine Kante: Keine Kante der Oberfläche (schärfer als der Grenzwinkel) läuft an ihr entlang</translation>
    </message>
    <message>
      <source>along: no feature line of the skin is within an edge length of the point (%1): the nearest is near (%2). Name a point on the edge</source>
      <translation>Keine Kante der Oberfläche ist innerhalb einer Elementkante vom Punkt (%1): Die nächste ist bei (%2). Wählen Sie einen Punkt auf der Kante</translation>
    </message>
    <message>
      <source>and %1 other combinations of groups</source>
      <translation>und %1 andere Kombinationen von Gruppen</translation>
    </message>
    <message>
      <source>back, +y</source>
      <translation>hinten, +y</translation>
    </message>
    <message>
      <source>beams</source>
      <translation>Balken</translation>
    </message>
    <message>
      <source>became empty</source>
      <translation>leer geworden</translation>
    </message>
    <message>
      <source>border between groups</source>
      <translation>Rand zwischen Gruppen</translation>
    </message>
    <message>
      <source>border of what is made</source>
      <translation>Rand des Neuen</translation>
    </message>
    <message>
      <source>bottom, -z</source>
      <translation>unten, -z</translation>
    </message>
    <message>
      <source>by a vector</source>
      <translation>um einen Vektor</translation>
    </message>
    <message>
      <source>changed</source>
      <translation>geändert</translation>
    </message>
    <message>
      <source>changed elements, poor to good (mean ratio 0 to 1)</source>
      <translation>geänderte Elemente, schlecht bis gut (Mean ratio 0 bis 1)</translation>
    </message>
    <message>
      <source>cone</source>
      <translation>Kegel</translation>
    </message>
    <message>
      <source>crack of %1</source>
      <translation>Riss: %1</translation>
    </message>
    <message>
      <source>cut off the addition</source>
      <translation>vom Zusatz abschneiden</translation>
    </message>
    <message>
      <source>cut off the mesh</source>
      <translation>vom Netz abschneiden</translation>
    </message>
    <message>
      <source>cylinder</source>
      <translation>Zylinder</translation>
    </message>
    <message>
      <source>deform: only move nodes</source>
      <translation>deform: nur Knoten bewegen</translation>
    </message>
    <message>
      <source>depth is %1; it must be positive</source>
      <translation>Die Tiefe ist %1; sie muss positiv sein</translation>
    </message>
    <message>
      <source>disk</source>
      <translation>Kreisscheibe</translation>
    </message>
    <message>
      <source>edges</source>
      <translation>Kanten</translation>
    </message>
    <message>
      <source>ellipse</source>
      <translation>Ellipse</translation>
    </message>
    <message>
      <source>empty</source>
      <translation>leer</translation>
    </message>
    <message>
      <source>existing crack: %1</source>
      <translation>vorhandener Riss: %1</translation>
    </message>
    <message>
      <source>face</source>
      <translation>Fläche</translation>
    </message>
    <message>
      <source>faces</source>
      <translation>Flächen</translation>
    </message>
    <message>
      <source>facets</source>
      <translation>Facetten</translation>
    </message>
    <message>
      <source>from %1</source>
      <translation>von %1</translation>
    </message>
    <message>
      <source>from %1, size included</source>
      <translation>von %1, auch die Größe</translation>
    </message>
    <message>
      <source>front of %1</source>
      <translation>Front: %1</translation>
    </message>
    <message>
      <source>front, -y</source>
      <translation>vorne, -y</translation>
    </message>
    <message>
      <source>front: the crack ends here</source>
      <translation>Front: hier endet der Riss</translation>
    </message>
    <message>
      <source>held by %1</source>
      <translation>gehalten von %1</translation>
    </message>
    <message>
      <source>hexahedra</source>
      <translation>Hexaeder</translation>
    </message>
    <message>
      <source>in no group</source>
      <translation>in keiner Gruppe</translation>
    </message>
    <message>
      <source>kept</source>
      <translation>erhalten</translation>
    </message>
    <message>
      <source>kept where ticked</source>
      <translation>angekreuzte bleiben</translation>
    </message>
    <message>
      <source>left, -x</source>
      <translation>links, -x</translation>
    </message>
    <message>
      <source>mean ratio; line: before</source>
      <translation>Mean ratio; Linie: vorher</translation>
    </message>
    <message>
      <source>middle</source>
      <translation>Mitte</translation>
    </message>
    <message>
      <source>more than %1 elements</source>
      <translation>mehr als %1 Elemente</translation>
    </message>
    <message>
      <source>moved nodes</source>
      <translation>verschobene Knoten</translation>
    </message>
    <message>
      <source>name '%1' has a character other than letters, digits, '_', '-' and '.'; solvers would not accept its groups</source>
      <translation>Der Name „%1“ hat ein anderes Zeichen als Buchstaben, Ziffern, „_“, „-“ und „.“; Löser würden seine Gruppen nicht annehmen</translation>
    </message>
    <message>
      <source>name '%1' is taken: the mesh already has a group '%2'; choose another</source>
      <translation>Der Name „%1“ ist vergeben: Das Netz hat schon eine Gruppe „%2“; wählen Sie einen anderen</translation>
    </message>
    <message>
      <source>name '%1' is too long: group '%2' would have %3 characters, at most %4 are allowed</source>
      <translation>Der Name „%1“ ist zu lang: Die Gruppe „%2“ hätte %3 Zeichen, höchstens %4 sind erlaubt</translation>
    </message>
    <message>
      <source>name is empty; the new groups need one</source>
      <translation>Der Name ist leer; die neuen Gruppen brauchen einen</translation>
    </message>
    <message>
      <source>negative</source>
      <translation>negativen</translation>
    </message>
    <message>
      <source>neither Along nor AlongPoints says which edge is rounded; give one</source>
      <translation>Weder Along noch AlongPoints sagt, welche Kante gerundet wird; geben Sie eins an</translation>
    </message>
    <message>
      <source>never</source>
      <translation>nie</translation>
    </message>
    <message>
      <source>new</source>
      <translation>neu</translation>
    </message>
    <message>
      <source>nodes</source>
      <translation>Knoten</translation>
    </message>
    <message>
      <source>nodes of the two near (%1) cannot be made one: an element there would be flat. Refine both there first, or move the addition a little</source>
      <translation>Knoten der beiden bei (%1) können nicht einer werden: Ein Element dort würde flach. Verfeinern Sie zuerst beide dort, oder verschieben Sie das hinzukommende Netz ein wenig</translation>
    </message>
    <message>
      <source>none</source>
      <translation>keines</translation>
    </message>
    <message>
      <source>none picked yet</source>
      <translation>noch nichts gewählt</translation>
    </message>
    <message>
      <source>none yet</source>
      <translation>noch keines</translation>
    </message>
    <message>
      <source>not in FreeCAD's mesh, but kept with it for operations and export: %1</source>
      <translation>nicht in FreeCADs Netz, aber damit bewahrt für Operationen und Export: %1</translation>
    </message>
    <message>
      <source>nothing holds %1 of them</source>
      <translation>%1 davon hält nichts</translation>
    </message>
    <message>
      <source>nothing holds it</source>
      <translation>nichts hält es</translation>
    </message>
    <message>
      <source>off</source>
      <translation>aus</translation>
    </message>
    <message>
      <source>onto a surface</source>
      <translation>auf eine Fläche</translation>
    </message>
    <message>
      <source>plane</source>
      <translation>Ebene</translation>
    </message>
    <message>
      <source>points</source>
      <translation>Punkte</translation>
    </message>
    <message>
      <source>positive</source>
      <translation>positiven</translation>
    </message>
    <message>
      <source>prisms</source>
      <translation>Prismen</translation>
    </message>
    <message>
      <source>pyramids</source>
      <translation>Pyramiden</translation>
    </message>
    <message>
      <source>quadrangles</source>
      <translation>Vierecke</translation>
    </message>
    <message>
      <source>radius is %1; it must be a positive length</source>
      <translation>Der Radius ist %1; er muss eine positive Länge sein</translation>
    </message>
    <message>
      <source>radius: %1 is too large for a face beside the edge, which ends, or is not what it is at the edge, before the distance of %2 at which it would be touched. There is room for about %3, near (%4)</source>
      <translation>Der Radius %1 ist zu groß für eine Fläche an der Kante: Sie endet vor dem Abstand %2, in dem sie berührt würde, oder ist dort anders als an der Kante. Platz ist für etwa %3, bei (%4)</translation>
    </message>
    <message>
      <source>reduced</source>
      <translation>verkleinert</translation>
    </message>
    <message>
      <source>removed</source>
      <translation>entfernt</translation>
    </message>
    <message>
      <source>right, +x</source>
      <translation>rechts, +x</translation>
    </message>
    <message>
      <source>scaled about a point</source>
      <translation>um einen Punkt skaliert</translation>
    </message>
    <message>
      <source>size %1 would make more than %2 elements. Choose a larger size or gradation, or a larger max_elements</source>
      <translation>Die Kantenlänge %1 würde mehr als %2 Elemente ergeben. Wählen Sie eine größere Länge oder einen größeren Anstieg</translation>
    </message>
    <message>
      <source>size is %1; it must be a positive length</source>
      <translation>Die Kantenlänge ist %1; sie muss positiv sein</translation>
    </message>
    <message>
      <source>snap: move and split</source>
      <translation>snap: bewegen und teilen</translation>
    </message>
    <message>
      <source>some %1 elements</source>
      <translation>etwa %1 Elemente</translation>
    </message>
    <message>
      <source>sphere</source>
      <translation>Kugel</translation>
    </message>
    <message>
      <source>the %1 is smaller than the elements there, and parts none of them. Refine the mesh there first, or move the %1 into the material</source>
      <translation>Das Werkzeug (%1) ist kleiner als die Elemente dort und trennt keines. Verfeinern Sie das Netz dort zuerst, oder verschieben Sie es ins Material</translation>
    </message>
    <message>
      <source>the %1 lies inside %2, between their nodes, and parts none of them: it is smaller than the elements there. Refine the mesh there first</source>
      <translation>Das Werkzeug (%1) liegt innerhalb von %2, zwischen deren Knoten, und trennt keines: Es ist kleiner als die Elemente dort. Verfeinern Sie das Netz dort zuerst</translation>
    </message>
    <message>
      <source>the %1 lies on faces that are open already: the elements on its two sides have nodes of their own there (a contact, or an earlier crack), and there is nothing to part. Move the %1 into the material</source>
      <translation>Das Werkzeug (%1) liegt auf Flächen, die schon offen sind: Die Elemente auf beiden Seiten haben dort eigene Knoten (ein Kontakt oder ein früherer Riss), und es ist nichts zu trennen. Verschieben Sie es ins Material</translation>
    </message>
    <message>
      <source>the %1 meets a surface or group border at %2: elements in the wedge between them cannot be better than the wedge</source>
      <translation>Das Werkzeug (%1) trifft eine Oberfläche oder einen Gruppenrand unter %2: Elemente in dem Keil dazwischen können nicht besser sein als der Keil</translation>
    </message>
    <message>
      <source>the %1 meets the mesh only outside the part of it that is to cut. Move that part into the material</source>
      <translation>Das Werkzeug (%1) trifft das Netz nur außerhalb des Teils, der schneiden soll. Verschieben Sie diesen Teil ins Material</translation>
    </message>
    <message>
      <source>the %1 misses the mesh: it passes between parts of the mesh, through no element; the nearest nodes are at distance %2 on its negative side and %3 on its positive side. Move the %1 or turn it</source>
      <translation>Das Werkzeug (%1) verfehlt das Netz: Es geht zwischen Teilen des Netzes hindurch, durch kein Element; die nächsten Knoten sind %2 auf seiner negativen und %3 auf seiner positiven Seite entfernt. Verschieben oder drehen Sie es</translation>
    </message>
    <message>
      <source>the %1 misses the mesh: it passes only through segments (%2), which cannot be divided (springs, dashpots, gaps). Move the %1 or turn it</source>
      <translation>Das Werkzeug (%1) verfehlt das Netz: Es geht nur durch Strecken (%2), die sich nicht teilen lassen (Federn, Dämpfer, Spalte). Verschieben oder drehen Sie es</translation>
    </message>
    <message>
      <source>the %1 misses the mesh: the whole mesh lies on its %2 side, the nearest node at distance %3. Move the %1 or turn it</source>
      <translation>Das Werkzeug (%1) verfehlt das Netz: Das ganze Netz liegt auf seiner %2 Seite, der nächste Knoten ist %3 entfernt. Verschieben oder drehen Sie es</translation>
    </message>
    <message>
      <source>the %1 only grazes the mesh: it passes through the curved sides of %2, but between none of their corners. Move the %1 into the material</source>
      <translation>Das Werkzeug (%1) streift das Netz nur: Es geht durch die gekrümmten Seiten von %2, aber zwischen keinen ihrer Ecken hindurch. Verschieben Sie es ins Material</translation>
    </message>
    <message>
      <source>the %1 only grazes the mesh: what it would cut off is thinner than the elements there. Move the %1 into the material</source>
      <translation>Das Werkzeug (%1) streift das Netz nur: Was es abschneiden würde, ist dünner als die Elemente dort. Verschieben Sie es ins Material</translation>
    </message>
    <message>
      <source>the %1 only touches the mesh, along edges or in single nodes: it passes through no element and along no face. Move the %1 into the material</source>
      <translation>Das Werkzeug (%1) berührt das Netz nur, an Kanten oder in einzelnen Knoten: Es geht durch kein Element und an keiner Elementfläche entlang. Verschieben Sie es ins Material</translation>
    </message>
    <message>
      <source>the %1 only touches the mesh, on its outside: all elements there are on its %2 side, and there is nothing to part. Move the %1 into the material</source>
      <translation>Das Werkzeug (%1) berührt das Netz nur, an seiner Außenseite: Alle Elemente dort liegen auf der %2 Seite des Werkzeugs, und es ist nichts zu trennen. Verschieben Sie es ins Material</translation>
    </message>
    <message>
      <source>the %1 removes nothing: it is smaller than the elements there, and none lies inside. Refine the mesh there first, or move the %1 into the material</source>
      <translation>Das Werkzeug (%1) nimmt nichts weg: Es ist kleiner als die Elemente dort, und keines liegt in ihm. Verfeinern Sie das Netz dort zuerst, oder verschieben Sie es ins Material</translation>
    </message>
    <message>
      <source>the %1 removes nothing: it touches the mesh from outside, and no element lies inside. Move the %1 into the material</source>
      <translation>Das Werkzeug (%1) nimmt nichts weg: Es berührt das Netz von außen, und kein Element liegt in ihm. Verschieben Sie es ins Material</translation>
    </message>
    <message>
      <source>the %1 removes nothing: what it would take off is thinner than the elements there. Refine the mesh there, or move the %1 into the material</source>
      <translation>Das Werkzeug (%1) nimmt nichts weg: Was es abnehmen würde, ist dünner als die Elemente dort. Verfeinern Sie das Netz dort, oder verschieben Sie es ins Material</translation>
    </message>
    <message>
      <source>the %1 runs along a feature line or border line at %2: elements between them cannot be better than that wedge</source>
      <translation>Das Werkzeug (%1) läuft unter %2 an einer Kante oder einem Rand entlang: Elemente dazwischen können nicht besser sein als dieser Keil</translation>
    </message>
    <message>
      <source>the %1 runs within 0.15 edge lengths of a nearly parallel surface or group border at %2 node(s): the layer between them is that thin</source>
      <translation>Das Werkzeug (%1) läuft an %2 Knoten näher als 0,15 Kantenlängen an einer fast parallelen Oberfläche oder einem Gruppenrand: So dünn ist die Schicht dazwischen</translation>
    </message>
    <message>
      <source>the %1 would remove the whole mesh: all of it lies inside. Make the tool smaller, or move it</source>
      <translation>Das Werkzeug (%1) würde das ganze Netz wegnehmen: Alles liegt in ihm. Machen Sie das Werkzeug kleiner, oder verschieben Sie es</translation>
    </message>
    <message>
      <source>the addition does not meet the mesh: nowhere do their surfaces cross, and no border of the one is on the other. The mesh reaches from (%1) to (%2), the addition from (%3) to (%4). Move the addition, or give a larger tolerance</source>
      <translation>Das Hinzugefügte trifft das Netz nicht: Nirgends kreuzen sich ihre Oberflächen, und kein Rand des einen liegt auf dem anderen. Das Netz reicht von (%1) bis (%2), das Hinzugefügte von (%3) bis (%4). Verschieben Sie es, oder geben Sie eine größere Toleranz an</translation>
    </message>
    <message>
      <source>the addition is finer than the mesh, which was refined first, to edges of %1 where they meet: from %2 to %3 elements</source>
      <translation>Das hinzukommende Netz ist feiner als das Netz; dieses wurde zuerst verfeinert, auf Kanten von %1, wo sie sich treffen: von %2 auf %3 Elemente</translation>
    </message>
    <message>
      <source>the addition is so much finer than the mesh that this would be refined from %1 to %2 elements, with edges of %3 where they meet. Give refine=%4, a longer edge there, or False for none; or mesh the finer one coarser, or add it as a shell</source>
      <translation>Das hinzukommende Netz ist so viel feiner als das Netz, dass dieses von %1 auf %2 Elemente verfeinert würde, mit Kanten von %3, wo sie sich treffen. Wählen Sie unter „Erst verfeinern“ eine Kantenlänge von %4, oder „nie“; oder vernetzen Sie das feinere gröber, oder fügen Sie es als Schale hinzu</translation>
    </message>
    <message>
      <source>the addition: along the seam its own curved skin is left by up to %1 (%2 edge(s)): the mesh is not flat there, or its elements have no room for curves. Refine both there first</source>
      <translation>Das hinzukommende Netz: Entlang der Naht wird seine eigene gekrümmte Oberfläche um bis zu %1 verlassen (%2 Kante(n)): Das Netz ist dort nicht eben, oder seine Elemente haben keinen Platz für Bögen. Verfeinern Sie zuerst beide dort</translation>
    </message>
    <message>
      <source>the crack along the %1 cannot open: all its nodes are on its front. Refine the mesh there first</source>
      <translation>Der Riss (%1) kann sich nicht öffnen: Alle seine Knoten liegen auf seiner Front. Verfeinern Sie das Netz dort zuerst</translation>
    </message>
    <message>
      <source>the crack lies outside the part: there is no material within its front. Move it into the material</source>
      <translation>Der Riss liegt außerhalb des Teils: Innerhalb seiner Front ist kein Material. Verschieben Sie ihn ins Material</translation>
    </message>
    <message>
      <source>the edge cannot be rounded near (%1): a border of groups, or another surface that is kept, runs through the material there, and does not cross the edge in one plane</source>
      <translation>Die Kante kann bei (%1) nicht gerundet werden: Ein Gruppenrand oder eine andere Fläche, die erhalten bleibt, läuft dort durch das Material und kreuzt die Kante nicht in einer Ebene</translation>
    </message>
    <message>
      <source>the edge goes on beyond what was named, and is rounded as far as it goes</source>
      <translation>Die Kante geht über das Gewählte hinaus weiter und wird gerundet, so weit sie geht</translation>
    </message>
    <message>
      <source>the mesh already has %1 flat or inverted element(s) near the tool (%2); repair the mesh first</source>
      <translation>Das Netz hat schon %1 flache oder umgestülpte Element(e) beim Werkzeug (%2); reparieren Sie zuerst das Netz</translation>
    </message>
    <message>
      <source>the mesh has no group '%1'</source>
      <translation>Das Netz hat keine Gruppe „%1“</translation>
    </message>
    <message>
      <source>the mesh is coarse for the %1 of radius %2: the flat faces of the wall leave about %3 % of the hole standing. Refine the mesh there first, to edges of at most %4</source>
      <translation>Das Netz ist grob für das Werkzeug (%1) mit dem Radius %2: Die ebenen Flächen der Wand lassen etwa %3 % des Lochs stehen. Verfeinern Sie das Netz dort zuerst, auf Kanten von höchstens %4</translation>
    </message>
    <message>
      <source>the mesh is finer than the addition, which was refined first, to edges of %1 where they meet: from %2 to %3 elements</source>
      <translation>Das Netz ist feiner als das hinzukommende; dieses wurde zuerst verfeinert, auf Kanten von %1, wo sie sich treffen: von %2 auf %3 Elemente</translation>
    </message>
    <message>
      <source>the mesh is not the one that was imported any more: what the file held beside nodes, elements and groups (a deck's cards, fields, groups of element faces) is not written</source>
      <translation>das Netz ist nicht mehr das importierte: Was die Datei außer Knoten, Elementen und Gruppen enthielt (Karten einer Eingabe, Felder, Gruppen von Elementflächen), wird nicht geschrieben</translation>
    </message>
    <message>
      <source>the mesh is so much finer than the addition that this would be refined from %1 to %2 elements, with edges of %3 where they meet. Give refine=%4, a longer edge there, or False for none; or mesh the finer one coarser, or add it as a shell</source>
      <translation>Das Netz ist so viel feiner als das hinzukommende, dass dieses von %1 auf %2 Elemente verfeinert würde, mit Kanten von %3, wo sie sich treffen. Wählen Sie unter „Erst verfeinern“ eine Kantenlänge von %4, oder „nie“; oder vernetzen Sie das feinere gröber, oder fügen Sie es als Schale hinzu</translation>
    </message>
    <message>
      <source>the mesh is too coarse for the %1 of radius %2 near (%3): an element with edges of %4 would reach deep into it. Refine the mesh there first, to edges of at most %5</source>
      <translation>Das Netz ist bei (%3) zu grob für das Werkzeug (%1) mit dem Radius %2: Ein Element mit Kanten von %4 würde weit hineinreichen. Verfeinern Sie das Netz dort zuerst, auf Kanten von höchstens %5</translation>
    </message>
    <message>
      <source>the mesh is too coarse for the %1 of radius %2 near (%3): an element with edges of %4 would reach deep into it. Refine the mesh there first, to edges of at most %5, or move the tool: it may nearly touch a border or the skin there, and leave only a thin layer of material</source>
      <translation>Das Netz ist bei (%3) zu grob für das Werkzeug (%1) mit dem Radius %2: Ein Element mit Kanten von %4 würde weit hineinreichen. Verfeinern Sie das Netz dort zuerst, auf Kanten von höchstens %5, oder verschieben Sie das Werkzeug: Vielleicht berührt es dort fast einen Rand oder die Oberfläche und lässt nur eine dünne Schicht Material</translation>
    </message>
    <message>
      <source>the mesh is too coarse for the crack: its front would be cut short by up to %1. Refine the mesh near the crack front first, or make the crack larger</source>
      <translation>Das Netz ist zu grob für den Riss: Seine Front würde um bis zu %1 gekürzt. Verfeinern Sie das Netz bei der Rissfront zuerst, oder machen Sie den Riss größer</translation>
    </message>
    <message>
      <source>the mesh is too coarse for the crack: no element face fits in it. Refine the mesh near the crack front first, or make the crack larger</source>
      <translation>Das Netz ist zu grob für den Riss: Keine Elementfläche passt in ihn. Verfeinern Sie das Netz bei der Rissfront zuerst, oder machen Sie den Riss größer</translation>
    </message>
    <message>
      <source>the mesh that '%1' is made from is in no analysis</source>
      <translation>Das Netz, aus dem „%1“ gemacht ist, ist in keiner Analyse</translation>
    </message>
    <message>
      <source>the new group '%1' would be taken for the nodes of '%2'; choose another GroupName</source>
      <translation>Die neue Gruppe „%1“ würde für die Knoten von „%2“ gehalten; wählen Sie einen anderen GroupName</translation>
    </message>
    <message>
      <source>the results of '%1' are removed; solve again</source>
      <translation>Die Ergebnisse von „%1“ wurden entfernt; lösen Sie neu</translation>
    </message>
    <message>
      <source>the tool is finer than the mesh, which was refined first, to edges of %1 near the tool: from %2 to %3 elements. refine=%4 makes fewer, refine=False none, but then a coarser wall or front</source>
      <translation>Das Werkzeug ist feiner als das Netz; dieses wurde zuerst verfeinert, auf Kanten von %1 am Werkzeug: von %2 auf %3 Elemente. Eine Kantenlänge von %4 unter „Erst verfeinern“ ergibt weniger, „nie“ keine, aber dann eine gröbere Wand oder Front</translation>
    </message>
    <message>
      <source>the wall %1 (%2) lies beyond the part: what is removed reaches right through there</source>
      <translation>Die Wand %1 (%2) liegt jenseits des Teils: Was weggenommen wird, reicht dort ganz hindurch</translation>
    </message>
    <message>
      <source>the wall cannot be moved so far: it would pass through the part, and leave it on another side near (%1). Move it less</source>
      <translation>Die Wand kann nicht so weit verschoben werden: Sie ginge durch das Teil hindurch und bei (%1) auf einer anderen Seite hinaus. Verschieben Sie sie weniger</translation>
    </message>
    <message>
      <source>to an edge length</source>
      <translation>bis zu einer Kantenlänge</translation>
    </message>
    <message>
      <source>top, +z</source>
      <translation>oben, +z</translation>
    </message>
    <message>
      <source>torus</source>
      <translation>Torus</translation>
    </message>
    <message>
      <source>triangles of seven nodes</source>
      <translation>Dreiecke mit sieben Knoten</translation>
    </message>
    <message>
      <source>unchanged</source>
      <translation>unverändert</translation>
    </message>
    <message>
      <source>untouched</source>
      <translation>unberührt</translation>
    </message>
    <message>
      <source>volumes</source>
      <translation>Volumen</translation>
    </message>
    <message>
      <source>wall of %1</source>
      <translation>Wand: %1</translation>
    </message>
    <message>
      <source>where one of them is finer</source>
      <translation>wo eins von beiden feiner ist</translation>
    </message>
    <message>
      <source>where the tool is finer</source>
      <translation>wo das Werkzeug feiner ist</translation>
    </message>
    <message>
      <source>width is %1; it must be positive</source>
      <translation>Die Breite ist %1; sie muss positiv sein</translation>
    </message>
    <message>
      <source>with groups %1</source>
      <translation>mit Gruppen %1</translation>
    </message>
    <message>
      <source>worst %1</source>
      <translation>schlechtestes %1</translation>
    </message>
  </context>
  <context>
    <name>FemScalpelPreferences</name>
    <message>
      <source> MB</source>
      <translation> MB</translation>
    </message>
    <message>
      <source>Ask before refining takes more memory than</source>
      <translation>Fragen, bevor Verfeinern mehr Speicher braucht als</translation>
    </message>
    <message>
      <source>Ask before refining to more elements than</source>
      <translation>Fragen, bevor Verfeinern mehr Elemente ergibt als</translation>
    </message>
    <message>
      <source>Borders of groups</source>
      <translation>Gruppenränder</translation>
    </message>
    <message>
      <source>Chosen group</source>
      <translation>Gewählte Gruppe</translation>
    </message>
    <message>
      <source>Colours of the preview</source>
      <translation>Farben der Vorschau</translation>
    </message>
    <message>
      <source>Crack and walls</source>
      <translation>Riss und Wände</translation>
    </message>
    <message>
      <source>Crack front</source>
      <translation>Rissfront</translation>
    </message>
    <message>
      <source>General</source>
      <translation>Allgemein</translation>
    </message>
    <message>
      <source>Method</source>
      <translation>Verfahren</translation>
    </message>
    <message>
      <source>Moved nodes</source>
      <translation>Bewegte Knoten</translation>
    </message>
    <message>
      <source>New operations</source>
      <translation>Neue Operationen</translation>
    </message>
    <message>
      <source>Put new meshes in place of their source in the analysis</source>
      <translation>Neue Netze in der Analyse an die Stelle ihrer Quelle setzen</translation>
    </message>
    <message>
      <source>Removed elements</source>
      <translation>Entfernte Elemente</translation>
    </message>
    <message>
      <source>Transition (rings of elements that may move)</source>
      <translation>Übergang (Ringe von Elementen, die sich bewegen dürfen)</translation>
    </message>
    <message>
      <source>Warn of elements with a mean ratio below</source>
      <translation>Warnen vor Elementen mit Mean ratio unter</translation>
    </message>
    <message>
      <source>automatic</source>
      <translation>automatisch</translation>
    </message>
    <message>
      <source>deform: only move nodes</source>
      <translation>deform: nur Knoten bewegen</translation>
    </message>
    <message>
      <source>half of what is free</source>
      <translation>die Hälfte des freien</translation>
    </message>
    <message>
      <source>snap: move and split</source>
      <translation>snap: bewegen und teilen</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Crack</name>
    <message>
      <source>Crack</source>
      <translation>Riss</translation>
    </message>
    <message>
      <source>Cracks the FEM mesh along a plane and keeps its groups</source>
      <translation>Reißt das FEM-Netz entlang einer Ebene auf und erhält seine Gruppen</translation>
    </message>
    <message>
      <source>Opens the FEM mesh along a plane. Give the plane by numbers, pick it from the view (three nodes, a planar face, an edge, a datum, a sketch, the view direction) or drag the handles; the preview shows the mesh as it will be. OK makes an object that follows its source mesh. The faces of both lips become groups; all other groups keep their meaning.</source>
      <translation>Öffnet das FEM-Netz entlang einer Ebene. Die Ebene durch Zahlen angeben, aus der Ansicht holen (drei Knoten, ebene Fläche, Kante, Bezugselement, Skizze, Blickrichtung) oder an den Griffen ziehen; die Vorschau zeigt das Netz, wie es wird. OK macht ein Objekt, das seinem Ausgangsnetz folgt. Die Flächen beider Ufer werden Gruppen; alle anderen Gruppen behalten ihre Bedeutung.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_CurvedCrack</name>
    <message>
      <source>Cracks the FEM mesh along a sphere, torus, cone or face of a part and keeps its groups</source>
      <translation>Reißt das FEM-Netz entlang einer Kugel, eines Torus, eines Kegels oder der Fläche eines Teils auf und erhält seine Gruppen</translation>
    </message>
    <message>
      <source>Curved crack</source>
      <translation>Gekrümmter Riss</translation>
    </message>
    <message>
      <source>Opens the FEM mesh along a sphere, torus, cone or cylinder, given by numbers, picked from the view or dragged by its handles; or along faces of a part drawn in FreeCAD: as far as these go, and where they end inside the material is the crack front. Faces that are selected before are taken. The preview shows the mesh as it will be; the faces of both lips become groups; all other groups keep their meaning.</source>
      <translation>Öffnet das FEM-Netz entlang einer Kugel, eines Torus, eines Kegels oder eines Zylinders, durch Zahlen angegeben, aus der Ansicht gewählt oder an den Griffen gezogen; oder entlang von Flächen eines in FreeCAD gezeichneten Teils: so weit diese reichen, und wo sie im Material enden, ist die Rissfront. Vorher gewählte Flächen werden genommen. Die Vorschau zeigt das Netz, wie es wird; die Flächen beider Ufer werden Gruppen; alle anderen Gruppen behalten ihre Bedeutung.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_CylindricalCrack</name>
    <message>
      <source>Cracks the FEM mesh along a cylinder and keeps its groups</source>
      <translation>Reißt das FEM-Netz entlang eines Zylinders auf und erhält seine Gruppen</translation>
    </message>
    <message>
      <source>Cylindrical crack</source>
      <translation>Zylindrischer Riss</translation>
    </message>
    <message>
      <source>Opens the FEM mesh along a cylinder. Give axis and radius by numbers, pick them from the view (a cylindrical face, a straight or circular edge, two nodes, a point on a face) or drag the handles. It may crack between two heights and two angles only. Elements that are large for the cylinder are divided first.</source>
      <translation>Öffnet das FEM-Netz entlang eines Zylinders. Geben Sie Achse und Radius in Zahlen ein, wählen Sie sie in der Ansicht (eine Zylinderfläche, eine gerade oder kreisförmige Kante, zwei Knoten, ein Punkt auf einer Fläche) oder ziehen Sie die Griffe. Er kann auch nur zwischen zwei Höhen und zwei Winkeln reißen. Elemente, die für den Zylinder groß sind, werden zuerst geteilt.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Drill</name>
    <message>
      <source>Drill</source>
      <translation>Bohrung</translation>
    </message>
    <message>
      <source>Drills a hole into the FEM mesh and keeps its groups</source>
      <translation>Bohrt ein Loch in das FEM-Netz und erhält seine Gruppen</translation>
    </message>
    <message>
      <source>Drills a hole, through or to a depth. Give axis and radius as for a cylindrical crack; the elements that go are shown as ghosts. The faces of the wall become a group; groups lose what is drilled away and nothing else, and the report says which.</source>
      <translation>Bohrt ein Loch, durchgehend oder bis zu einer Tiefe. Achse und Radius werden wie beim zylindrischen Riss angegeben; die Elemente, die wegfallen, erscheinen durchscheinend. Die Flächen der Wand werden eine Gruppe; Gruppen verlieren, was weggebohrt wird, und sonst nichts, und der Bericht sagt, welche.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Example</name>
    <message>
      <source>Example: caisson</source>
      <translation>Beispiel: Kastenträger</translation>
    </message>
    <message>
      <source>Opens a new document with the mesh of a caisson that hangs on stiffeners, in an analysis: tetrahedra with groups for parts, supports, loads and gauges. Crack a hanger, drill the floor, look at the groups before and after.</source>
      <translation>Öffnet ein neues Dokument mit dem Netz eines an Steifen hängenden Kastenträgers in einer Analyse: Tetraeder mit Gruppen für Teile, Lager, Lasten und Messstellen. Reißen Sie einen Hänger ein, bohren Sie den Boden an, vergleichen Sie die Gruppen vorher und nachher.</translation>
    </message>
    <message>
      <source>Opens a welded caisson as a new document, a mesh with 35 groups to try the commands on</source>
      <translation>Öffnet einen geschweißten Kastenträger als neues Dokument, ein Netz mit 35 Gruppen zum Ausprobieren der Befehle</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Export</name>
    <message>
      <source>Export mesh…</source>
      <translation>Netz exportieren…</translation>
    </message>
    <message>
      <source>Writes the FEM mesh with its groups to a file, in a format of solvers or viewers</source>
      <translation>Schreibt das FEM-Netz mit seinen Gruppen in eine Datei, in einem Format von Lösern oder Betrachtern</translation>
    </message>
    <message>
      <source>Writes the mesh with its groups to a file whose ending says the format. The file dialog lists the formats.</source>
      <translation>Schreibt das Netz mit seinen Gruppen in eine Datei, deren Endung das Format bestimmt. Der Dateidialog zählt die Formate auf.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_FaceCrack</name>
    <message>
      <source>Crack along faces</source>
      <translation>Riss entlang Flächen</translation>
    </message>
    <message>
      <source>Cracks the FEM mesh along faces that it has, those of a group</source>
      <translation>Reißt das FEM-Netz entlang vorhandener Flächen auf, denen einer Gruppe</translation>
    </message>
    <message>
      <source>Opens the FEM mesh along faces between its elements. Choose a group of such faces (of a shell: of edges), or of their nodes; elements may be of any type, and none moves or is divided. OK makes an object that follows its source mesh. The faces of both lips become groups; all other groups keep their meaning.</source>
      <translation>Öffnet das FEM-Netz entlang von Flächen zwischen seinen Elementen. Wählen Sie eine Gruppe solcher Flächen (einer Schale: von Kanten) oder ihrer Knoten; die Elemente dürfen von jedem Typ sein, keines wird verschoben oder geteilt. OK macht ein Objekt, das seinem Ausgangsnetz folgt. Die Flächen beider Ufer werden Gruppen; alle anderen Gruppen behalten ihre Bedeutung.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Fillet</name>
    <message>
      <source>Fillet</source>
      <translation>Rundung</translation>
    </message>
    <message>
      <source>Rounds an edge, convex or concave, as a ball of the radius would that rolls along it. Click near the edge in the 3-D view, or choose a group on it; it is rounded as far as it goes on without a corner. The faces of the rounding become a group, and the groups beside it keep to their sides.</source>
      <translation>Rundet eine Kante, konvex oder konkav, wie eine Kugel des Radius, die an ihr entlangrollt. Klicken Sie in der 3D-Ansicht nahe an die Kante, oder wählen Sie eine Gruppe auf ihr; sie wird so weit gerundet, wie sie ohne Ecke weiterläuft. Die Flächen der Rundung werden eine Gruppe, und die Gruppen daneben bleiben auf ihrer Seite.</translation>
    </message>
    <message>
      <source>Rounds edges of the FEM mesh and keeps its groups</source>
      <translation>Rundet Kanten des FEM-Netzes und erhält seine Gruppen</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_GroupInspector</name>
    <message>
      <source>Group inspector</source>
      <translation>Gruppen-Inspektor</translation>
    </message>
    <message>
      <source>Lists the groups of the FEM mesh with kind, size, measure and what uses them. Tick groups to see them, double-click a name to rename the group and a colour to change it. Elementary groups are the entities that are in exactly the same groups; bounding, linking and isolated entities are what an operation must keep in shape.</source>
      <translation>Zählt die Gruppen des FEM-Netzes auf, mit Art, Größe, Maß und dem, was sie benutzt. Angekreuzte Gruppen sind zu sehen; ein Doppelklick auf einen Namen benennt die Gruppe um, auf eine Farbe ändert sie. Elementare Gruppen sind die Teile, die genau denselben Gruppen angehören; umrandende, verbindende und einzelne Teile sind das, was eine Operation in Form halten muss.</translation>
    </message>
    <message>
      <source>Shows the groups of a FEM mesh, what they cover and what uses them</source>
      <translation>Zeigt die Gruppen eines FEM-Netzes, was sie umfassen und was sie verwendet</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_ImportMesh</name>
    <message>
      <source>Import mesh…</source>
      <translation>Netz importieren…</translation>
    </message>
    <message>
      <source>Reads a FEM mesh with its groups from a file, and keeps what else the file holds</source>
      <translation>Liest ein FEM-Netz mit seinen Gruppen aus einer Datei und bewahrt, was die Datei sonst enthält</translation>
    </message>
    <message>
      <source>Reads a mesh with its groups from a file. Cards of a CalculiX deck, fields and groups of element faces are kept in the document, and Export writes them, after cracks and holes too.</source>
      <translation>Liest ein Netz mit seinen Gruppen aus einer Datei. Karten einer CalculiX-Eingabe, Felder und Gruppen von Elementflächen bleiben im Dokument, und Exportieren schreibt sie, auch nach Rissen und Bohrungen.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Incision</name>
    <message>
      <source>Cuts a slot between two parallel planes. Give the plane in the middle as for a crack, the width, and whether it goes right through or down to the plane's point; the elements that go are shown as ghosts. The faces of the two walls become groups; groups lose what is cut away and nothing else, and the report says which.</source>
      <translation>Schneidet einen Schlitz zwischen zwei parallelen Ebenen. Geben Sie die Ebene in der Mitte wie für einen Riss an, die Breite, und ob er ganz hindurch oder bis zum Punkt der Ebene geht; die Elemente, die verschwinden, werden durchscheinend gezeigt. Die Flächen der beiden Wände werden Gruppen; Gruppen verlieren, was weggeschnitten wird, und sonst nichts, und der Bericht sagt, welche.</translation>
    </message>
    <message>
      <source>Cuts a slot into the FEM mesh and keeps its groups</source>
      <translation>Schneidet einen Schlitz in das FEM-Netz und erhält seine Gruppen</translation>
    </message>
    <message>
      <source>Incision</source>
      <translation>Einschnitt</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Merge</name>
    <message>
      <source>Adds another FEM mesh to the FEM mesh and keeps the groups of both</source>
      <translation>Fügt dem FEM-Netz ein anderes hinzu und erhält die Gruppen beider</translation>
    </message>
    <message>
      <source>Adds another FEM mesh, such as a stiffener or a boss drawn in FreeCAD and meshed there. Where the two touch or cross they get the same nodes and edges; where two solids overlap, the overlap is cut off one of them. Select the mesh first, then the one to add, or choose that in the panel. The groups of both stay, and what was added and where it is joined become groups.</source>
      <translation>Fügt ein anderes FEM-Netz hinzu, etwa eine Steife oder ein Auge, in FreeCAD gezeichnet und vernetzt. Wo sich beide berühren oder kreuzen, bekommen sie dieselben Knoten und Kanten; wo sich zwei Volumen überdecken, wird die Überdeckung von einem abgeschnitten. Wählen Sie erst das Netz, dann das, was hinzukommt, oder wählen Sie dieses im Dialog. Die Gruppen beider bleiben; was hinzukam und wo es anschließt, wird zu Gruppen.</translation>
    </message>
    <message>
      <source>Merge</source>
      <translation>Anfügen</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_MeshQuality</name>
    <message>
      <source>Colours the elements by mean ratio (1: equilateral, 0: flat), smallest dihedral angle or scaled Jacobian. Click one of the worst elements to go to it. The mesh is not changed.</source>
      <translation>Färbt die Elemente nach mittlerem Verhältnis (1: gleichseitig, 0: flach), kleinstem Flächenwinkel oder skalierter Jacobi-Determinante. Ein Klick auf eines der schlechtesten Elemente führt zu ihm. Das Netz wird nicht verändert.</translation>
    </message>
    <message>
      <source>Mesh quality</source>
      <translation>Netzgüte</translation>
    </message>
    <message>
      <source>Shows the quality of the elements of a FEM mesh in colours and finds the worst</source>
      <translation>Zeigt die Güte der Elemente eines FEM-Netzes in Farben und findet die schlechtesten</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Refine</name>
    <message>
      <source>Divides the elements near a cylinder, sphere, plane, CAD face or other tool until their edges are as short as you ask, growing towards the rest of the mesh by the gradation. Use it where a crack or hole needs a finer mesh around it. All groups keep their meaning.</source>
      <translation>Teilt die Elemente nahe einem Zylinder, einer Kugel, einer Ebene, einer CAD-Fläche oder einem anderen Werkzeug, bis ihre Kanten so kurz sind wie verlangt; zum übrigen Netz hin wachsen sie mit der Abstufung. Dort nützlich, wo ein Riss oder eine Bohrung ein feineres Netz um sich braucht. Alle Gruppen behalten ihre Bedeutung.</translation>
    </message>
    <message>
      <source>Refine</source>
      <translation>Verfeinern</translation>
    </message>
    <message>
      <source>Refines the FEM mesh near a cylinder, sphere or other tool and keeps its groups</source>
      <translation>Verfeinert das FEM-Netz nahe Zylinder, Kugel oder anderem Werkzeug und erhält seine Gruppen</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Reshape</name>
    <message>
      <source>Moves a wall of the FEM mesh and keeps its groups</source>
      <translation>Verschiebt eine Wand des FEM-Netzes und erhält seine Gruppen</translation>
    </message>
    <message>
      <source>Moves what a group covers: the wall of a hole to another radius, a face to another plane, by a vector, or scaled about a point. The panel begins with the plane, cylinder or sphere that the wall lies on. The elements around follow as far as needed and are divided or merged where they would get poor. All groups keep their meaning.</source>
      <translation>Verschiebt, was eine Gruppe bedeckt: die Wand einer Bohrung auf einen anderen Radius, eine Fläche auf eine andere Ebene, um einen Vektor oder um einen Punkt skaliert. Der Dialog beginnt mit der Ebene, dem Zylinder oder der Kugel, auf der die Wand liegt. Die Elemente ringsum folgen so weit wie nötig und werden geteilt oder vereinigt, wo sie schlecht würden. Alle Gruppen behalten ihren Sinn.</translation>
    </message>
    <message>
      <source>Reshape</source>
      <translation>Umformen</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_WhatIsMissing</name>
    <message>
      <source>Says which part of FemScalpel is missing and which command brings it</source>
      <translation>Sagt, welcher Teil von FemScalpel fehlt und welcher Befehl ihn bringt</translation>
    </message>
    <message>
      <source>What is missing...</source>
      <translation>Was fehlt...</translation>
    </message>
  </context>
  <context>
    <name>GroupInspector</name>
    <message>
      <source>All</source>
      <translation>Alle</translation>
    </message>
    <message>
      <source>Groups</source>
      <translation>Gruppen</translation>
    </message>
    <message>
      <source>Groups, or the disjoint classes of entities that are in exactly the same groups</source>
      <translation>Gruppen, oder die disjunkten Klassen von Teilen, die in genau denselben Gruppen sind</translation>
    </message>
    <message>
      <source>None</source>
      <translation>Keine</translation>
    </message>
    <message>
      <source>Only selected</source>
      <translation>Nur gewählte</translation>
    </message>
    <message>
      <source>Shows every group</source>
      <translation>Zeigt jede Gruppe</translation>
    </message>
    <message>
      <source>Shows no group</source>
      <translation>Zeigt keine Gruppe</translation>
    </message>
    <message>
      <source>Shows the selected groups alone</source>
      <translation>Zeigt nur die gewählten Gruppen</translation>
    </message>
    <message>
      <source>Tick what is to be seen; double-click a name to rename the group</source>
      <translation>Haken Sie an, was zu sehen sein soll; ein Doppelklick auf den Namen benennt die Gruppe um</translation>
    </message>
    <message>
      <source>What of a group is drawn: its members, or its virtual boundary</source>
      <translation>Was von einer Gruppe gezeichnet wird: ihre Mitglieder oder ihr virtueller Rand</translation>
    </message>
  </context>
  <context>
    <name>Hole</name>
    <message>
      <source>Depth</source>
      <translation>Tiefe</translation>
    </message>
    <message>
      <source>Hole</source>
      <translation>Loch</translation>
    </message>
    <message>
      <source>Through</source>
      <translation>Durchgehend</translation>
    </message>
    <message>
      <source>Through the whole part; else a blind hole with a flat bottom</source>
      <translation>Durch das ganze Teil; sonst ein Sackloch mit ebenem Grund</translation>
    </message>
    <message>
      <source>Where the bottom of the hole is: from the point, along the axis</source>
      <translation>Wo der Grund des Loches ist: vom Punkt aus, entlang der Achse</translation>
    </message>
  </context>
  <context>
    <name>Merging</name>
    <message>
      <source>Join groups of one name</source>
      <translation>Gruppen gleichen Namens vereinen</translation>
    </message>
    <message>
      <source>Merge</source>
      <translation>Anfügen</translation>
    </message>
    <message>
      <source>Of groups of the addition whose name the mesh has for others; the name of the new groups when empty</source>
      <translation>Für Gruppen des Zusatzes, deren Name im Netz andere haben; leer: der Name der neuen Gruppen</translation>
    </message>
    <message>
      <source>Overlap</source>
      <translation>Überdeckung</translation>
    </message>
    <message>
      <source>Prefix</source>
      <translation>Vorsilbe</translation>
    </message>
    <message>
      <source>Tolerance</source>
      <translation>Toleranz</translation>
    </message>
    <message>
      <source>What is nearer than this to the other's surface touches it; 0: automatic</source>
      <translation>Was der Oberfläche des anderen näher ist, berührt sie; 0: automatisch</translation>
    </message>
    <message>
      <source>Where two solids overlap: what the overlap is cut off</source>
      <translation>Wo sich zwei Volumen überdecken: wovon die Überdeckung abgeschnitten wird</translation>
    </message>
    <message>
      <source>Whether groups of one name and kind become one; otherwise those of the addition are renamed</source>
      <translation>Ob Gruppen eines Namens und einer Art zu einer werden; sonst werden die des Zusatzes umbenannt</translation>
    </message>
  </context>
  <context>
    <name>MeshQuality</name>
    <message>
      <source>Click an element to zoom to it</source>
      <translation>Ein Klick auf ein Element holt es heran</translation>
    </message>
    <message>
      <source>Elements below this value are shown</source>
      <translation>Elemente unter diesem Wert werden gezeigt</translation>
    </message>
    <message>
      <source>Only below</source>
      <translation>Nur unter</translation>
    </message>
    <message>
      <source>Quality</source>
      <translation>Güte</translation>
    </message>
    <message>
      <source>Shows the elements below the value alone</source>
      <translation>Zeigt nur die Elemente unter dem Wert</translation>
    </message>
    <message>
      <source>What is measured</source>
      <translation>Was gemessen wird</translation>
    </message>
    <message>
      <source>Worst elements</source>
      <translation>Schlechteste Elemente</translation>
    </message>
  </context>
  <context>
    <name>Options</name>
    <message>
      <source>Edge length</source>
      <translation>Kantenlänge</translation>
    </message>
    <message>
      <source>Edges of the skin that are sharper than this keep their shape (feature angle)</source>
      <translation>Kanten der Oberfläche, die schärfer sind, behalten ihre Form (Merkmalswinkel)</translation>
    </message>
    <message>
      <source>Group borders</source>
      <translation>Gruppenränder</translation>
    </message>
    <message>
      <source>Group name</source>
      <translation>Gruppenname</translation>
    </message>
    <message>
      <source>How many rings of elements around the tool may move (the paper: transition)</source>
      <translation>Wie viele Ringe von Elementen um das Werkzeug sich bewegen dürfen (im Aufsatz: transition)</translation>
    </message>
    <message>
      <source>Longest edge wanted there; farther away edges grow longer again</source>
      <translation>Längste dort gewünschte Kante; weiter entfernt werden Kanten wieder länger</translation>
    </message>
    <message>
      <source>Method</source>
      <translation>Verfahren</translation>
    </message>
    <message>
      <source>Options</source>
      <translation>Optionen</translation>
    </message>
    <message>
      <source>Prefix of the new mesh groups</source>
      <translation>Vorsilbe der neuen Netzgruppen</translation>
    </message>
    <message>
      <source>Put in place of its source in the analysis</source>
      <translation>In der Analyse statt der Quelle</translation>
    </message>
    <message>
      <source>Refine first</source>
      <translation>Erst verfeinern</translation>
    </message>
    <message>
      <source>Rings that may move</source>
      <translation>Bewegliche Ringe</translation>
    </message>
    <message>
      <source>Sharp edges from</source>
      <translation>Scharfe Kanten ab</translation>
    </message>
    <message>
      <source>The analysis then solves the new mesh; loads, supports and materials stay as they are</source>
      <translation>Die Analyse rechnet dann mit dem neuen Netz; Lasten, Lager und Werkstoffe bleiben, wie sie sind</translation>
    </message>
    <message>
      <source>The borders of the ticked groups keep their shape; those of the others may drift</source>
      <translation>Die Ränder der angekreuzten Gruppen behalten ihre Form; die der anderen dürfen sich verschieben</translation>
    </message>
    <message>
      <source>Whether the borders of all groups keep their shape; where those of some may drift, elements can be better (the paper: virtual boundaries)</source>
      <translation>Ob die Ränder aller Gruppen ihre Form behalten; wo die einiger wandern dürfen, können Elemente besser werden (im Aufsatz: virtual boundaries)</translation>
    </message>
    <message>
      <source>automatic</source>
      <translation>automatisch</translation>
    </message>
    <message>
      <source>snap: move nodes and split elements, always succeeds on a sound mesh; deform: only move nodes (the paper's way)</source>
      <translation>snap: Knoten bewegen und Elemente teilen, gelingt auf einem gesunden Netz immer; deform: nur Knoten bewegen (wie im Aufsatz)</translation>
    </message>
  </context>
  <context>
    <name>Patch</name>
    <message>
      <source>About the normal: the ellipse's first axis, the half plane's direction, the polygon</source>
      <translation>Um die Normale: die erste Achse der Ellipse, die Richtung der Halbebene, das Polygon</translation>
    </message>
    <message>
      <source>Of the disk, about the point; of the ellipse, along its first axis</source>
      <translation>Der Kreisscheibe um den Punkt; der Ellipse längs ihrer ersten Achse</translation>
    </message>
    <message>
      <source>Of the ellipse, along its second axis</source>
      <translation>Der Ellipse längs ihrer zweiten Achse</translation>
    </message>
    <message>
      <source>Part of the plane</source>
      <translation>Teil der Ebene</translation>
    </message>
    <message>
      <source>Radius</source>
      <translation>Radius</translation>
    </message>
    <message>
      <source>Second radius</source>
      <translation>Zweiter Radius</translation>
    </message>
    <message>
      <source>The part of the plane that cracks; its border inside the part is the crack front</source>
      <translation>Der Teil der Ebene, der reißt; sein Rand im Bauteil ist die Rissfront</translation>
    </message>
    <message>
      <source>Turned by</source>
      <translation>Gedreht um</translation>
    </message>
  </context>
  <context>
    <name>PlaneInput</name>
    <message>
      <source>+</source>
      <translation>+</translation>
    </message>
    <message>
      <source>3 nodes</source>
      <translation>3 Knoten</translation>
    </message>
    <message>
      <source>A point of the plane: x</source>
      <translation>Ein Punkt der Ebene: x</translation>
    </message>
    <message>
      <source>A point of the plane: y</source>
      <translation>Ein Punkt der Ebene: y</translation>
    </message>
    <message>
      <source>A point of the plane: z</source>
      <translation>Ein Punkt der Ebene: z</translation>
    </message>
    <message>
      <source>Centre</source>
      <translation>Mitte</translation>
    </message>
    <message>
      <source>Click a planar face, an edge, a datum plane or line, a sketch, or a face of the mesh</source>
      <translation>Klicken Sie auf eine ebene Fläche, eine Kante, eine Bezugsebene oder -linie, eine Skizze oder eine Seite des Netzes</translation>
    </message>
    <message>
      <source>Click three nodes of the mesh in the 3-D view: the plane goes through them</source>
      <translation>Klicken Sie in der 3D-Ansicht auf drei Knoten des Netzes: die Ebene geht hindurch</translation>
    </message>
    <message>
      <source>Direction of the positive side: x</source>
      <translation>Richtung der positiven Seite: x</translation>
    </message>
    <message>
      <source>Direction of the positive side: y</source>
      <translation>Richtung der positiven Seite: y</translation>
    </message>
    <message>
      <source>Direction of the positive side: z</source>
      <translation>Richtung der positiven Seite: z</translation>
    </message>
    <message>
      <source>Flip</source>
      <translation>Wenden</translation>
    </message>
    <message>
      <source>Geometry</source>
      <translation>Geometrie</translation>
    </message>
    <message>
      <source>Moves the point to the middle of the mesh</source>
      <translation>Setzt den Punkt in die Mitte des Netzes</translation>
    </message>
    <message>
      <source>Normal</source>
      <translation>Normale</translation>
    </message>
    <message>
      <source>Offset: moves the plane along its normal</source>
      <translation>Versatz: schiebt die Ebene entlang ihrer Normalen</translation>
    </message>
    <message>
      <source>Plane</source>
      <translation>Ebene</translation>
    </message>
    <message>
      <source>Point</source>
      <translation>Punkt</translation>
    </message>
    <message>
      <source>Swaps the positive and the negative side</source>
      <translation>Vertauscht die positive und die negative Seite</translation>
    </message>
    <message>
      <source>The plane faces you: its normal is the view direction</source>
      <translation>Die Ebene steht Ihnen gegenüber: ihre Normale ist die Blickrichtung</translation>
    </message>
    <message>
      <source>View</source>
      <translation>Ansicht</translation>
    </message>
    <message>
      <source>x</source>
      <translation>x</translation>
    </message>
    <message>
      <source>y</source>
      <translation>y</translation>
    </message>
    <message>
      <source>z</source>
      <translation>z</translation>
    </message>
  </context>
  <context>
    <name>RefineSizes</name>
    <message>
      <source>Edge size</source>
      <translation>Kantenlänge</translation>
    </message>
    <message>
      <source>Growth</source>
      <translation>Wachstum</translation>
    </message>
    <message>
      <source>How much longer edges may be per unit of distance beyond that</source>
      <translation>Um wie viel länger Kanten je Längeneinheit weiter draußen sein dürfen</translation>
    </message>
    <message>
      <source>Longest edge wanted at the tool</source>
      <translation>Längste gewünschte Kante am Werkzeug</translation>
    </message>
    <message>
      <source>Reach</source>
      <translation>Reichweite</translation>
    </message>
    <message>
      <source>Refine</source>
      <translation>Verfeinern</translation>
    </message>
    <message>
      <source>The edge size holds up to this distance from the tool</source>
      <translation>Die Kantenlänge gilt bis zu diesem Abstand vom Werkzeug</translation>
    </message>
  </context>
  <context>
    <name>Result</name>
    <message>
      <source>Click a group to light it up in the 3-D view</source>
      <translation>Ein Klick auf eine Gruppe hebt sie in der 3D-Ansicht hervor</translation>
    </message>
    <message>
      <source>How much of the part is drawn</source>
      <translation>Wie viel vom Teil gezeichnet wird</translation>
    </message>
    <message>
      <source>Moved nodes</source>
      <translation>Bewegte Knoten</translation>
    </message>
    <message>
      <source>Nodes that change place</source>
      <translation>Knoten, die den Ort wechseln</translation>
    </message>
    <message>
      <source>Points at the worst element near the tool</source>
      <translation>Zeigt auf das schlechteste Element nahe dem Werkzeug</translation>
    </message>
    <message>
      <source>Preview</source>
      <translation>Vorschau</translation>
    </message>
    <message>
      <source>Report…</source>
      <translation>Bericht…</translation>
    </message>
    <message>
      <source>Shows what is done and what becomes of every group, to be copied and saved</source>
      <translation>Zeigt, was getan wird und was aus jeder Gruppe wird; zum Kopieren und Speichern</translation>
    </message>
    <message>
      <source>What the colours of the elements mean</source>
      <translation>Was die Farben der Elemente bedeuten</translation>
    </message>
    <message>
      <source>Worst</source>
      <translation>Schlechtestes</translation>
    </message>
  </context>
  <context>
    <name>Rounding</name>
    <message>
      <source>Fillet</source>
      <translation>Rundung</translation>
    </message>
    <message>
      <source>Of the ball that rolls along the edge</source>
      <translation>Der Kugel, die an der Kante entlangrollt</translation>
    </message>
    <message>
      <source>Radius</source>
      <translation>Radius</translation>
    </message>
  </context>
  <context>
    <name>Slot</name>
    <message>
      <source>Between the two walls; the plane is in the middle</source>
      <translation>Zwischen den beiden Wänden; die Ebene liegt in der Mitte</translation>
    </message>
    <message>
      <source>Direction in the plane from the bottom, at the plane's point, to the mouth of the slot: turned about the normal</source>
      <translation>Richtung in der Ebene vom Grund, am Punkt der Ebene, zur Öffnung des Schlitzes: um die Normale gedreht</translation>
    </message>
    <message>
      <source>How deep the slot is</source>
      <translation>Wie tief der Schlitz ist</translation>
    </message>
    <message>
      <source>Opens towards</source>
      <translation>Öffnet sich nach</translation>
    </message>
    <message>
      <source>Slot</source>
      <translation>Schlitz</translation>
    </message>
    <message>
      <source>Width</source>
      <translation>Breite</translation>
    </message>
  </context>
  <context>
    <name>ToolInput</name>
    <message>
      <source>Tool</source>
      <translation>Werkzeug</translation>
    </message>
    <message>
      <source>What the tool is</source>
      <translation>Was das Werkzeug ist</translation>
    </message>
  </context>
  <context>
    <name>ToolValues</name>
    <message>
      <source>Between the axis of the cone and its side</source>
      <translation>Zwischen der Achse des Kegels und seiner Seite</translation>
    </message>
    <message>
      <source>Clear</source>
      <translation>Löschen</translation>
    </message>
    <message>
      <source>Click a face of a part in the 3-D view; further ones of the same part that meet it smoothly are added</source>
      <translation>Klicken Sie in der 3D-Ansicht auf die Fläche eines Teils; weitere desselben Teils, die glatt anschließen, kommen hinzu</translation>
    </message>
    <message>
      <source>Forgets what was picked</source>
      <translation>Vergisst, was gewählt wurde</translation>
    </message>
    <message>
      <source>Half angle</source>
      <translation>Halber Winkel</translation>
    </message>
    <message>
      <source>Pick</source>
      <translation>Wählen</translation>
    </message>
    <message>
      <source>Radius of the tube around the circle</source>
      <translation>Radius des Rohrs um den Kreis</translation>
    </message>
    <message>
      <source>Tool</source>
      <translation>Werkzeug</translation>
    </message>
    <message>
      <source>Tube radius</source>
      <translation>Rohrradius</translation>
    </message>
  </context>
  <context>
    <name>WallInput</name>
    <message>
      <source>Click a face of the mesh in the 3-D view: the smallest group it is in</source>
      <translation>Klicken Sie in der 3D-Ansicht auf eine Fläche des Netzes: die kleinste Gruppe, in der sie ist</translation>
    </message>
    <message>
      <source>Move it</source>
      <translation>Verschieben</translation>
    </message>
    <message>
      <source>Onto a surface, by a vector, or scaled about a point</source>
      <translation>Auf eine Fläche, um einen Vektor oder um einen Punkt skaliert</translation>
    </message>
    <message>
      <source>Pick</source>
      <translation>Wählen</translation>
    </message>
    <message>
      <source>Surface</source>
      <translation>Fläche</translation>
    </message>
    <message>
      <source>The group of faces (of a shell: edges) or nodes that is moved</source>
      <translation>Die Gruppe von Flächen (einer Schale: Kanten) oder Knoten, die verschoben wird</translation>
    </message>
    <message>
      <source>Wall</source>
      <translation>Wand</translation>
    </message>
    <message>
      <source>What it is moved onto; a plane has the axis as its normal</source>
      <translation>Worauf sie verschoben wird; eine Ebene hat die Achse als Normale</translation>
    </message>
  </context>
  <context>
    <name>WallMotion</name>
    <message>
      <source>Along x</source>
      <translation>Entlang x</translation>
    </message>
    <message>
      <source>Along y</source>
      <translation>Entlang y</translation>
    </message>
    <message>
      <source>Along z</source>
      <translation>Entlang z</translation>
    </message>
    <message>
      <source>Factor</source>
      <translation>Faktor</translation>
    </message>
    <message>
      <source>Motion</source>
      <translation>Bewegung</translation>
    </message>
    <message>
      <source>Vector</source>
      <translation>Vektor</translation>
    </message>
    <message>
      <source>What distances from the centre are multiplied by</source>
      <translation>Womit Abstände von der Mitte malgenommen werden</translation>
    </message>
    <message>
      <source>x</source>
      <translation>x</translation>
    </message>
    <message>
      <source>y</source>
      <translation>y</translation>
    </message>
    <message>
      <source>z</source>
      <translation>z</translation>
    </message>
  </context>
</TS>
