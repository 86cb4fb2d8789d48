<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="fr" sourcelanguage="en">
  <context>
    <name>AdditionInput</name>
    <message>
      <source>Addition</source>
      <translation>Ajout</translation>
    </message>
    <message>
      <source>Click the mesh in the 3-D view or in the tree</source>
      <translation>Cliquez sur le maillage dans la vue 3D ou dans l'arborescence</translation>
    </message>
    <message>
      <source>Mesh to add</source>
      <translation>À ajouter</translation>
    </message>
    <message>
      <source>Pick</source>
      <translation>Choisir</translation>
    </message>
    <message>
      <source>The FEM mesh that is added, where its placement puts it: also one that FreeCAD has made of a part</source>
      <translation>Le maillage EF à ajouter, là où son placement le met : aussi celui que FreeCAD a fait d'une pièce</translation>
    </message>
  </context>
  <context>
    <name>AxisInput</name>
    <message>
      <source>2 nodes</source>
      <translation>2 nœuds</translation>
    </message>
    <message>
      <source>A point of the axis: x</source>
      <translation>Un point de l'axe : x</translation>
    </message>
    <message>
      <source>A point of the axis: y</source>
      <translation>Un point de l'axe : y</translation>
    </message>
    <message>
      <source>A point of the axis: z</source>
      <translation>Un point de l'axe : z</translation>
    </message>
    <message>
      <source>Axis</source>
      <translation>Axe</translation>
    </message>
    <message>
      <source>Centre</source>
      <translation>Centre</translation>
    </message>
    <message>
      <source>Click a cylindrical face, a straight or circular edge, a datum line, or a point on a face: the axis is normal to it there</source>
      <translation>Cliquez sur une face cylindrique, une arête droite ou circulaire, une ligne de référence ou un point d'une face : l'axe y est normal</translation>
    </message>
    <message>
      <source>Click two nodes of the mesh in the 3-D view: the axis goes through them</source>
      <translation>Cliquez sur deux nœuds du maillage dans la vue 3D : l'axe passe par eux</translation>
    </message>
    <message>
      <source>Direction of the axis: x</source>
      <translation>Direction de l'axe : x</translation>
    </message>
    <message>
      <source>Direction of the axis: y</source>
      <translation>Direction de l'axe : y</translation>
    </message>
    <message>
      <source>Direction of the axis: z</source>
      <translation>Direction de l'axe : z</translation>
    </message>
    <message>
      <source>Geometry</source>
      <translation>Géométrie</translation>
    </message>
    <message>
      <source>Moves the point to the middle of the mesh</source>
      <translation>Place le point au milieu du maillage</translation>
    </message>
    <message>
      <source>Point</source>
      <translation>Point</translation>
    </message>
    <message>
      <source>R</source>
      <translation>R</translation>
    </message>
    <message>
      <source>Radius of the cylinder</source>
      <translation>Rayon du cylindre</translation>
    </message>
    <message>
      <source>The axis is the view direction</source>
      <translation>L'axe est la direction de vue</translation>
    </message>
    <message>
      <source>View</source>
      <translation>Vue</translation>
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
      <translation>Angle autour de l'axe où la fissure commence ; 0 à 360 : tout autour. 0 est vers x quand l'axe est z ; l'aperçu le montre</translation>
    </message>
    <message>
      <source>Only a part of the cylinder cracks, between two heights along its axis and two angles about it; its border is the crack front</source>
      <translation>Seule une partie du cylindre se fissure, entre deux hauteurs le long de son axe et deux angles autour de lui ; son bord est le front de fissure</translation>
    </message>
    <message>
      <source>Only from</source>
      <translation>Seulement de</translation>
    </message>
    <message>
      <source>Part of the cylinder</source>
      <translation>Partie du cylindre</translation>
    </message>
    <message>
      <source>Where the crack begins: from the point, along the axis</source>
      <translation>Où la fissure commence : depuis le point, selon l'axe</translation>
    </message>
    <message>
      <source>Where the crack ends about the axis, counter-clockwise seen against it</source>
      <translation>Où la fissure finit autour de l'axe, dans le sens inverse des aiguilles d'une montre vu contre l'axe</translation>
    </message>
    <message>
      <source>Where the crack ends: from the point, along the axis</source>
      <translation>Où la fissure finit : depuis le point, selon l'axe</translation>
    </message>
    <message>
      <source>to</source>
      <translation>à</translation>
    </message>
  </context>
  <context>
    <name>EdgeInput</name>
    <message>
      <source>Clear</source>
      <translation>Effacer</translation>
    </message>
    <message>
      <source>Click near an edge of the mesh in the 3-D view; it is rounded as far as it goes on without a corner</source>
      <translation>Cliquez près d'une arête du maillage dans la vue 3D ; elle est arrondie aussi loin qu'elle continue sans coin</translation>
    </message>
    <message>
      <source>Edge</source>
      <translation>Arête</translation>
    </message>
    <message>
      <source>Forgets what was picked</source>
      <translation>Oublie ce qui a été choisi</translation>
    </message>
    <message>
      <source>Pick</source>
      <translation>Choisir</translation>
    </message>
    <message>
      <source>Picked places do not move with the mesh: when it changes, the edge that is there then is rounded. A group goes with the mesh.</source>
      <translation>Les endroits choisis ne suivent pas le maillage : s'il change, c'est l'arête qui s'y trouve alors qui est arrondie. Un groupe suit le maillage.</translation>
    </message>
    <message>
      <source>What is rounded: what was picked, or a group of segments or nodes on an edge</source>
      <translation>Ce qui est arrondi : ce qui a été choisi, ou un groupe de segments ou de nœuds sur une arête</translation>
    </message>
  </context>
  <context>
    <name>FaceGroupInput</name>
    <message>
      <source>Faces</source>
      <translation>Faces</translation>
    </message>
    <message>
      <source>Faces of</source>
      <translation>Faces de</translation>
    </message>
    <message>
      <source>The group whose faces come apart: of faces inside the part (of a shell: edges), or of their nodes</source>
      <translation>Le groupe dont les faces se séparent : de faces dans la pièce (d'une coque : d'arêtes), ou de leurs nœuds</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel</name>
    <message>
      <source>%1 % of the area</source>
      <translation>%1 % de l'aire</translation>
    </message>
    <message>
      <source>%1 % of the length</source>
      <translation>%1 % de la longueur</translation>
    </message>
    <message>
      <source>%1 % of the volume</source>
      <translation>%1 % du volume</translation>
    </message>
    <message>
      <source>%1 '%2' has an error; mend it first</source>
      <translation>%1 « %2 » a une erreur ; corrigez-la d'abord</translation>
    </message>
    <message>
      <source>%1 '%2' has no mesh; make it first</source>
      <translation>%1 « %2 » n'a pas de maillage ; créez-le d'abord</translation>
    </message>
    <message>
      <source>%1 '%2' is not a FEM mesh</source>
      <translation>%1 « %2 » n'est pas un maillage FEM</translation>
    </message>
    <message>
      <source>%1 and %2</source>
      <translation>%1 et %2</translation>
    </message>
    <message>
      <source>%1 and %2 more</source>
      <translation>%1 et %2 autres</translation>
    </message>
    <message>
      <source>%1 beam elements</source>
      <translation>%1 éléments de poutre</translation>
    </message>
    <message>
      <source>%1 cannot be added. Click another FEM mesh.</source>
      <translation>%1 ne peut pas être ajouté. Cliquez sur un autre maillage EF.</translation>
    </message>
    <message>
      <source>%1 cannot be written: %2. Choose another folder or name.</source>
      <translation>%1 ne peut pas être écrit : %2. Choisissez un autre dossier ou un autre nom.</translation>
    </message>
    <message>
      <source>%1 does not hold %2: files of this kind cannot</source>
      <translation>%1 ne contient pas : %2. Les fichiers de ce type ne le peuvent pas</translation>
    </message>
    <message>
      <source>%1 element(s) would be flat or inverted (%2): the tool passes too close to a corner or crease there. Move it a little</source>
      <translation>%1 élément(s) seraient plats ou retournés (%2) : l'outil passe trop près d'un coin ou d'un pli. Déplacez-le un peu</translation>
    </message>
    <message>
      <source>%1 elements; smallest %2, mean %3.</source>
      <translation>%1 éléments ; minimum %2, moyenne %3.</translation>
    </message>
    <message>
      <source>%1 exists already. Replace it?</source>
      <translation>%1 existe déjà. Le remplacer ?</translation>
    </message>
    <message>
      <source>%1 faces of %2</source>
      <translation>%1 faces de %2</translation>
    </message>
    <message>
      <source>%1 groups, %2 nodes, %3 elements.</source>
      <translation>%1 groupes, %2 nœuds, %3 éléments.</translation>
    </message>
    <message>
      <source>%1 has an error. Mend it, or select another mesh.</source>
      <translation>%1 est en erreur. Corrigez-la ou sélectionnez un autre maillage.</translation>
    </message>
    <message>
      <source>%1 has no mesh any more. Undo what took it away, or cancel.</source>
      <translation>%1 n'a plus de maillage. Annulez ce qui l'a enlevé, ou fermez le panneau.</translation>
    </message>
    <message>
      <source>%1 has no mesh yet: it is empty. Make the mesh first.</source>
      <translation>%1 n'a pas encore de maillage : il est vide. Créez d'abord le maillage.</translation>
    </message>
    <message>
      <source>%1 has no radius any more; pick it again in the operation's panel, or set Follow to Numbers</source>
      <translation>%1 n'a plus de rayon ; désignez-le à nouveau dans le panneau de l'opération, ou mettez Follow sur Numbers</translation>
    </message>
    <message>
      <source>%1 has no source mesh. Set its property Source to a FEM mesh first.</source>
      <translation>%1 n'a pas de maillage source. Donnez d'abord un maillage EF à sa propriété Source.</translation>
    </message>
    <message>
      <source>%1 is not a FEM mesh. Select the mesh in the tree.</source>
      <translation>%1 n'est pas un maillage EF. Sélectionnez le maillage dans l'arborescence.</translation>
    </message>
    <message>
      <source>%1 is not set; choose the FEM mesh to add</source>
      <translation>%1 n'est pas défini ; choisissez le maillage FEM à ajouter</translation>
    </message>
    <message>
      <source>%1 is not set; choose the FEM mesh to work on</source>
      <translation>%1 n'est pas défini ; choisissez le maillage FEM à modifier</translation>
    </message>
    <message>
      <source>%1 is not the mesh that was imported any more, as it was moved or changed: what its file held beside nodes, elements and groups (a deck's cards, as materials and sections; fields; groups of element faces) is left behind</source>
      <translation>%1 n’est plus le maillage importé, car il a été déplacé ou modifié : ce que son fichier contenait outre les nœuds, éléments et groupes (les cartes d’un jeu de données, comme matériaux et sections ; champs ; groupes de faces d’éléments) est laissé de côté</translation>
    </message>
    <message>
      <source>%1 is not there any more, so its panel was closed.</source>
      <translation>%1 n'existe plus ; son panneau a donc été fermé.</translation>
    </message>
    <message>
      <source>%1 is the source of another operation. Take %2, the latest, instead?</source>
      <translation>%1 est déjà la source d'une autre opération. Prendre plutôt %2, le maillage le plus récent ?</translation>
    </message>
    <message>
      <source>%1 million</source>
      <translation>%1 million(s)</translation>
    </message>
    <message>
      <source>%1 nodes moved, %2 added; %3 elements added, %4 removed. Mean ratio at least %5 (before: %6).</source>
      <translation>%1 nœuds déplacés, %2 ajoutés ; %3 éléments ajoutés, %4 supprimés. Mean ratio au moins %5 (avant : %6).</translation>
    </message>
    <message>
      <source>%1 nodes moved; boundary at most %2 mm from where it was</source>
      <translation>%1 nœuds déplacés ; bord à %2 mm au plus de sa position d'origine</translation>
    </message>
    <message>
      <source>%1 picked places</source>
      <translation>%1 endroits choisis</translation>
    </message>
    <message>
      <source>%1 second-order element(s) would be folded (%2): the mesh is too coarse for its curvature there. Move the tool a little, or refine the mesh</source>
      <translation>%1 élément(s) du second ordre seraient repliés (%2) : le maillage y est trop grossier pour sa courbure. Déplacez un peu l'outil, ou raffinez le maillage</translation>
    </message>
    <message>
      <source>%1 shell elements</source>
      <translation>%1 éléments de coque</translation>
    </message>
    <message>
      <source>%1 smaller ones</source>
      <translation>%1 plus petits</translation>
    </message>
    <message>
      <source>%1 was read.</source>
      <translation>%1 a été lu.</translation>
    </message>
    <message>
      <source>%1 was set, so it does not follow %2 any more</source>
      <translation>%1 a été défini et ne suit donc plus %2</translation>
    </message>
    <message>
      <source>%1 was set, so it is not that of %2 any more</source>
      <translation>%1 a été défini et n'est donc plus celui de %2</translation>
    </message>
    <message>
      <source>%1 was written.</source>
      <translation>%1 a été écrit.</translation>
    </message>
    <message>
      <source>%1, where this was picked, is not there any more or may be another one. Pick it again, or press Unlink: then the numbers stay.</source>
      <translation>%1, d'où cela provient, n'existe plus ou est peut-être autre chose. Choisissez-le à nouveau, ou appuyez sur Délier : les nombres restent alors.</translation>
    </message>
    <message>
      <source>%1, which %2 follows, is not there any more; pick it again in the operation's panel, or set Follow to Numbers</source>
      <translation>%1, que %2 suit, n'existe plus ; désignez-le à nouveau dans le panneau de l'opération, ou mettez Follow sur Numbers</translation>
    </message>
    <message>
      <source>%1, which %2 follows, may be another face, edge or vertex now: its part has others than before; pick it again in the operation's panel, or set Follow to Numbers</source>
      <translation>%1, que %2 suit, est peut-être maintenant une autre face, arête ou un autre sommet : sa pièce en a d'autres qu'avant ; désignez-le à nouveau dans le panneau de l'opération, ou mettez Follow sur Numbers</translation>
    </message>
    <message>
      <source>%1: %2 is %3; it must be positive</source>
      <translation>%1 : %2 vaut %3 ; il doit être positif</translation>
    </message>
    <message>
      <source>%1: %2 is the zero vector; give a direction</source>
      <translation>%1 : %2 est le vecteur nul ; donnez une direction</translation>
    </message>
    <message>
      <source>%1: 0 to %2</source>
      <translation>%1 : 0 à %2</translation>
    </message>
    <message>
      <source>%1: FreeCAD will not find these nodes by geometry, so that a load, support or material on it is incomplete</source>
      <translation>%1 : FreeCAD ne trouvera pas ces nœuds par la géométrie, si bien qu'une charge, un appui ou un matériau y est incomplet</translation>
    </message>
    <message>
      <source>%1: names of groups are not UTF-8; they are read as Windows-1252 (Latin-1). Look at those with letters beyond A to Z</source>
      <translation>%1: des noms de groupes ne sont pas en UTF-8 ; ils sont lus comme du Windows-1252 (Latin-1). Vérifiez ceux qui contiennent d'autres lettres que A à Z</translation>
    </message>
    <message>
      <source>%1: the text is not UTF-8, here for the first time; it is read as Windows-1252 (Latin-1). Look at names with letters beyond A to Z</source>
      <translation>%1: le texte n'est pas en UTF-8, ici pour la première fois ; il est lu comme du Windows-1252 (Latin-1). Vérifiez les noms contenant d'autres lettres que A à Z</translation>
    </message>
    <message>
      <source>%1: this is text in UTF-16 or UTF-32, which is not read; save it as UTF-8</source>
      <translation>%1: ce texte est en UTF-16 ou UTF-32, qui n'est pas lu ; enregistrez-le en UTF-8</translation>
    </message>
    <message>
      <source>'%1' has no mesh; mend what its error says first</source>
      <translation>« %1 » n'a pas de maillage ; corrigez d'abord ce que dit son erreur</translation>
    </message>
    <message>
      <source>'%1' is in no analysis</source>
      <translation>« %1 » n'est dans aucune analyse</translation>
    </message>
    <message>
      <source>1 node</source>
      <translation>1 nœud</translation>
    </message>
    <message>
      <source>1 picked place</source>
      <translation>1 endroit choisi</translation>
    </message>
    <message>
      <source>3 nodes</source>
      <translation>3 nœuds</translation>
    </message>
    <message>
      <source>A disk</source>
      <translation>Un disque</translation>
    </message>
    <message>
      <source>A half plane</source>
      <translation>Un demi-plan</translation>
    </message>
    <message>
      <source>A polygon</source>
      <translation>Un polygone</translation>
    </message>
    <message>
      <source>Addition and Source are the same mesh; choose another mesh to add</source>
      <translation>Addition et Source sont le même maillage ; choisissez un autre maillage à ajouter</translation>
    </message>
    <message>
      <source>Advanced</source>
      <translation>Avancé</translation>
    </message>
    <message>
      <source>After</source>
      <translation>Après</translation>
    </message>
    <message>
      <source>All commands</source>
      <translation>Toutes les commandes</translation>
    </message>
    <message>
      <source>Along and AlongPoints both say which edge is rounded; give one of them</source>
      <translation>Along et AlongPoints disent tous deux quelle arête est arrondie ; n'en donnez qu'un</translation>
    </message>
    <message>
      <source>An ellipse</source>
      <translation>Une ellipse</translation>
    </message>
    <message>
      <source>Another task panel is open. Close it first.</source>
      <translation>Un autre panneau de tâches est ouvert. Fermez-le d'abord.</translation>
    </message>
    <message>
      <source>At the bottom it has</source>
      <translation>Au fond qu'il a</translation>
    </message>
    <message>
      <source>Back</source>
      <translation>Retour</translation>
    </message>
    <message>
      <source>Before</source>
      <translation>Avant</translation>
    </message>
    <message>
      <source>Bounding (BE)</source>
      <translation>Bordants (BE)</translation>
    </message>
    <message>
      <source>By group</source>
      <translation>Par groupe</translation>
    </message>
    <message>
      <source>By quality</source>
      <translation>Par qualité</translation>
    </message>
    <message>
      <source>CAD face</source>
      <translation>Face CAO</translation>
    </message>
    <message>
      <source>CSV…</source>
      <translation>CSV…</translation>
    </message>
    <message>
      <source>Cancel</source>
      <translation>Annuler</translation>
    </message>
    <message>
      <source>Cancelled. OK, or a change, computes again.</source>
      <translation>Annulé. OK ou une modification relance le calcul.</translation>
    </message>
    <message>
      <source>Cancelled: no file was written.</source>
      <translation>Annulé : aucun fichier n'a été écrit.</translation>
    </message>
    <message>
      <source>Cancelled: nothing was changed.</source>
      <translation>Annulé : rien n’a été modifié.</translation>
    </message>
    <message>
      <source>Cancelled: nothing was imported.</source>
      <translation>Annulé : rien n’a été importé.</translation>
    </message>
    <message>
      <source>Centre</source>
      <translation>Centre</translation>
    </message>
    <message>
      <source>Change</source>
      <translation>Variation</translation>
    </message>
    <message>
      <source>Changed part</source>
      <translation>Partie modifiée</translation>
    </message>
    <message>
      <source>Choose the mesh to add, or pick it.</source>
      <translation>Choisissez le maillage à ajouter, dans la liste ou d'un clic.</translation>
    </message>
    <message>
      <source>Click a cylindrical face, a straight or circular edge, a datum line, or a point on a face (the axis is normal to it). Escape stops.</source>
      <translation>Cliquez sur une face cylindrique, une arête droite ou circulaire, une ligne de référence ou un point d'une face (l'axe lui est normal). Échap arrête.</translation>
    </message>
    <message>
      <source>Click a face of a part, or a part in the tree. Escape stops.</source>
      <translation>Cliquez sur une face d'une pièce, ou sur une pièce dans l'arbre. Échap arrête.</translation>
    </message>
    <message>
      <source>Click a face of the mesh. Escape stops.</source>
      <translation>Cliquez sur une face du maillage. Échap arrête.</translation>
    </message>
    <message>
      <source>Click a node of the mesh. Escape stops.</source>
      <translation>Cliquez sur un nœud du maillage. Échap arrête.</translation>
    </message>
    <message>
      <source>Click a planar face, an edge (the plane is normal to it), a datum or a sketch. Escape stops.</source>
      <translation>Cliquez sur une face plane, une arête (le plan lui est normal), une référence ou une esquisse. Échap arrête.</translation>
    </message>
    <message>
      <source>Click a round face, a straight or circular edge, a datum line, or a point on a face. Escape stops.</source>
      <translation>Cliquez sur une face ronde, une arête droite ou circulaire, une ligne de référence ou un point d'une face. Échap arrête.</translation>
    </message>
    <message>
      <source>Click node %1 of %2 on the mesh, or a vertex of a part. Escape stops.</source>
      <translation>Cliquez sur le nœud %1 de %2 du maillage, ou sur un sommet d'une pièce. Échap arrête.</translation>
    </message>
    <message>
      <source>Click the mesh itself, near the edge.</source>
      <translation>Cliquez sur le maillage même, près de l'arête.</translation>
    </message>
    <message>
      <source>Click the mesh near the edge to round. Escape stops.</source>
      <translation>Cliquez sur le maillage près de l'arête à arrondir. Échap arrête.</translation>
    </message>
    <message>
      <source>Click the mesh to add, here or in the tree. Escape stops.</source>
      <translation>Cliquez sur le maillage à ajouter, ici ou dans l'arborescence. Échap arrête.</translation>
    </message>
    <message>
      <source>Colour of %1</source>
      <translation>Couleur de %1</translation>
    </message>
    <message>
      <source>Compute it all the same</source>
      <translation>Calculer quand même</translation>
    </message>
    <message>
      <source>Computing the new mesh…</source>
      <translation>Calcul du nouveau maillage…</translation>
    </message>
    <message>
      <source>Cone</source>
      <translation>Cône</translation>
    </message>
    <message>
      <source>Copies all rows that are shown, for a spreadsheet</source>
      <translation>Copie toutes les lignes affichées, pour un tableur</translation>
    </message>
    <message>
      <source>Copy</source>
      <translation>Copier</translation>
    </message>
    <message>
      <source>Copy the command</source>
      <translation>Copier la commande</translation>
    </message>
    <message>
      <source>Crack</source>
      <translation>Fissure</translation>
    </message>
    <message>
      <source>Crack along faces</source>
      <translation>Fissure le long de faces</translation>
    </message>
    <message>
      <source>Cracks, drills and cuts FEM meshes and keeps their groups</source>
      <translation>Fissure, perce et coupe des maillages EF en gardant leurs groupes</translation>
    </message>
    <message>
      <source>Curved crack</source>
      <translation>Fissure courbe</translation>
    </message>
    <message>
      <source>Cut away</source>
      <translation>En coupe</translation>
    </message>
    <message>
      <source>Cylinder</source>
      <translation>Cylindre</translation>
    </message>
    <message>
      <source>Cylindrical crack</source>
      <translation>Fissure cylindrique</translation>
    </message>
    <message>
      <source>Direction, as its expressions say it, is zero; give it a length</source>
      <translation>Direction est nulle selon ses expressions ; donnez-lui une longueur</translation>
    </message>
    <message>
      <source>Document %1 has objects of FemScalpel (%2), which do not recompute while a part of FemScalpel is missing, nor after the document was saved without it. Close it without saving.</source>
      <translation>Le document %1 a des objets de FemScalpel (%2), qui ne sont pas recalculés tant qu'une partie de FemScalpel manque, ni après que le document a été enregistré sans elle. Fermez-le sans enregistrer.</translation>
    </message>
    <message>
      <source>Double-click to change the colour</source>
      <translation>Double-cliquez pour changer la couleur</translation>
    </message>
    <message>
      <source>Down to the point</source>
      <translation>Jusqu'au point</translation>
    </message>
    <message>
      <source>Drill</source>
      <translation>Perçage</translation>
    </message>
    <message>
      <source>Edit</source>
      <translation>Modifier</translation>
    </message>
    <message>
      <source>Element</source>
      <translation>Élément</translation>
    </message>
    <message>
      <source>Elementary groups</source>
      <translation>Groupes élémentaires</translation>
    </message>
    <message>
      <source>Enter an expression (=)</source>
      <translation>Saisir une expression (=)</translation>
    </message>
    <message>
      <source>Export mesh</source>
      <translation>Exporter le maillage</translation>
    </message>
    <message>
      <source>Expression</source>
      <translation>Expression</translation>
    </message>
    <message>
      <source>FemScalpel cannot run: %1</source>
      <translation>FemScalpel ne peut pas fonctionner : %1</translation>
    </message>
    <message>
      <source>FemScalpel: help</source>
      <translation>FemScalpel : aide</translation>
    </message>
    <message>
      <source>Fillet</source>
      <translation>Congé</translation>
    </message>
    <message>
      <source>Filter by name</source>
      <translation>Filtrer par nom</translation>
    </message>
    <message>
      <source>First became triangles or tetrahedra: %1.</source>
      <translation>D'abord devenus triangles ou tétraèdres : %1.</translation>
    </message>
    <message>
      <source>FreeCAD takes the mesh over…</source>
      <translation>FreeCAD reprend le maillage…</translation>
    </message>
    <message>
      <source>FreeCAD would not apply everything in '%1' to '%2': %3. Move the tool a little, or refine the mesh there</source>
      <translation>FreeCAD n'appliquerait pas tout ce qui est dans « %1 » à « %2 » : %3. Déplacez un peu l'outil, ou raffinez-y le maillage</translation>
    </message>
    <message>
      <source>Group</source>
      <translation>Groupe</translation>
    </message>
    <message>
      <source>Group inspector</source>
      <translation>Inspecteur de groupes</translation>
    </message>
    <message>
      <source>Group is not set; choose the mesh group to crack along</source>
      <translation>Group n'est pas défini ; choisissez le groupe de maillage à fissurer</translation>
    </message>
    <message>
      <source>Group is not set; choose the mesh group to move</source>
      <translation>Group n'est pas défini ; choisissez le groupe de maillage à déplacer</translation>
    </message>
    <message>
      <source>Groups</source>
      <translation>Groupes</translation>
    </message>
    <message>
      <source>How nodes are moved, which of them, and what must keep its shape</source>
      <translation>Comment les nœuds sont déplacés, lesquels, et ce qui doit garder sa forme</translation>
    </message>
    <message>
      <source>Import mesh</source>
      <translation>Importer un maillage</translation>
    </message>
    <message>
      <source>Incision</source>
      <translation>Incision</translation>
    </message>
    <message>
      <source>Isolated (IE)</source>
      <translation>Isolés (IE)</translation>
    </message>
    <message>
      <source>KeepToShape is set, but the mesh does not know the geometry it was made from (its property Part or Shape)</source>
      <translation>KeepToShape est défini, mais le maillage ne connaît pas la géométrie dont il est issu (sa propriété Part ou Shape)</translation>
    </message>
    <message>
      <source>Kind</source>
      <translation>Genre</translation>
    </message>
    <message>
      <source>Linking (LE)</source>
      <translation>Liants (LE)</translation>
    </message>
    <message>
      <source>Mean ratio</source>
      <translation>Mean ratio</translation>
    </message>
    <message>
      <source>Measure</source>
      <translation>Mesure</translation>
    </message>
    <message>
      <source>Members</source>
      <translation>Membres</translation>
    </message>
    <message>
      <source>Merge</source>
      <translation>Fusion</translation>
    </message>
    <message>
      <source>Mesh quality</source>
      <translation>Qualité du maillage</translation>
    </message>
    <message>
      <source>Mesh: %1</source>
      <translation>Maillage : %1</translation>
    </message>
    <message>
      <source>Meshes</source>
      <translation>Maillages</translation>
    </message>
    <message>
      <source>No group of the mesh covers faces inside it (of a shell: edges). Make one of them, or of their nodes, first.</source>
      <translation>Aucun groupe du maillage ne couvre de faces intérieures (d'une coque : d'arêtes). Créez-en d'abord un, ou un groupe de leurs nœuds.</translation>
    </message>
    <message>
      <source>No longer follows %1: other numbers were entered.</source>
      <translation>Ne suit plus %1 : d'autres nombres ont été entrés.</translation>
    </message>
    <message>
      <source>No preview yet: see the question above.</source>
      <translation>Pas encore d’aperçu : voir la question ci-dessus.</translation>
    </message>
    <message>
      <source>No preview.</source>
      <translation>Pas d'aperçu.</translation>
    </message>
    <message>
      <source>No preview: see the message in red.</source>
      <translation>Pas d'aperçu : voir le message en rouge.</translation>
    </message>
    <message>
      <source>Normal</source>
      <translation>Normale</translation>
    </message>
    <message>
      <source>Nothing is moved yet. Enter where the wall is to be.</source>
      <translation>Rien n'est encore déplacé. Indiquez où la paroi doit se trouver.</translation>
    </message>
    <message>
      <source>Nothing to refine: the elements that the tool reaches have no edge longer than the size. Move the tool, give it a larger reach, or choose a smaller size.</source>
      <translation>Rien à raffiner : les éléments que l'outil atteint n'ont pas d'arête plus longue que la taille. Déplacez l'outil, donnez-lui une plus grande portée ou choisissez une taille plus petite.</translation>
    </message>
    <message>
      <source>Number of elements by mean ratio (1: equilateral, 0: flat). Bars: after; line: before</source>
      <translation>Nombre d'éléments par mean ratio (1 : équilatéral, 0 : plat). Barres : après ; ligne : avant</translation>
    </message>
    <message>
      <source>Open a document with a FEM mesh first.</source>
      <translation>Ouvrez d'abord un document avec un maillage EF.</translation>
    </message>
    <message>
      <source>Opening the panel…</source>
      <translation>Ouverture du panneau…</translation>
    </message>
    <message>
      <source>Pick a cylindrical face, a straight or circular edge, a datum line, or a point on a face.</source>
      <translation>Choisissez une face cylindrique, une arête droite ou circulaire, une ligne de référence ou un point d'une face.</translation>
    </message>
    <message>
      <source>Pick a planar face, an edge, a datum plane or line, a sketch, or a face of the mesh.</source>
      <translation>Choisissez une face plane, une arête, un plan ou une ligne de référence, une esquisse ou une face du maillage.</translation>
    </message>
    <message>
      <source>Pick a sketch with one closed line of straight sides: that is the polygon.</source>
      <translation>Choisissez une esquisse avec une seule ligne fermée de côtés droits : c'est le polygone.</translation>
    </message>
    <message>
      <source>Plane</source>
      <translation>Plan</translation>
    </message>
    <message>
      <source>Press Pick and click a face of a part.</source>
      <translation>Appuyez sur Choisir et cliquez sur une face d'une pièce.</translation>
    </message>
    <message>
      <source>Press Pick and click near the edge, or choose a group.</source>
      <translation>Pressez Choisir et cliquez près de l'arête, ou choisissez un groupe.</translation>
    </message>
    <message>
      <source>Put into the analysis</source>
      <translation>Mettre dans l’analyse</translation>
    </message>
    <message>
      <source>Putting nodes onto the geometry…</source>
      <translation>Placement des nœuds sur la géométrie…</translation>
    </message>
    <message>
      <source>Radius of the circle in the middle of the tube</source>
      <translation>Rayon du cercle au milieu du tube</translation>
    </message>
    <message>
      <source>Radius of the cone at the point; it opens along the axis</source>
      <translation>Rayon du cône au point ; il s'ouvre le long de l'axe</translation>
    </message>
    <message>
      <source>Radius of the cylinder</source>
      <translation>Rayon du cylindre</translation>
    </message>
    <message>
      <source>Radius of the hole: %1.</source>
      <translation>Rayon du trou : %1.</translation>
    </message>
    <message>
      <source>Radius of the sphere</source>
      <translation>Rayon de la sphère</translation>
    </message>
    <message>
      <source>Reading the file…</source>
      <translation>Lecture du fichier…</translation>
    </message>
    <message>
      <source>Reading the mesh…</source>
      <translation>Lecture du maillage…</translation>
    </message>
    <message>
      <source>Refine</source>
      <translation>Raffiner</translation>
    </message>
    <message>
      <source>Refine to edges of %1 instead</source>
      <translation>Raffiner plutôt à des arêtes de %1</translation>
    </message>
    <message>
      <source>Refinement</source>
      <translation>Raffinement</translation>
    </message>
    <message>
      <source>Refining first to edges of %1 would make %2. That is above the limit set in the preferences.</source>
      <translation>Raffiner d’abord à des arêtes de %1 donnerait %2. C’est plus que la limite fixée dans les préférences.</translation>
    </message>
    <message>
      <source>Refining first, to edges of %1: %2…</source>
      <translation>Raffinement préalable, à des arêtes de %1 : %2…</translation>
    </message>
    <message>
      <source>Report: %1</source>
      <translation>Rapport : %1</translation>
    </message>
    <message>
      <source>Report…</source>
      <translation>Rapport…</translation>
    </message>
    <message>
      <source>Reshape</source>
      <translation>Reformer</translation>
    </message>
    <message>
      <source>Saves all rows that are shown as CSV</source>
      <translation>Enregistre toutes les lignes affichées en CSV</translation>
    </message>
    <message>
      <source>Save…</source>
      <translation>Enregistrer…</translation>
    </message>
    <message>
      <source>Scaled Jacobian</source>
      <translation>Jacobien normalisé</translation>
    </message>
    <message>
      <source>Several FEM meshes are selected. Select one.</source>
      <translation>Plusieurs maillages EF sont sélectionnés. N'en sélectionnez qu'un.</translation>
    </message>
    <message>
      <source>Show crack</source>
      <translation>Montrer la fissure</translation>
    </message>
    <message>
      <source>Size</source>
      <translation>Taille</translation>
    </message>
    <message>
      <source>Smallest angle (dihedral in solids)</source>
      <translation>Plus petit angle (dièdre pour les volumes)</translation>
    </message>
    <message>
      <source>Sphere</source>
      <translation>Sphère</translation>
    </message>
    <message>
      <source>Status</source>
      <translation>État</translation>
    </message>
    <message>
      <source>Such as Box.Length / 2. With nothing entered the field takes numbers again.</source>
      <translation>Par exemple Box.Length / 2. Si rien n'est entré, le champ accepte de nouveau des nombres.</translation>
    </message>
    <message>
      <source>Take out of the analysis</source>
      <translation>Retirer de l’analyse</translation>
    </message>
    <message>
      <source>Text</source>
      <translation>Texte</translation>
    </message>
    <message>
      <source>That edge is curved. Pick a straight or a circular edge.</source>
      <translation>Cette arête est courbe. Choisissez une arête droite ou circulaire.</translation>
    </message>
    <message>
      <source>That face is curved. Pick a planar face.</source>
      <translation>Cette face est courbe. Choisissez une face plane.</translation>
    </message>
    <message>
      <source>That face is in no group. Click another one, or make a group of it first.</source>
      <translation>Cette face n'est dans aucun groupe. Cliquez sur une autre, ou faites-en d'abord un groupe.</translation>
    </message>
    <message>
      <source>That is %1; it must be a number, or in %2.</source>
      <translation>C'est %1 ; il faut un nombre, ou en %2.</translation>
    </message>
    <message>
      <source>That is no face of a part. Click one.</source>
      <translation>Ce n'est pas une face d'une pièce. Cliquez sur une face.</translation>
    </message>
    <message>
      <source>That is not the mesh. Click a face of the mesh.</source>
      <translation>Ce n'est pas le maillage. Cliquez sur une face du maillage.</translation>
    </message>
    <message>
      <source>That is not the mesh. Click a node of the mesh.</source>
      <translation>Ce n'est pas le maillage. Cliquez sur un nœud du maillage.</translation>
    </message>
    <message>
      <source>The direction is zero. Give one, or pick it from the 3-D view.</source>
      <translation>La direction est nulle. Donnez-en une ou choisissez-la dans la vue 3D.</translation>
    </message>
    <message>
      <source>The document has %1 FEM meshes. Select the one you mean in the tree.</source>
      <translation>Le document a %1 maillages EF. Sélectionnez celui voulu dans l'arborescence.</translation>
    </message>
    <message>
      <source>The document has no FEM mesh. Make one in the FEM workbench, or import a mesh file.</source>
      <translation>Le document n'a pas de maillage EF. Créez-en un dans l'atelier FEM ou importez un fichier de maillage.</translation>
    </message>
    <message>
      <source>The document has no other FEM mesh. Draw the part to add, and mesh it in the FEM workbench, or import a mesh file.</source>
      <translation>Le document n'a pas d'autre maillage EF. Dessinez la pièce à ajouter et maillez-la dans l'atelier FEM, ou importez un fichier de maillage.</translation>
    </message>
    <message>
      <source>The file holds %1 meshes. Which one?</source>
      <translation>Le fichier contient %1 maillages. Lequel ?</translation>
    </message>
    <message>
      <source>The mesh has %1 pieces now, %3 before: %2.</source>
      <translation>Le maillage a maintenant %1 morceaux, %3 avant : %2.</translation>
    </message>
    <message>
      <source>The mesh has neither faces nor volumes.</source>
      <translation>Le maillage n'a ni faces ni volumes.</translation>
    </message>
    <message>
      <source>The mesh has no group of faces or nodes. Make one first.</source>
      <translation>Le maillage n'a aucun groupe de faces ou de nœuds. Faites-en un d'abord.</translation>
    </message>
    <message>
      <source>The mesh has no such group any more.</source>
      <translation>Le maillage n'a plus ce groupe.</translation>
    </message>
    <message>
      <source>The numbers stay as they are when the geometry changes</source>
      <translation>Les nombres restent tels quels quand la géométrie change</translation>
    </message>
    <message>
      <source>The object could not be computed; see the report view.</source>
      <translation>L'objet n'a pas pu être calculé ; voir la vue rapport.</translation>
    </message>
    <message>
      <source>The part falls into %1 pieces: %2.</source>
      <translation>La pièce se sépare en %1 morceaux : %2.</translation>
    </message>
    <message>
      <source>The radius must be larger than 0.</source>
      <translation>Le rayon doit être supérieur à 0.</translation>
    </message>
    <message>
      <source>The three nodes lie on a line. Pick nodes that span a plane.</source>
      <translation>Les trois nœuds sont alignés. Choisissez des nœuds qui définissent un plan.</translation>
    </message>
    <message>
      <source>The whole plane</source>
      <translation>Tout le plan</translation>
    </message>
    <message>
      <source>These pages are in English.</source>
      <translation>Ces pages sont en anglais.</translation>
    </message>
    <message>
      <source>This command brings it; start FreeCAD anew then:

%1</source>
      <translation>Cette commande l'apporte ; redémarrez ensuite FreeCAD :

%1</translation>
    </message>
    <message>
      <source>This workbench was built without its example: Gmsh was not there.</source>
      <translation>Cet atelier a été construit sans son exemple : Gmsh n'était pas là.</translation>
    </message>
    <message>
      <source>Through the whole part</source>
      <translation>À travers toute la pièce</translation>
    </message>
    <message>
      <source>ToolFace is not set; choose the face of the geometry to cut with</source>
      <translation>ToolFace n'est pas défini ; choisissez la face de la géométrie avec laquelle couper</translation>
    </message>
    <message>
      <source>Torus</source>
      <translation>Tore</translation>
    </message>
    <message>
      <source>Type</source>
      <translation>Type</translation>
    </message>
    <message>
      <source>Unlink</source>
      <translation>Délier</translation>
    </message>
    <message>
      <source>Used by</source>
      <translation>Utilisé par</translation>
    </message>
    <message>
      <source>Value</source>
      <translation>Valeur</translation>
    </message>
    <message>
      <source>Vector</source>
      <translation>Vecteur</translation>
    </message>
    <message>
      <source>What nothing holds has no solution: hold it, or let the tool end inside the part.</source>
      <translation>Ce que rien ne tient n'a pas de solution : fixez-le, ou faites finir l'outil dans la pièce.</translation>
    </message>
    <message>
      <source>Whether elements are divided first, and how small they become</source>
      <translation>Si des éléments sont d'abord divisés, et à quelle taille</translation>
    </message>
    <message>
      <source>Whether elements near the tool (of a crack that ends inside: near its front) are divided first</source>
      <translation>Si les éléments près de l'outil (d'une fissure qui finit à l'intérieur : près de son front) sont d'abord divisés</translation>
    </message>
    <message>
      <source>Whether elements of both are divided first where the two meet</source>
      <translation>Si des éléments des deux sont d'abord divisés là où ils se rencontrent</translation>
    </message>
    <message>
      <source>Whole part</source>
      <translation>Pièce entière</translation>
    </message>
    <message>
      <source>Worse than your threshold of %1.</source>
      <translation>Pire que votre seuil de %1.</translation>
    </message>
    <message>
      <source>Worst elements</source>
      <translation>Plus mauvais éléments</translation>
    </message>
    <message>
      <source>Writing the file…</source>
      <translation>Écriture du fichier…</translation>
    </message>
    <message>
      <source>Writing the mesh for FreeCAD…</source>
      <translation>Écriture du maillage pour FreeCAD…</translation>
    </message>
    <message>
      <source>a second-order element near (%1) would be folded where the two meet: they are too coarse there for how they are curved. Refine both there first, or move the addition a little</source>
      <translation>un élément du second ordre près de (%1) serait replié là où les deux se rencontrent : ils y sont trop grossiers pour leur courbure. Raffinez d'abord les deux à cet endroit, ou déplacez un peu l'ajout</translation>
    </message>
    <message>
      <source>a slot of width %1 removes nothing: it is narrower than what the elements there can show. Make it wider, or refine the mesh there first</source>
      <translation>une entaille de largeur %1 n'enlève rien : elle est plus étroite que ce que les éléments peuvent y montrer. Élargissez-la, ou raffinez d'abord le maillage à cet endroit</translation>
    </message>
    <message>
      <source>all kept</source>
      <translation>tous</translation>
    </message>
    <message>
      <source>along: edges meet at (%1), a convex and a concave one: these cannot be rounded at once. Round one after the other</source>
      <translation>des arêtes se rencontrent en (%1), une convexe et une concave : elles ne peuvent être arrondies ensemble. Arrondissez-les l'une après l'autre</translation>
    </message>
    <message>
      <source>along: group '%1' is no edge: no feature line of the skin (sharper than feature_angle) runs along it</source>
      <translation>le groupe « %1 » n'est pas une arête : aucune arête vive de la peau (plus vive que l'angle limite) ne la suit</translation>
    </message>
    <message>
      <source>along: no feature line of the skin is within an edge length of the point (%1): the nearest is near (%2). Name a point on the edge</source>
      <translation>aucune arête vive de la peau n'est à moins d'une arête d'élément du point (%1) : la plus proche est près de (%2). Choisissez un point sur l'arête</translation>
    </message>
    <message>
      <source>and %1 other combinations of groups</source>
      <translation>et %1 autres combinaisons de groupes</translation>
    </message>
    <message>
      <source>back, +y</source>
      <translation>derrière, +y</translation>
    </message>
    <message>
      <source>beams</source>
      <translation>poutres</translation>
    </message>
    <message>
      <source>became empty</source>
      <translation>devenu vide</translation>
    </message>
    <message>
      <source>border between groups</source>
      <translation>bord entre groupes</translation>
    </message>
    <message>
      <source>border of what is made</source>
      <translation>bord de ce qui est créé</translation>
    </message>
    <message>
      <source>bottom, -z</source>
      <translation>en bas, -z</translation>
    </message>
    <message>
      <source>by a vector</source>
      <translation>d'un vecteur</translation>
    </message>
    <message>
      <source>changed</source>
      <translation>modifié</translation>
    </message>
    <message>
      <source>changed elements, poor to good (mean ratio 0 to 1)</source>
      <translation>éléments modifiés, de mauvais à bons (mean ratio de 0 à 1)</translation>
    </message>
    <message>
      <source>cone</source>
      <translation>cône</translation>
    </message>
    <message>
      <source>crack of %1</source>
      <translation>fissure de %1</translation>
    </message>
    <message>
      <source>cut off the addition</source>
      <translation>ôter de l'ajout</translation>
    </message>
    <message>
      <source>cut off the mesh</source>
      <translation>ôter du maillage</translation>
    </message>
    <message>
      <source>cylinder</source>
      <translation>cylindre</translation>
    </message>
    <message>
      <source>deform: only move nodes</source>
      <translation>deform : seulement déplacer des nœuds</translation>
    </message>
    <message>
      <source>depth is %1; it must be positive</source>
      <translation>la profondeur vaut %1 ; elle doit être positive</translation>
    </message>
    <message>
      <source>disk</source>
      <translation>disque</translation>
    </message>
    <message>
      <source>edges</source>
      <translation>arêtes</translation>
    </message>
    <message>
      <source>ellipse</source>
      <translation>ellipse</translation>
    </message>
    <message>
      <source>empty</source>
      <translation>vide</translation>
    </message>
    <message>
      <source>existing crack: %1</source>
      <translation>fissure existante : %1</translation>
    </message>
    <message>
      <source>face</source>
      <translation>face</translation>
    </message>
    <message>
      <source>faces</source>
      <translation>faces</translation>
    </message>
    <message>
      <source>facets</source>
      <translation>facettes</translation>
    </message>
    <message>
      <source>from %1</source>
      <translation>de %1</translation>
    </message>
    <message>
      <source>from %1, size included</source>
      <translation>de %1, taille comprise</translation>
    </message>
    <message>
      <source>front of %1</source>
      <translation>front de %1</translation>
    </message>
    <message>
      <source>front, -y</source>
      <translation>devant, -y</translation>
    </message>
    <message>
      <source>front: the crack ends here</source>
      <translation>front : la fissure finit ici</translation>
    </message>
    <message>
      <source>held by %1</source>
      <translation>tenu par %1</translation>
    </message>
    <message>
      <source>hexahedra</source>
      <translation>hexaèdres</translation>
    </message>
    <message>
      <source>in no group</source>
      <translation>dans aucun groupe</translation>
    </message>
    <message>
      <source>kept</source>
      <translation>gardé</translation>
    </message>
    <message>
      <source>kept where ticked</source>
      <translation>cochés</translation>
    </message>
    <message>
      <source>left, -x</source>
      <translation>à gauche, -x</translation>
    </message>
    <message>
      <source>mean ratio; line: before</source>
      <translation>mean ratio ; ligne : avant</translation>
    </message>
    <message>
      <source>middle</source>
      <translation>au milieu</translation>
    </message>
    <message>
      <source>more than %1 elements</source>
      <translation>plus de %1 éléments</translation>
    </message>
    <message>
      <source>moved nodes</source>
      <translation>nœuds déplacés</translation>
    </message>
    <message>
      <source>name '%1' has a character other than letters, digits, '_', '-' and '.'; solvers would not accept its groups</source>
      <translation>le nom « %1 » contient un caractère autre que lettres, chiffres, « _ », « - » et « . » ; les solveurs n'accepteraient pas ses groupes</translation>
    </message>
    <message>
      <source>name '%1' is taken: the mesh already has a group '%2'; choose another</source>
      <translation>le nom « %1 » est pris : le maillage a déjà un groupe « %2 » ; choisissez-en un autre</translation>
    </message>
    <message>
      <source>name '%1' is too long: group '%2' would have %3 characters, at most %4 are allowed</source>
      <translation>le nom « %1 » est trop long : le groupe « %2 » aurait %3 caractères, %4 au plus sont permis</translation>
    </message>
    <message>
      <source>name is empty; the new groups need one</source>
      <translation>le nom est vide ; les nouveaux groupes en ont besoin</translation>
    </message>
    <message>
      <source>negative</source>
      <translation>négatif</translation>
    </message>
    <message>
      <source>neither Along nor AlongPoints says which edge is rounded; give one</source>
      <translation>ni Along ni AlongPoints ne dit quelle arête est arrondie ; donnez-en un</translation>
    </message>
    <message>
      <source>never</source>
      <translation>jamais</translation>
    </message>
    <message>
      <source>new</source>
      <translation>nouveau</translation>
    </message>
    <message>
      <source>nodes</source>
      <translation>nœuds</translation>
    </message>
    <message>
      <source>nodes of the two near (%1) cannot be made one: an element there would be flat. Refine both there first, or move the addition a little</source>
      <translation>des nœuds des deux près de (%1) ne peuvent devenir un seul : un élément y serait plat. Raffinez d'abord les deux à cet endroit, ou déplacez un peu l'ajout</translation>
    </message>
    <message>
      <source>none</source>
      <translation>aucun</translation>
    </message>
    <message>
      <source>none picked yet</source>
      <translation>rien de choisi encore</translation>
    </message>
    <message>
      <source>none yet</source>
      <translation>aucun encore</translation>
    </message>
    <message>
      <source>not in FreeCAD's mesh, but kept with it for operations and export: %1</source>
      <translation>pas dans le maillage de FreeCAD, mais gardé avec lui pour les opérations et l’export : %1</translation>
    </message>
    <message>
      <source>nothing holds %1 of them</source>
      <translation>rien ne tient %1 d'entre eux</translation>
    </message>
    <message>
      <source>nothing holds it</source>
      <translation>rien ne le tient</translation>
    </message>
    <message>
      <source>off</source>
      <translation>désactivé</translation>
    </message>
    <message>
      <source>onto a surface</source>
      <translation>sur une surface</translation>
    </message>
    <message>
      <source>plane</source>
      <translation>plan</translation>
    </message>
    <message>
      <source>points</source>
      <translation>points</translation>
    </message>
    <message>
      <source>positive</source>
      <translation>positif</translation>
    </message>
    <message>
      <source>prisms</source>
      <translation>prismes</translation>
    </message>
    <message>
      <source>pyramids</source>
      <translation>pyramides</translation>
    </message>
    <message>
      <source>quadrangles</source>
      <translation>quadrangles</translation>
    </message>
    <message>
      <source>radius is %1; it must be a positive length</source>
      <translation>le rayon vaut %1 ; il doit être une longueur positive</translation>
    </message>
    <message>
      <source>radius: %1 is too large for a face beside the edge, which ends, or is not what it is at the edge, before the distance of %2 at which it would be touched. There is room for about %3, near (%4)</source>
      <translation>le rayon %1 est trop grand pour une face au bord de l'arête : elle finit, ou change, avant la distance %2 où elle serait touchée. Il y a place pour environ %3, près de (%4)</translation>
    </message>
    <message>
      <source>reduced</source>
      <translation>réduit</translation>
    </message>
    <message>
      <source>removed</source>
      <translation>supprimé</translation>
    </message>
    <message>
      <source>right, +x</source>
      <translation>à droite, +x</translation>
    </message>
    <message>
      <source>scaled about a point</source>
      <translation>à l'échelle</translation>
    </message>
    <message>
      <source>size %1 would make more than %2 elements. Choose a larger size or gradation, or a larger max_elements</source>
      <translation>la taille %1 donnerait plus de %2 éléments. Choisissez une taille ou une progression plus grande</translation>
    </message>
    <message>
      <source>size is %1; it must be a positive length</source>
      <translation>la taille vaut %1 ; elle doit être une longueur positive</translation>
    </message>
    <message>
      <source>snap: move and split</source>
      <translation>snap : déplacer et diviser</translation>
    </message>
    <message>
      <source>some %1 elements</source>
      <translation>environ %1 éléments</translation>
    </message>
    <message>
      <source>sphere</source>
      <translation>sphère</translation>
    </message>
    <message>
      <source>the %1 is smaller than the elements there, and parts none of them. Refine the mesh there first, or move the %1 into the material</source>
      <translation>l'outil (%1) est plus petit que les éléments à cet endroit et n'en sépare aucun. Raffinez d'abord le maillage, ou déplacez l'outil dans la matière</translation>
    </message>
    <message>
      <source>the %1 lies inside %2, between their nodes, and parts none of them: it is smaller than the elements there. Refine the mesh there first</source>
      <translation>l'outil (%1) est à l'intérieur de %2, entre leurs nœuds, et n'en sépare aucun : il est plus petit que les éléments à cet endroit. Raffinez-y d'abord le maillage</translation>
    </message>
    <message>
      <source>the %1 lies on faces that are open already: the elements on its two sides have nodes of their own there (a contact, or an earlier crack), and there is nothing to part. Move the %1 into the material</source>
      <translation>l'outil (%1) est sur des faces déjà ouvertes : les éléments des deux côtés y ont leurs propres nœuds (un contact, ou une fissure antérieure), et il n'y a rien à séparer. Déplacez-le dans la matière</translation>
    </message>
    <message>
      <source>the %1 meets a surface or group border at %2: elements in the wedge between them cannot be better than the wedge</source>
      <translation>l'outil (%1) rencontre une surface ou un bord de groupe sous %2 : les éléments du coin entre eux ne peuvent être meilleurs que ce coin</translation>
    </message>
    <message>
      <source>the %1 meets the mesh only outside the part of it that is to cut. Move that part into the material</source>
      <translation>l'outil (%1) ne rencontre le maillage qu'en dehors de la partie qui doit couper. Déplacez cette partie dans la matière</translation>
    </message>
    <message>
      <source>the %1 misses the mesh: it passes between parts of the mesh, through no element; the nearest nodes are at distance %2 on its negative side and %3 on its positive side. Move the %1 or turn it</source>
      <translation>l'outil (%1) manque le maillage : il passe entre des parties du maillage, à travers aucun élément ; les nœuds les plus proches sont à la distance %2 de son côté négatif et %3 de son côté positif. Déplacez-le ou tournez-le</translation>
    </message>
    <message>
      <source>the %1 misses the mesh: it passes only through segments (%2), which cannot be divided (springs, dashpots, gaps). Move the %1 or turn it</source>
      <translation>l'outil (%1) manque le maillage : il ne passe que par des segments (%2) qui ne peuvent être divisés (ressorts, amortisseurs, jeux). Déplacez-le ou tournez-le</translation>
    </message>
    <message>
      <source>the %1 misses the mesh: the whole mesh lies on its %2 side, the nearest node at distance %3. Move the %1 or turn it</source>
      <translation>l'outil (%1) manque le maillage : tout le maillage est de son côté %2, le nœud le plus proche à la distance %3. Déplacez-le ou tournez-le</translation>
    </message>
    <message>
      <source>the %1 only grazes the mesh: it passes through the curved sides of %2, but between none of their corners. Move the %1 into the material</source>
      <translation>l'outil (%1) ne fait qu'effleurer le maillage : il passe par les côtés courbes de %2, mais entre aucun de leurs coins. Déplacez-le dans la matière</translation>
    </message>
    <message>
      <source>the %1 only grazes the mesh: what it would cut off is thinner than the elements there. Move the %1 into the material</source>
      <translation>l'outil (%1) ne fait qu'effleurer le maillage : ce qu'il couperait est plus mince que les éléments à cet endroit. Déplacez-le dans la matière</translation>
    </message>
    <message>
      <source>the %1 only touches the mesh, along edges or in single nodes: it passes through no element and along no face. Move the %1 into the material</source>
      <translation>l'outil (%1) ne fait que toucher le maillage, le long d'arêtes ou en des nœuds isolés : il ne passe par aucun élément ni le long d'aucune face. Déplacez-le dans la matière</translation>
    </message>
    <message>
      <source>the %1 only touches the mesh, on its outside: all elements there are on its %2 side, and there is nothing to part. Move the %1 into the material</source>
      <translation>l'outil (%1) ne fait que toucher le maillage, sur son extérieur : tous les éléments y sont de son côté %2, et il n'y a rien à séparer. Déplacez-le dans la matière</translation>
    </message>
    <message>
      <source>the %1 removes nothing: it is smaller than the elements there, and none lies inside. Refine the mesh there first, or move the %1 into the material</source>
      <translation>l'outil (%1) n'enlève rien : il est plus petit que les éléments à cet endroit, et aucun n'est dedans. Raffinez d'abord le maillage, ou déplacez l'outil dans la matière</translation>
    </message>
    <message>
      <source>the %1 removes nothing: it touches the mesh from outside, and no element lies inside. Move the %1 into the material</source>
      <translation>l'outil (%1) n'enlève rien : il touche le maillage de l'extérieur, et aucun élément n'est dedans. Déplacez-le dans la matière</translation>
    </message>
    <message>
      <source>the %1 removes nothing: what it would take off is thinner than the elements there. Refine the mesh there, or move the %1 into the material</source>
      <translation>l'outil (%1) n'enlève rien : ce qu'il enlèverait est plus mince que les éléments à cet endroit. Raffinez-y le maillage, ou déplacez l'outil dans la matière</translation>
    </message>
    <message>
      <source>the %1 runs along a feature line or border line at %2: elements between them cannot be better than that wedge</source>
      <translation>l'outil (%1) longe une arête vive ou un bord sous %2 : les éléments entre eux ne peuvent être meilleurs que ce coin</translation>
    </message>
    <message>
      <source>the %1 runs within 0.15 edge lengths of a nearly parallel surface or group border at %2 node(s): the layer between them is that thin</source>
      <translation>l'outil (%1) passe à moins de 0,15 longueur d'arête d'une surface ou d'un bord de groupe presque parallèle, en %2 nœud(s) : la couche entre eux est aussi mince</translation>
    </message>
    <message>
      <source>the %1 would remove the whole mesh: all of it lies inside. Make the tool smaller, or move it</source>
      <translation>l'outil (%1) enlèverait tout le maillage : tout est dedans. Rapetissez l'outil, ou déplacez-le</translation>
    </message>
    <message>
      <source>the addition does not meet the mesh: nowhere do their surfaces cross, and no border of the one is on the other. The mesh reaches from (%1) to (%2), the addition from (%3) to (%4). Move the addition, or give a larger tolerance</source>
      <translation>l'ajout ne rencontre pas le maillage : leurs surfaces ne se croisent nulle part, et aucun bord de l'un n'est sur l'autre. Le maillage va de (%1) à (%2), l'ajout de (%3) à (%4). Déplacez l'ajout, ou donnez une tolérance plus grande</translation>
    </message>
    <message>
      <source>the addition is finer than the mesh, which was refined first, to edges of %1 where they meet: from %2 to %3 elements</source>
      <translation>l'ajout est plus fin que le maillage, qui a d'abord été raffiné, à des arêtes de %1 là où ils se rencontrent : de %2 à %3 éléments</translation>
    </message>
    <message>
      <source>the addition is so much finer than the mesh that this would be refined from %1 to %2 elements, with edges of %3 where they meet. Give refine=%4, a longer edge there, or False for none; or mesh the finer one coarser, or add it as a shell</source>
      <translation>l'ajout est tellement plus fin que le maillage que celui-ci serait raffiné de %1 à %2 éléments, avec des arêtes de %3 là où ils se rencontrent. Choisissez une longueur d'arête de %4 sous « Raffiner d'abord », ou « jamais » ; ou maillez le plus fin plus grossièrement, ou ajoutez-le comme coque</translation>
    </message>
    <message>
      <source>the addition: along the seam its own curved skin is left by up to %1 (%2 edge(s)): the mesh is not flat there, or its elements have no room for curves. Refine both there first</source>
      <translation>l'ajout : le long de la couture, sa propre peau courbe est quittée de %1 au plus (%2 arête(s)) : le maillage n'y est pas plan, ou ses éléments n’ont pas de place pour des courbes. Raffinez d’abord les deux à cet endroit</translation>
    </message>
    <message>
      <source>the crack along the %1 cannot open: all its nodes are on its front. Refine the mesh there first</source>
      <translation>la fissure (%1) ne peut s'ouvrir : tous ses nœuds sont sur son front. Raffinez-y d'abord le maillage</translation>
    </message>
    <message>
      <source>the crack lies outside the part: there is no material within its front. Move it into the material</source>
      <translation>la fissure est hors de la pièce : il n'y a pas de matière à l'intérieur de son front. Déplacez-la dans la matière</translation>
    </message>
    <message>
      <source>the edge cannot be rounded near (%1): a border of groups, or another surface that is kept, runs through the material there, and does not cross the edge in one plane</source>
      <translation>l'arête ne peut être arrondie près de (%1) : un bord de groupes, ou une autre surface conservée, y traverse la matière et ne croise pas l'arête dans un plan</translation>
    </message>
    <message>
      <source>the edge goes on beyond what was named, and is rounded as far as it goes</source>
      <translation>l'arête continue au-delà de ce qui a été choisi, et est arrondie aussi loin qu'elle va</translation>
    </message>
    <message>
      <source>the mesh already has %1 flat or inverted element(s) near the tool (%2); repair the mesh first</source>
      <translation>le maillage a déjà %1 élément(s) plats ou retournés près de l'outil (%2) ; réparez d'abord le maillage</translation>
    </message>
    <message>
      <source>the mesh has no group '%1'</source>
      <translation>le maillage n'a pas de groupe « %1 »</translation>
    </message>
    <message>
      <source>the mesh is coarse for the %1 of radius %2: the flat faces of the wall leave about %3 % of the hole standing. Refine the mesh there first, to edges of at most %4</source>
      <translation>le maillage est grossier pour l'outil (%1) de rayon %2 : les faces planes de la paroi laissent environ %3 % du trou. Raffinez-y d'abord le maillage, à des arêtes d'au plus %4</translation>
    </message>
    <message>
      <source>the mesh is finer than the addition, which was refined first, to edges of %1 where they meet: from %2 to %3 elements</source>
      <translation>le maillage est plus fin que l'ajout, qui a d'abord été raffiné, à des arêtes de %1 là où ils se rencontrent : de %2 à %3 éléments</translation>
    </message>
    <message>
      <source>the mesh is not the one that was imported any more: what the file held beside nodes, elements and groups (a deck's cards, fields, groups of element faces) is not written</source>
      <translation>le maillage n’est plus celui qui a été importé : ce que le fichier contenait outre nœuds, éléments et groupes (cartes d’un jeu de données, champs, groupes de faces d’éléments) n’est pas écrit</translation>
    </message>
    <message>
      <source>the mesh is so much finer than the addition that this would be refined from %1 to %2 elements, with edges of %3 where they meet. Give refine=%4, a longer edge there, or False for none; or mesh the finer one coarser, or add it as a shell</source>
      <translation>le maillage est tellement plus fin que l'ajout que celui-ci serait raffiné de %1 à %2 éléments, avec des arêtes de %3 là où ils se rencontrent. Choisissez une longueur d'arête de %4 sous « Raffiner d'abord », ou « jamais » ; ou maillez le plus fin plus grossièrement, ou ajoutez-le comme coque</translation>
    </message>
    <message>
      <source>the mesh is too coarse for the %1 of radius %2 near (%3): an element with edges of %4 would reach deep into it. Refine the mesh there first, to edges of at most %5</source>
      <translation>le maillage est trop grossier pour l'outil (%1) de rayon %2 près de (%3) : un élément d'arêtes de %4 y pénétrerait loin. Raffinez-y d'abord le maillage, à des arêtes d'au plus %5</translation>
    </message>
    <message>
      <source>the mesh is too coarse for the %1 of radius %2 near (%3): an element with edges of %4 would reach deep into it. Refine the mesh there first, to edges of at most %5, or move the tool: it may nearly touch a border or the skin there, and leave only a thin layer of material</source>
      <translation>le maillage est trop grossier pour l'outil (%1) de rayon %2 près de (%3) : un élément d'arêtes de %4 y pénétrerait loin. Raffinez-y d'abord le maillage, à des arêtes d'au plus %5, ou déplacez l'outil : il touche peut-être presque un bord ou la peau, et ne laisse qu'une mince couche de matière</translation>
    </message>
    <message>
      <source>the mesh is too coarse for the crack: its front would be cut short by up to %1. Refine the mesh near the crack front first, or make the crack larger</source>
      <translation>le maillage est trop grossier pour la fissure : son front serait raccourci de jusqu'à %1. Raffinez d'abord le maillage près du front, ou agrandissez la fissure</translation>
    </message>
    <message>
      <source>the mesh is too coarse for the crack: no element face fits in it. Refine the mesh near the crack front first, or make the crack larger</source>
      <translation>le maillage est trop grossier pour la fissure : aucune face d'élément n'y tient. Raffinez d'abord le maillage près du front, ou agrandissez la fissure</translation>
    </message>
    <message>
      <source>the mesh that '%1' is made from is in no analysis</source>
      <translation>le maillage dont « %1 » est issu n'est dans aucune analyse</translation>
    </message>
    <message>
      <source>the new group '%1' would be taken for the nodes of '%2'; choose another GroupName</source>
      <translation>le nouveau groupe « %1 » serait pris pour les nœuds de « %2 » ; choisissez un autre GroupName</translation>
    </message>
    <message>
      <source>the results of '%1' are removed; solve again</source>
      <translation>les résultats de « %1 » ont été supprimés ; relancez le calcul</translation>
    </message>
    <message>
      <source>the tool is finer than the mesh, which was refined first, to edges of %1 near the tool: from %2 to %3 elements. refine=%4 makes fewer, refine=False none, but then a coarser wall or front</source>
      <translation>l'outil est plus fin que le maillage, qui a d'abord été raffiné, à des arêtes de %1 près de l'outil : de %2 à %3 éléments. Une longueur de %4 en donne moins, « jamais » aucun, mais alors une paroi ou un front plus grossier</translation>
    </message>
    <message>
      <source>the wall %1 (%2) lies beyond the part: what is removed reaches right through there</source>
      <translation>la paroi %1 (%2) est au-delà de la pièce : ce qui est enlevé y traverse de part en part</translation>
    </message>
    <message>
      <source>the wall cannot be moved so far: it would pass through the part, and leave it on another side near (%1). Move it less</source>
      <translation>la paroi ne peut être déplacée si loin : elle traverserait la pièce et en sortirait d'un autre côté près de (%1). Déplacez-la moins</translation>
    </message>
    <message>
      <source>to an edge length</source>
      <translation>jusqu'à une longueur d'arête</translation>
    </message>
    <message>
      <source>top, +z</source>
      <translation>en haut, +z</translation>
    </message>
    <message>
      <source>torus</source>
      <translation>tore</translation>
    </message>
    <message>
      <source>triangles of seven nodes</source>
      <translation>triangles à sept nœuds</translation>
    </message>
    <message>
      <source>unchanged</source>
      <translation>inchangé</translation>
    </message>
    <message>
      <source>untouched</source>
      <translation>intact</translation>
    </message>
    <message>
      <source>volumes</source>
      <translation>volumes</translation>
    </message>
    <message>
      <source>wall of %1</source>
      <translation>paroi de %1</translation>
    </message>
    <message>
      <source>where one of them is finer</source>
      <translation>là où l'un des deux est plus fin</translation>
    </message>
    <message>
      <source>where the tool is finer</source>
      <translation>où l'outil est plus fin</translation>
    </message>
    <message>
      <source>width is %1; it must be positive</source>
      <translation>la largeur vaut %1 ; elle doit être positive</translation>
    </message>
    <message>
      <source>with groups %1</source>
      <translation>avec les groupes %1</translation>
    </message>
    <message>
      <source>worst %1</source>
      <translation>pire %1</translation>
    </message>
  </context>
  <context>
    <name>FemScalpelPreferences</name>
    <message>
      <source> MB</source>
      <translation> Mo</translation>
    </message>
    <message>
      <source>Ask before refining takes more memory than</source>
      <translation>Demander avant qu’un raffinement prenne plus de mémoire que</translation>
    </message>
    <message>
      <source>Ask before refining to more elements than</source>
      <translation>Demander avant de raffiner à plus d’éléments que</translation>
    </message>
    <message>
      <source>Borders of groups</source>
      <translation>Bords des groupes</translation>
    </message>
    <message>
      <source>Chosen group</source>
      <translation>Groupe choisi</translation>
    </message>
    <message>
      <source>Colours of the preview</source>
      <translation>Couleurs de l'aperçu</translation>
    </message>
    <message>
      <source>Crack and walls</source>
      <translation>Fissure et parois</translation>
    </message>
    <message>
      <source>Crack front</source>
      <translation>Front de fissure</translation>
    </message>
    <message>
      <source>General</source>
      <translation>Général</translation>
    </message>
    <message>
      <source>Method</source>
      <translation>Méthode</translation>
    </message>
    <message>
      <source>Moved nodes</source>
      <translation>Nœuds déplacés</translation>
    </message>
    <message>
      <source>New operations</source>
      <translation>Nouvelles opérations</translation>
    </message>
    <message>
      <source>Put new meshes in place of their source in the analysis</source>
      <translation>Mettre les nouveaux maillages à la place de leur source dans l'analyse</translation>
    </message>
    <message>
      <source>Removed elements</source>
      <translation>Éléments supprimés</translation>
    </message>
    <message>
      <source>Transition (rings of elements that may move)</source>
      <translation>Transition (couches d'éléments qui peuvent bouger)</translation>
    </message>
    <message>
      <source>Warn of elements with a mean ratio below</source>
      <translation>Avertir des éléments de mean ratio inférieur à</translation>
    </message>
    <message>
      <source>automatic</source>
      <translation>automatique</translation>
    </message>
    <message>
      <source>deform: only move nodes</source>
      <translation>deform : seulement déplacer des nœuds</translation>
    </message>
    <message>
      <source>half of what is free</source>
      <translation>la moitié de ce qui est libre</translation>
    </message>
    <message>
      <source>snap: move and split</source>
      <translation>snap : déplacer et diviser</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Crack</name>
    <message>
      <source>Crack</source>
      <translation>Fissure</translation>
    </message>
    <message>
      <source>Cracks the FEM mesh along a plane and keeps its groups</source>
      <translation>Fissure le maillage EF le long d'un plan en gardant ses groupes</translation>
    </message>
    <message>
      <source>Opens the FEM mesh along a plane. Give the plane by numbers, pick it from the view (three nodes, a planar face, an edge, a datum, a sketch, the view direction) or drag the handles; the preview shows the mesh as it will be. OK makes an object that follows its source mesh. The faces of both lips become groups; all other groups keep their meaning.</source>
      <translation>Ouvre le maillage EF le long d'un plan. Donnez le plan par des nombres, prenez-le dans la vue (trois nœuds, une face plane, une arête, une référence, une esquisse, la direction de vue) ou tirez les poignées ; l'aperçu montre le maillage tel qu'il sera. OK crée un objet qui suit son maillage source. Les faces des deux lèvres deviennent des groupes ; tous les autres groupes gardent leur sens.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_CurvedCrack</name>
    <message>
      <source>Cracks the FEM mesh along a sphere, torus, cone or face of a part and keeps its groups</source>
      <translation>Fissure le maillage EF le long d'une sphère, d'un tore, d'un cône ou d'une face de pièce et garde ses groupes</translation>
    </message>
    <message>
      <source>Curved crack</source>
      <translation>Fissure courbe</translation>
    </message>
    <message>
      <source>Opens the FEM mesh along a sphere, torus, cone or cylinder, given by numbers, picked from the view or dragged by its handles; or along faces of a part drawn in FreeCAD: as far as these go, and where they end inside the material is the crack front. Faces that are selected before are taken. The preview shows the mesh as it will be; the faces of both lips become groups; all other groups keep their meaning.</source>
      <translation>Ouvre le maillage EF le long d'une sphère, d'un tore, d'un cône ou d'un cylindre, donné par des nombres, choisi dans la vue ou tiré par ses poignées ; ou le long de faces d'une pièce dessinée dans FreeCAD : jusqu'où elles vont, et là où elles finissent dans la matière se trouve le front de fissure. Les faces sélectionnées avant sont prises. L'aperçu montre le maillage tel qu'il sera ; les faces des deux lèvres deviennent des groupes ; tous les autres groupes gardent leur sens.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_CylindricalCrack</name>
    <message>
      <source>Cracks the FEM mesh along a cylinder and keeps its groups</source>
      <translation>Fissure le maillage EF le long d'un cylindre en gardant ses groupes</translation>
    </message>
    <message>
      <source>Cylindrical crack</source>
      <translation>Fissure cylindrique</translation>
    </message>
    <message>
      <source>Opens the FEM mesh along a cylinder. Give axis and radius by numbers, pick them from the view (a cylindrical face, a straight or circular edge, two nodes, a point on a face) or drag the handles. It may crack between two heights and two angles only. Elements that are large for the cylinder are divided first.</source>
      <translation>Ouvre le maillage FEM le long d'un cylindre. Donnez l'axe et le rayon en nombres, choisissez-les dans la vue (une face cylindrique, une arête droite ou circulaire, deux nœuds, un point sur une face) ou tirez les poignées. La fissure peut aussi n'aller qu'entre deux hauteurs et deux angles. Les éléments grands pour le cylindre sont d'abord divisés.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Drill</name>
    <message>
      <source>Drill</source>
      <translation>Perçage</translation>
    </message>
    <message>
      <source>Drills a hole into the FEM mesh and keeps its groups</source>
      <translation>Perce un trou dans le maillage EF en gardant ses groupes</translation>
    </message>
    <message>
      <source>Drills a hole, through or to a depth. Give axis and radius as for a cylindrical crack; the elements that go are shown as ghosts. The faces of the wall become a group; groups lose what is drilled away and nothing else, and the report says which.</source>
      <translation>Perce un trou, débouchant ou d'une profondeur donnée. L'axe et le rayon se donnent comme pour une fissure cylindrique ; les éléments enlevés sont montrés en transparence. Les faces de la paroi forment un groupe ; les groupes perdent ce qui est percé et rien d'autre, et le rapport dit lesquels.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Example</name>
    <message>
      <source>Example: caisson</source>
      <translation>Exemple : caisson</translation>
    </message>
    <message>
      <source>Opens a new document with the mesh of a caisson that hangs on stiffeners, in an analysis: tetrahedra with groups for parts, supports, loads and gauges. Crack a hanger, drill the floor, look at the groups before and after.</source>
      <translation>Ouvre un nouveau document avec le maillage d'un caisson suspendu à des raidisseurs, dans une analyse : des tétraèdres avec des groupes pour les pièces, les appuis, les charges et les points de mesure. Fissurez une suspente, percez le plancher, regardez les groupes avant et après.</translation>
    </message>
    <message>
      <source>Opens a welded caisson as a new document, a mesh with 35 groups to try the commands on</source>
      <translation>Ouvre un caisson soudé comme nouveau document, un maillage de 35 groupes pour essayer les commandes</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Export</name>
    <message>
      <source>Export mesh…</source>
      <translation>Exporter le maillage…</translation>
    </message>
    <message>
      <source>Writes the FEM mesh with its groups to a file, in a format of solvers or viewers</source>
      <translation>Écrit le maillage EF avec ses groupes dans un fichier, dans un format de solveur ou de visualiseur</translation>
    </message>
    <message>
      <source>Writes the mesh with its groups to a file whose ending says the format. The file dialog lists the formats.</source>
      <translation>Écrit le maillage avec ses groupes dans un fichier dont l'extension dit le format. Le dialogue de fichiers énumère les formats.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_FaceCrack</name>
    <message>
      <source>Crack along faces</source>
      <translation>Fissure le long de faces</translation>
    </message>
    <message>
      <source>Cracks the FEM mesh along faces that it has, those of a group</source>
      <translation>Fissure le maillage EF le long de faces existantes, celles d'un groupe</translation>
    </message>
    <message>
      <source>Opens the FEM mesh along faces between its elements. Choose a group of such faces (of a shell: of edges), or of their nodes; elements may be of any type, and none moves or is divided. OK makes an object that follows its source mesh. The faces of both lips become groups; all other groups keep their meaning.</source>
      <translation>Ouvre le maillage EF le long de faces entre ses éléments. Choisissez un groupe de telles faces (d'une coque : d'arêtes) ou de leurs nœuds ; les éléments peuvent être de tout type, aucun n'est déplacé ni divisé. OK crée un objet qui suit son maillage source. Les faces des deux lèvres deviennent des groupes ; tous les autres groupes gardent leur sens.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Fillet</name>
    <message>
      <source>Fillet</source>
      <translation>Congé</translation>
    </message>
    <message>
      <source>Rounds an edge, convex or concave, as a ball of the radius would that rolls along it. Click near the edge in the 3-D view, or choose a group on it; it is rounded as far as it goes on without a corner. The faces of the rounding become a group, and the groups beside it keep to their sides.</source>
      <translation>Arrondit une arête, convexe ou concave, comme une bille de ce rayon qui roule le long d'elle. Cliquez près de l'arête dans la vue 3D, ou choisissez un groupe sur elle ; elle est arrondie aussi loin qu'elle continue sans coin. Les faces du congé deviennent un groupe, et les groupes voisins restent de leur côté.</translation>
    </message>
    <message>
      <source>Rounds edges of the FEM mesh and keeps its groups</source>
      <translation>Arrondit des arêtes du maillage EF et garde ses groupes</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_GroupInspector</name>
    <message>
      <source>Group inspector</source>
      <translation>Inspecteur de groupes</translation>
    </message>
    <message>
      <source>Lists the groups of the FEM mesh with kind, size, measure and what uses them. Tick groups to see them, double-click a name to rename the group and a colour to change it. Elementary groups are the entities that are in exactly the same groups; bounding, linking and isolated entities are what an operation must keep in shape.</source>
      <translation>Liste les groupes du maillage EF avec leur genre, leur taille, leur mesure et ce qui les utilise. Cochez des groupes pour les voir, double-cliquez sur un nom pour renommer le groupe et sur une couleur pour la changer. Les groupes élémentaires réunissent les entités qui sont exactement dans les mêmes groupes ; les entités de bord, de liaison et isolées sont celles dont une opération doit garder la forme.</translation>
    </message>
    <message>
      <source>Shows the groups of a FEM mesh, what they cover and what uses them</source>
      <translation>Montre les groupes d'un maillage EF, ce qu'ils couvrent et ce qui les utilise</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_ImportMesh</name>
    <message>
      <source>Import mesh…</source>
      <translation>Importer un maillage…</translation>
    </message>
    <message>
      <source>Reads a FEM mesh with its groups from a file, and keeps what else the file holds</source>
      <translation>Lit un maillage EF avec ses groupes dans un fichier, et garde ce que le fichier contient d’autre</translation>
    </message>
    <message>
      <source>Reads a mesh with its groups from a file. Cards of a CalculiX deck, fields and groups of element faces are kept in the document, and Export writes them, after cracks and holes too.</source>
      <translation>Lit un maillage avec ses groupes dans un fichier. Les cartes d’un jeu de données CalculiX, les champs et les groupes de faces d’éléments restent dans le document, et Exporter les écrit, même après fissures et perçages.</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Incision</name>
    <message>
      <source>Cuts a slot between two parallel planes. Give the plane in the middle as for a crack, the width, and whether it goes right through or down to the plane's point; the elements that go are shown as ghosts. The faces of the two walls become groups; groups lose what is cut away and nothing else, and the report says which.</source>
      <translation>Coupe une fente entre deux plans parallèles. Donnez le plan du milieu comme pour une fissure, la largeur, et si elle traverse toute la pièce ou va jusqu'au point du plan ; les éléments qui disparaissent sont montrés en fantômes. Les faces des deux parois deviennent des groupes ; les groupes perdent ce qui est coupé et rien d'autre, et le rapport dit lesquels.</translation>
    </message>
    <message>
      <source>Cuts a slot into the FEM mesh and keeps its groups</source>
      <translation>Coupe une fente dans le maillage EF et garde ses groupes</translation>
    </message>
    <message>
      <source>Incision</source>
      <translation>Incision</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Merge</name>
    <message>
      <source>Adds another FEM mesh to the FEM mesh and keeps the groups of both</source>
      <translation>Ajoute un autre maillage EF au maillage EF et garde les groupes des deux</translation>
    </message>
    <message>
      <source>Adds another FEM mesh, such as a stiffener or a boss drawn in FreeCAD and meshed there. Where the two touch or cross they get the same nodes and edges; where two solids overlap, the overlap is cut off one of them. Select the mesh first, then the one to add, or choose that in the panel. The groups of both stay, and what was added and where it is joined become groups.</source>
      <translation>Ajoute un autre maillage EF, tel qu'un raidisseur ou un bossage dessiné et maillé dans FreeCAD. Là où les deux se touchent ou se croisent, ils reçoivent les mêmes nœuds et arêtes ; là où deux solides se recouvrent, le recouvrement est ôté de l'un d'eux. Sélectionnez d'abord le maillage, puis celui à ajouter, ou choisissez celui-ci dans le panneau. Les groupes des deux restent ; ce qui est ajouté et son raccord deviennent des groupes.</translation>
    </message>
    <message>
      <source>Merge</source>
      <translation>Fusion</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_MeshQuality</name>
    <message>
      <source>Colours the elements by mean ratio (1: equilateral, 0: flat), smallest dihedral angle or scaled Jacobian. Click one of the worst elements to go to it. The mesh is not changed.</source>
      <translation>Colore les éléments selon le rapport moyen (1 : équilatéral, 0 : plat), le plus petit angle dièdre ou le jacobien normalisé. Cliquez sur l'un des pires éléments pour y aller. Le maillage n'est pas modifié.</translation>
    </message>
    <message>
      <source>Mesh quality</source>
      <translation>Qualité du maillage</translation>
    </message>
    <message>
      <source>Shows the quality of the elements of a FEM mesh in colours and finds the worst</source>
      <translation>Montre en couleurs la qualité des éléments d'un maillage EF et trouve les plus mauvais</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Refine</name>
    <message>
      <source>Divides the elements near a cylinder, sphere, plane, CAD face or other tool until their edges are as short as you ask, growing towards the rest of the mesh by the gradation. Use it where a crack or hole needs a finer mesh around it. All groups keep their meaning.</source>
      <translation>Divise les éléments près d'un cylindre, d'une sphère, d'un plan, d'une face CAO ou d'un autre outil jusqu'à ce que leurs arêtes soient aussi courtes que demandé, en grandissant vers le reste du maillage selon la gradation. Utile là où une fissure ou un trou demande un maillage plus fin autour de lui. Tous les groupes gardent leur sens.</translation>
    </message>
    <message>
      <source>Refine</source>
      <translation>Raffiner</translation>
    </message>
    <message>
      <source>Refines the FEM mesh near a cylinder, sphere or other tool and keeps its groups</source>
      <translation>Raffine le maillage EF près d'un cylindre, d'une sphère ou d'un autre outil et garde ses groupes</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_Reshape</name>
    <message>
      <source>Moves a wall of the FEM mesh and keeps its groups</source>
      <translation>Déplace une paroi du maillage EF et garde ses groupes</translation>
    </message>
    <message>
      <source>Moves what a group covers: the wall of a hole to another radius, a face to another plane, by a vector, or scaled about a point. The panel begins with the plane, cylinder or sphere that the wall lies on. The elements around follow as far as needed and are divided or merged where they would get poor. All groups keep their meaning.</source>
      <translation>Déplace ce qu'un groupe couvre : la paroi d'un trou à un autre rayon, une face sur un autre plan, d'un vecteur, ou à l'échelle autour d'un point. Le panneau commence par le plan, le cylindre ou la sphère où se trouve la paroi. Les éléments voisins suivent autant qu'il faut et sont divisés ou réunis là où ils deviendraient mauvais. Tous les groupes gardent leur sens.</translation>
    </message>
    <message>
      <source>Reshape</source>
      <translation>Reformer</translation>
    </message>
  </context>
  <context>
    <name>FemScalpel_WhatIsMissing</name>
    <message>
      <source>Says which part of FemScalpel is missing and which command brings it</source>
      <translation>Dit quelle partie de FemScalpel manque et quelle commande l'apporte</translation>
    </message>
    <message>
      <source>What is missing...</source>
      <translation>Ce qui manque...</translation>
    </message>
  </context>
  <context>
    <name>GroupInspector</name>
    <message>
      <source>All</source>
      <translation>Tous</translation>
    </message>
    <message>
      <source>Groups</source>
      <translation>Groupes</translation>
    </message>
    <message>
      <source>Groups, or the disjoint classes of entities that are in exactly the same groups</source>
      <translation>Groupes, ou classes disjointes des entités qui sont exactement dans les mêmes groupes</translation>
    </message>
    <message>
      <source>None</source>
      <translation>Aucun</translation>
    </message>
    <message>
      <source>Only selected</source>
      <translation>Seuls choisis</translation>
    </message>
    <message>
      <source>Shows every group</source>
      <translation>Montre tous les groupes</translation>
    </message>
    <message>
      <source>Shows no group</source>
      <translation>Ne montre aucun groupe</translation>
    </message>
    <message>
      <source>Shows the selected groups alone</source>
      <translation>Ne montre que les groupes choisis</translation>
    </message>
    <message>
      <source>Tick what is to be seen; double-click a name to rename the group</source>
      <translation>Cochez ce qui doit être vu ; double-cliquez un nom pour renommer le groupe</translation>
    </message>
    <message>
      <source>What of a group is drawn: its members, or its virtual boundary</source>
      <translation>Ce qui est dessiné d'un groupe : ses membres ou son bord virtuel</translation>
    </message>
  </context>
  <context>
    <name>Hole</name>
    <message>
      <source>Depth</source>
      <translation>Profondeur</translation>
    </message>
    <message>
      <source>Hole</source>
      <translation>Trou</translation>
    </message>
    <message>
      <source>Through</source>
      <translation>Traversant</translation>
    </message>
    <message>
      <source>Through the whole part; else a blind hole with a flat bottom</source>
      <translation>À travers toute la pièce ; sinon un trou borgne à fond plat</translation>
    </message>
    <message>
      <source>Where the bottom of the hole is: from the point, along the axis</source>
      <translation>Où est le fond du trou : depuis le point, le long de l'axe</translation>
    </message>
  </context>
  <context>
    <name>Merging</name>
    <message>
      <source>Join groups of one name</source>
      <translation>Réunir les groupes de même nom</translation>
    </message>
    <message>
      <source>Merge</source>
      <translation>Fusion</translation>
    </message>
    <message>
      <source>Of groups of the addition whose name the mesh has for others; the name of the new groups when empty</source>
      <translation>Des groupes de l'ajout dont le maillage a déjà le nom pour d'autres ; vide : le nom des nouveaux groupes</translation>
    </message>
    <message>
      <source>Overlap</source>
      <translation>Recouvrement</translation>
    </message>
    <message>
      <source>Prefix</source>
      <translation>Préfixe</translation>
    </message>
    <message>
      <source>Tolerance</source>
      <translation>Tolérance</translation>
    </message>
    <message>
      <source>What is nearer than this to the other's surface touches it; 0: automatic</source>
      <translation>Ce qui est plus près de la surface de l'autre la touche ; 0 : automatique</translation>
    </message>
    <message>
      <source>Where two solids overlap: what the overlap is cut off</source>
      <translation>Là où deux solides se recouvrent : ce dont on ôte le recouvrement</translation>
    </message>
    <message>
      <source>Whether groups of one name and kind become one; otherwise those of the addition are renamed</source>
      <translation>Si les groupes de même nom et de même genre n'en font qu'un ; sinon ceux de l'ajout sont renommés</translation>
    </message>
  </context>
  <context>
    <name>MeshQuality</name>
    <message>
      <source>Click an element to zoom to it</source>
      <translation>Cliquez sur un élément pour zoomer dessus</translation>
    </message>
    <message>
      <source>Elements below this value are shown</source>
      <translation>Les éléments sous cette valeur sont montrés</translation>
    </message>
    <message>
      <source>Only below</source>
      <translation>Seulement sous</translation>
    </message>
    <message>
      <source>Quality</source>
      <translation>Qualité</translation>
    </message>
    <message>
      <source>Shows the elements below the value alone</source>
      <translation>Ne montre que les éléments sous la valeur</translation>
    </message>
    <message>
      <source>What is measured</source>
      <translation>Ce qui est mesuré</translation>
    </message>
    <message>
      <source>Worst elements</source>
      <translation>Plus mauvais éléments</translation>
    </message>
  </context>
  <context>
    <name>Options</name>
    <message>
      <source>Edge length</source>
      <translation>Longueur d'arête</translation>
    </message>
    <message>
      <source>Edges of the skin that are sharper than this keep their shape (feature angle)</source>
      <translation>Les arêtes de la peau plus vives que cet angle gardent leur forme (angle caractéristique)</translation>
    </message>
    <message>
      <source>Group borders</source>
      <translation>Bords de groupes</translation>
    </message>
    <message>
      <source>Group name</source>
      <translation>Nom du groupe</translation>
    </message>
    <message>
      <source>How many rings of elements around the tool may move (the paper: transition)</source>
      <translation>Combien d'anneaux d'éléments autour de l'outil peuvent bouger (dans l'article : transition)</translation>
    </message>
    <message>
      <source>Longest edge wanted there; farther away edges grow longer again</source>
      <translation>Plus longue arête voulue à cet endroit ; plus loin, les arêtes redeviennent plus longues</translation>
    </message>
    <message>
      <source>Method</source>
      <translation>Méthode</translation>
    </message>
    <message>
      <source>Options</source>
      <translation>Options</translation>
    </message>
    <message>
      <source>Prefix of the new mesh groups</source>
      <translation>Préfixe des nouveaux groupes</translation>
    </message>
    <message>
      <source>Put in place of its source in the analysis</source>
      <translation>Dans l'analyse à la place de la source</translation>
    </message>
    <message>
      <source>Refine first</source>
      <translation>Raffiner d'abord</translation>
    </message>
    <message>
      <source>Rings that may move</source>
      <translation>Anneaux mobiles</translation>
    </message>
    <message>
      <source>Sharp edges from</source>
      <translation>Arêtes vives dès</translation>
    </message>
    <message>
      <source>The analysis then solves the new mesh; loads, supports and materials stay as they are</source>
      <translation>L'analyse calcule alors le nouveau maillage ; charges, appuis et matériaux restent tels quels</translation>
    </message>
    <message>
      <source>The borders of the ticked groups keep their shape; those of the others may drift</source>
      <translation>Les bords des groupes cochés gardent leur forme ; ceux des autres peuvent dériver</translation>
    </message>
    <message>
      <source>Whether the borders of all groups keep their shape; where those of some may drift, elements can be better (the paper: virtual boundaries)</source>
      <translation>Si les bords de tous les groupes gardent leur forme ; là où certains peuvent dériver, les éléments peuvent être meilleurs (dans l'article : virtual boundaries)</translation>
    </message>
    <message>
      <source>automatic</source>
      <translation>automatique</translation>
    </message>
    <message>
      <source>snap: move nodes and split elements, always succeeds on a sound mesh; deform: only move nodes (the paper's way)</source>
      <translation>snap : déplacer des nœuds et diviser des éléments, réussit toujours sur un maillage sain ; deform : seulement déplacer des nœuds (comme dans l'article)</translation>
    </message>
  </context>
  <context>
    <name>Patch</name>
    <message>
      <source>About the normal: the ellipse's first axis, the half plane's direction, the polygon</source>
      <translation>Autour de la normale : le premier axe de l'ellipse, la direction du demi-plan, le polygone</translation>
    </message>
    <message>
      <source>Of the disk, about the point; of the ellipse, along its first axis</source>
      <translation>Du disque, autour du point ; de l'ellipse, selon son premier axe</translation>
    </message>
    <message>
      <source>Of the ellipse, along its second axis</source>
      <translation>De l'ellipse, selon son second axe</translation>
    </message>
    <message>
      <source>Part of the plane</source>
      <translation>Partie du plan</translation>
    </message>
    <message>
      <source>Radius</source>
      <translation>Rayon</translation>
    </message>
    <message>
      <source>Second radius</source>
      <translation>Second rayon</translation>
    </message>
    <message>
      <source>The part of the plane that cracks; its border inside the part is the crack front</source>
      <translation>La partie du plan qui se fissure ; son bord dans la pièce est le front de fissure</translation>
    </message>
    <message>
      <source>Turned by</source>
      <translation>Tourné de</translation>
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
      <translation>3 nœuds</translation>
    </message>
    <message>
      <source>A point of the plane: x</source>
      <translation>Un point du plan : x</translation>
    </message>
    <message>
      <source>A point of the plane: y</source>
      <translation>Un point du plan : y</translation>
    </message>
    <message>
      <source>A point of the plane: z</source>
      <translation>Un point du plan : z</translation>
    </message>
    <message>
      <source>Centre</source>
      <translation>Centre</translation>
    </message>
    <message>
      <source>Click a planar face, an edge, a datum plane or line, a sketch, or a face of the mesh</source>
      <translation>Cliquez sur une face plane, une arête, un plan ou une ligne de référence, une esquisse ou une face du maillage</translation>
    </message>
    <message>
      <source>Click three nodes of the mesh in the 3-D view: the plane goes through them</source>
      <translation>Cliquez sur trois nœuds du maillage dans la vue 3D : le plan passe par eux</translation>
    </message>
    <message>
      <source>Direction of the positive side: x</source>
      <translation>Direction du côté positif : x</translation>
    </message>
    <message>
      <source>Direction of the positive side: y</source>
      <translation>Direction du côté positif : y</translation>
    </message>
    <message>
      <source>Direction of the positive side: z</source>
      <translation>Direction du côté positif : z</translation>
    </message>
    <message>
      <source>Flip</source>
      <translation>Inverser</translation>
    </message>
    <message>
      <source>Geometry</source>
      <translation>Géométrie</translation>
    </message>
    <message>
      <source>Moves the point to the middle of the mesh</source>
      <translation>Place le point au milieu du maillage</translation>
    </message>
    <message>
      <source>Normal</source>
      <translation>Normale</translation>
    </message>
    <message>
      <source>Offset: moves the plane along its normal</source>
      <translation>Décalage : déplace le plan le long de sa normale</translation>
    </message>
    <message>
      <source>Plane</source>
      <translation>Plan</translation>
    </message>
    <message>
      <source>Point</source>
      <translation>Point</translation>
    </message>
    <message>
      <source>Swaps the positive and the negative side</source>
      <translation>Échange les côtés positif et négatif</translation>
    </message>
    <message>
      <source>The plane faces you: its normal is the view direction</source>
      <translation>Le plan vous fait face : sa normale est la direction de vue</translation>
    </message>
    <message>
      <source>View</source>
      <translation>Vue</translation>
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
      <translation>Taille d'arête</translation>
    </message>
    <message>
      <source>Growth</source>
      <translation>Croissance</translation>
    </message>
    <message>
      <source>How much longer edges may be per unit of distance beyond that</source>
      <translation>De combien les arêtes peuvent s'allonger par unité de distance au-delà</translation>
    </message>
    <message>
      <source>Longest edge wanted at the tool</source>
      <translation>Plus longue arête voulue près de l'outil</translation>
    </message>
    <message>
      <source>Reach</source>
      <translation>Portée</translation>
    </message>
    <message>
      <source>Refine</source>
      <translation>Raffiner</translation>
    </message>
    <message>
      <source>The edge size holds up to this distance from the tool</source>
      <translation>La taille d'arête vaut jusqu'à cette distance de l'outil</translation>
    </message>
  </context>
  <context>
    <name>Result</name>
    <message>
      <source>Click a group to light it up in the 3-D view</source>
      <translation>Cliquez sur un groupe pour le mettre en évidence dans la vue 3D</translation>
    </message>
    <message>
      <source>How much of the part is drawn</source>
      <translation>Ce qui est dessiné de la pièce</translation>
    </message>
    <message>
      <source>Moved nodes</source>
      <translation>Nœuds déplacés</translation>
    </message>
    <message>
      <source>Nodes that change place</source>
      <translation>Nœuds qui changent de place</translation>
    </message>
    <message>
      <source>Points at the worst element near the tool</source>
      <translation>Montre le plus mauvais élément près de l'outil</translation>
    </message>
    <message>
      <source>Preview</source>
      <translation>Aperçu</translation>
    </message>
    <message>
      <source>Report…</source>
      <translation>Rapport…</translation>
    </message>
    <message>
      <source>Shows what is done and what becomes of every group, to be copied and saved</source>
      <translation>Montre ce qui est fait et ce que devient chaque groupe, à copier ou à enregistrer</translation>
    </message>
    <message>
      <source>What the colours of the elements mean</source>
      <translation>Ce que signifient les couleurs des éléments</translation>
    </message>
    <message>
      <source>Worst</source>
      <translation>Le pire</translation>
    </message>
  </context>
  <context>
    <name>Rounding</name>
    <message>
      <source>Fillet</source>
      <translation>Congé</translation>
    </message>
    <message>
      <source>Of the ball that rolls along the edge</source>
      <translation>De la bille qui roule le long de l'arête</translation>
    </message>
    <message>
      <source>Radius</source>
      <translation>Rayon</translation>
    </message>
  </context>
  <context>
    <name>Slot</name>
    <message>
      <source>Between the two walls; the plane is in the middle</source>
      <translation>Entre les deux parois ; le plan est au milieu</translation>
    </message>
    <message>
      <source>Direction in the plane from the bottom, at the plane's point, to the mouth of the slot: turned about the normal</source>
      <translation>Direction dans le plan du fond, au point du plan, vers l'ouverture de la fente : tournée autour de la normale</translation>
    </message>
    <message>
      <source>How deep the slot is</source>
      <translation>La profondeur de la fente</translation>
    </message>
    <message>
      <source>Opens towards</source>
      <translation>S'ouvre vers</translation>
    </message>
    <message>
      <source>Slot</source>
      <translation>Fente</translation>
    </message>
    <message>
      <source>Width</source>
      <translation>Largeur</translation>
    </message>
  </context>
  <context>
    <name>ToolInput</name>
    <message>
      <source>Tool</source>
      <translation>Outil</translation>
    </message>
    <message>
      <source>What the tool is</source>
      <translation>Ce qu'est l'outil</translation>
    </message>
  </context>
  <context>
    <name>ToolValues</name>
    <message>
      <source>Between the axis of the cone and its side</source>
      <translation>Entre l'axe du cône et son côté</translation>
    </message>
    <message>
      <source>Clear</source>
      <translation>Effacer</translation>
    </message>
    <message>
      <source>Click a face of a part in the 3-D view; further ones of the same part that meet it smoothly are added</source>
      <translation>Cliquez sur une face d'une pièce dans la vue 3D ; d'autres de la même pièce, qui la joignent sans arête, s'ajoutent</translation>
    </message>
    <message>
      <source>Forgets what was picked</source>
      <translation>Oublie ce qui a été choisi</translation>
    </message>
    <message>
      <source>Half angle</source>
      <translation>Demi-angle</translation>
    </message>
    <message>
      <source>Pick</source>
      <translation>Choisir</translation>
    </message>
    <message>
      <source>Radius of the tube around the circle</source>
      <translation>Rayon du tube autour du cercle</translation>
    </message>
    <message>
      <source>Tool</source>
      <translation>Outil</translation>
    </message>
    <message>
      <source>Tube radius</source>
      <translation>Rayon du tube</translation>
    </message>
  </context>
  <context>
    <name>WallInput</name>
    <message>
      <source>Click a face of the mesh in the 3-D view: the smallest group it is in</source>
      <translation>Cliquez sur une face du maillage dans la vue 3D : le plus petit groupe où elle est</translation>
    </message>
    <message>
      <source>Move it</source>
      <translation>Déplacer</translation>
    </message>
    <message>
      <source>Onto a surface, by a vector, or scaled about a point</source>
      <translation>Sur une surface, d'un vecteur, ou à l'échelle autour d'un point</translation>
    </message>
    <message>
      <source>Pick</source>
      <translation>Choisir</translation>
    </message>
    <message>
      <source>Surface</source>
      <translation>Surface</translation>
    </message>
    <message>
      <source>The group of faces (of a shell: edges) or nodes that is moved</source>
      <translation>Le groupe de faces (d'une coque : d'arêtes) ou de nœuds qui est déplacé</translation>
    </message>
    <message>
      <source>Wall</source>
      <translation>Paroi</translation>
    </message>
    <message>
      <source>What it is moved onto; a plane has the axis as its normal</source>
      <translation>Ce sur quoi elle est mise ; un plan a l'axe pour normale</translation>
    </message>
  </context>
  <context>
    <name>WallMotion</name>
    <message>
      <source>Along x</source>
      <translation>Selon x</translation>
    </message>
    <message>
      <source>Along y</source>
      <translation>Selon y</translation>
    </message>
    <message>
      <source>Along z</source>
      <translation>Selon z</translation>
    </message>
    <message>
      <source>Factor</source>
      <translation>Facteur</translation>
    </message>
    <message>
      <source>Motion</source>
      <translation>Mouvement</translation>
    </message>
    <message>
      <source>Vector</source>
      <translation>Vecteur</translation>
    </message>
    <message>
      <source>What distances from the centre are multiplied by</source>
      <translation>Ce par quoi les distances au centre sont multipliées</translation>
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
