# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the engine says, in the user's language: it composes its errors and warnings in English, with numbers, and calls
parameters as Python's functions do.

Those that users meet most are in a table of templates; the others stay as they are, which is better than a wrong one,
but for the names of parameters that the panels call otherwise.
"""

import functools
import re

from .translate import QT_TRANSLATE_NOOP, translate

#: What the engine says, with %1, %2, ... for what varies; the same number is the same text. "(s)" is an s or none.
TEMPLATES = (
    # Of cracks and all tools.
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 misses the mesh: the whole mesh lies on its %2 side, the nearest node at distance %3. Move the %1 or "
        "turn it",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 misses the mesh: it passes between parts of the mesh, through no element; the nearest nodes are at "
        "distance %2 on its negative side and %3 on its positive side. Move the %1 or turn it",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 misses the mesh: it passes only through segments (%2), which cannot be divided (springs, dashpots, "
        "gaps). Move the %1 or turn it",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 lies inside %2, between their nodes, and parts none of them: it is smaller than the elements there. "
        "Refine the mesh there first",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 only grazes the mesh: it passes through the curved sides of %2, but between none of their corners. "
        "Move the %1 into the material",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 only grazes the mesh: what it would cut off is thinner than the elements there. Move the %1 into the "
        "material",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 only touches the mesh, along edges or in single nodes: it passes through no element and along no face. "
        "Move the %1 into the material",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 only touches the mesh, on its outside: all elements there are on its %2 side, and there is nothing to "
        "part. Move the %1 into the material",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 meets the mesh only outside the part of it that is to cut. Move that part into the material",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 is smaller than the elements there, and parts none of them. Refine the mesh there first, or move the "
        "%1 into the material",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 lies on faces that are open already: the elements on its two sides have nodes of their own there (a "
        "contact, or an earlier crack), and there is nothing to part. Move the %1 into the material",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the crack along the %1 cannot open: all its nodes are on its front. Refine the mesh there first",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the mesh is too coarse for the crack: no element face fits in it. Refine the mesh near the crack front first, "
        "or make the crack larger",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the mesh is too coarse for the crack: its front would be cut short by up to %1. Refine the mesh near the "
        "crack front first, or make the crack larger",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the crack lies outside the part: there is no material within its front. Move it into the material",
    ),
    # Of holes and slots.
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 would remove the whole mesh: all of it lies inside. Make the tool smaller, or move it",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 removes nothing: what it would take off is thinner than the elements there. Refine the mesh there, or "
        "move the %1 into the material",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 removes nothing: it is smaller than the elements there, and none lies inside. Refine the mesh there "
        "first, or move the %1 into the material",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 removes nothing: it touches the mesh from outside, and no element lies inside. Move the %1 into the "
        "material",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the wall %1 (%2) lies beyond the part: what is removed reaches right through there",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "a slot of width %1 removes nothing: it is narrower than what the elements there can show. Make it wider, or "
        "refine the mesh there first",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the mesh is too coarse for the %1 of radius %2 near (%3): an element with edges of %4 would reach deep into "
        "it. Refine the mesh there first, to edges of at most %5, or move the tool: it may nearly touch a border or "
        "the skin there, and leave only a thin layer of material",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the mesh is too coarse for the %1 of radius %2 near (%3): an element with edges of %4 would reach deep into "
        "it. Refine the mesh there first, to edges of at most %5",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the mesh is coarse for the %1 of radius %2: the flat faces of the wall leave about %3 % of the hole standing. "
        "Refine the mesh there first, to edges of at most %4",
    ),
    # Of the mesh.
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "%1 element(s) would be flat or inverted (%2): the tool passes too close to a corner or crease there. Move it "
        "a little",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "%1 second-order element(s) would be folded (%2): the mesh is too coarse for its curvature there. Move the "
        "tool a little, or refine the mesh",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the mesh already has %1 flat or inverted element(s) near the tool (%2); repair the mesh first",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 meets a surface or group border at %2: elements in the wedge between them cannot be better than the "
        "wedge",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 runs along a feature line or border line at %2: elements between them cannot be better than that wedge",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the %1 runs within 0.15 edge lengths of a nearly parallel surface or group border at %2 node(s): the layer "
        "between them is that thin",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the tool is finer than the mesh, which was refined first, to edges of %1 near the tool: from %2 to %3 "
        "elements. refine=%4 makes fewer, refine=False none, but then a coarser wall or front",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the addition is finer than the mesh, which was refined first, to edges of %1 where they meet: from %2 to %3 "
        "elements",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the mesh is finer than the addition, which was refined first, to edges of %1 where they meet: from %2 to %3 "
        "elements",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the addition is so much finer than the mesh that this would be refined from %1 to %2 elements, with edges of "
        "%3 where they meet. Give refine=%4, a longer edge there, or False for none; or mesh the finer one coarser, or "
        "add it as a shell",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the mesh is so much finer than the addition that this would be refined from %1 to %2 elements, with edges of "
        "%3 where they meet. Give refine=%4, a longer edge there, or False for none; or mesh the finer one coarser, or "
        "add it as a shell",
    ),
    # Of names and numbers.
    QT_TRANSLATE_NOOP("FemScalpel", "name is empty; the new groups need one"),
    QT_TRANSLATE_NOOP("FemScalpel", "name '%1' is taken: the mesh already has a group '%2'; choose another"),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "name '%1' is too long: group '%2' would have %3 characters, at most %4 are allowed",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "name '%1' has a character other than letters, digits, '_', '-' and '.'; solvers would not accept its groups",
    ),
    QT_TRANSLATE_NOOP("FemScalpel", "radius is %1; it must be a positive length"),
    QT_TRANSLATE_NOOP("FemScalpel", "width is %1; it must be positive"),
    QT_TRANSLATE_NOOP("FemScalpel", "depth is %1; it must be positive"),
    QT_TRANSLATE_NOOP("FemScalpel", "%1: %2 is %3; it must be positive"),
    QT_TRANSLATE_NOOP("FemScalpel", "%1: %2 is the zero vector; give a direction"),
    QT_TRANSLATE_NOOP("FemScalpel", "size is %1; it must be a positive length"),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "size %1 would make more than %2 elements. Choose a larger size or gradation, or a larger max_elements",
    ),
    QT_TRANSLATE_NOOP("FemScalpel", "the mesh has no group '%1'"),
    # Of edges, walls and additions.
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "nodes of the two near (%1) cannot be made one: an element there would be flat. Refine both there first, or "
        "move the addition a little",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "a second-order element near (%1) would be folded where the two meet: they are too coarse there for how they "
        "are curved. Refine both there first, or move the addition a little",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the addition: along the seam its own curved skin is left by up to %1 (%2 edge(s)): the mesh is not flat "
        "there, or its elements have no room for curves. Refine both there first",
    ),
    QT_TRANSLATE_NOOP("FemScalpel", "the edge goes on beyond what was named, and is rounded as far as it goes"),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "along: no feature line of the skin is within an edge length of the point (%1): the nearest is near (%2). Name "
        "a point on the edge",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "along: edges meet at (%1), a convex and a concave one: these cannot be rounded at once. Round one after the "
        "other",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "radius: %1 is too large for a face beside the edge, which ends, or is not what it is at the edge, before the "
        "distance of %2 at which it would be touched. There is room for about %3, near (%4)",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the edge cannot be rounded near (%1): a border of groups, or another surface that is kept, runs through the "
        "material there, and does not cross the edge in one plane",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "along: group '%1' is no edge: no feature line of the skin (sharper than feature_angle) runs along it",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the wall cannot be moved so far: it would pass through the part, and leave it on another side near (%1). Move "
        "it less",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the addition does not meet the mesh: nowhere do their surfaces cross, and no border of the one is on the "
        "other. The mesh reaches from (%1) to (%2), the addition from (%3) to (%4). Move the addition, or give a "
        "larger tolerance",
    ),
    # Of document objects.
    QT_TRANSLATE_NOOP("FemScalpel", "'%1' has no mesh; mend what its error says first"),
    QT_TRANSLATE_NOOP("FemScalpel", "'%1' is in no analysis"),
    QT_TRANSLATE_NOOP("FemScalpel", "the results of '%1' are removed; solve again"),
    QT_TRANSLATE_NOOP("FemScalpel", "%1 was set, so it does not follow %2 any more"),
    QT_TRANSLATE_NOOP("FemScalpel", "%1 was set, so it is not that of %2 any more"),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "FreeCAD would not apply everything in '%1' to '%2': %3. Move the tool a little, or refine the mesh there",
    ),
    QT_TRANSLATE_NOOP("FemScalpel", "the mesh that '%1' is made from is in no analysis"),
    QT_TRANSLATE_NOOP("FemScalpel", "%1 is not set; choose the FEM mesh to work on"),
    QT_TRANSLATE_NOOP("FemScalpel", "%1 is not set; choose the FEM mesh to add"),
    QT_TRANSLATE_NOOP("FemScalpel", "%1 '%2' is not a FEM mesh"),
    QT_TRANSLATE_NOOP("FemScalpel", "%1 '%2' has an error; mend it first"),
    QT_TRANSLATE_NOOP("FemScalpel", "%1 '%2' has no mesh; make it first"),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the new group '%1' would be taken for the nodes of '%2'; choose another GroupName",
    ),
    QT_TRANSLATE_NOOP("FemScalpel", "Group is not set; choose the mesh group to crack along"),
    QT_TRANSLATE_NOOP("FemScalpel", "Group is not set; choose the mesh group to move"),
    QT_TRANSLATE_NOOP("FemScalpel", "neither Along nor AlongPoints says which edge is rounded; give one"),
    QT_TRANSLATE_NOOP("FemScalpel", "Along and AlongPoints both say which edge is rounded; give one of them"),
    QT_TRANSLATE_NOOP("FemScalpel", "Addition and Source are the same mesh; choose another mesh to add"),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "KeepToShape is set, but the mesh does not know the geometry it was made from (its property Part or Shape)",
    ),
    QT_TRANSLATE_NOOP("FemScalpel", "ToolFace is not set; choose the face of the geometry to cut with"),
    QT_TRANSLATE_NOOP("FemScalpel", "Direction, as its expressions say it, is zero; give it a length"),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "%1, which %2 follows, is not there any more; pick it again in the operation's panel, or set Follow to "
        "Numbers",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "%1, which %2 follows, may be another face, edge or vertex now: its part has others than before; pick it "
        "again in the operation's panel, or set Follow to Numbers",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "%1 has no radius any more; pick it again in the operation's panel, or set Follow to Numbers",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "%1: FreeCAD will not find these nodes by geometry, so that a load, support or material on it is incomplete",
    ),
    # Of files.
    QT_TRANSLATE_NOOP("FemScalpel", "not in FreeCAD's mesh, but kept with it for operations and export: %1"),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "the mesh is not the one that was imported any more: what the file held beside nodes, elements and groups (a "
        "deck's cards, fields, groups of element faces) is not written",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "%1 is not the mesh that was imported any more, as it was moved or changed: what its file held beside nodes, "
        "elements and groups (a deck's cards, as materials and sections; fields; groups of element faces) is left "
        "behind",
    ),
    QT_TRANSLATE_NOOP("FemScalpel", "%1 does not hold %2: files of this kind cannot"),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "%1: the text is not UTF-8, here for the first time; it is read as Windows-1252 (Latin-1). Look at names with "
        "letters beyond A to Z",
    ),
    QT_TRANSLATE_NOOP(
        "FemScalpel",
        "%1: names of groups are not UTF-8; they are read as Windows-1252 (Latin-1). Look at those with letters beyond "
        "A to Z",
    ),
    QT_TRANSLATE_NOOP("FemScalpel", "%1: this is text in UTF-16 or UTF-32, which is not read; save it as UTF-8"),
)

#: English for the panels, where one of them names parameters of Python's functions.
IN_PANELS = {
    template: template.replace(python, panel)
    for python, panel in (
        (
            "refine=%4 makes fewer, refine=False none, but",
            "“Refine first” to an edge length of %4 makes fewer, “never” none, but",
        ),
        (
            "Give refine=%4, a longer edge there, or False for none;",
            "Choose “Refine first” to an edge length of %4, or “never”;",
        ),
        ("(sharper than feature_angle)", "(sharper than “Sharp edges from”)"),
        ("Choose a larger size or gradation, or a larger max_elements", "Choose a larger one"),
        ("along: ", ""),
    )
    for template in TEMPLATES
    if python in template
}

#: Parameters in what is none of these: where a word is one, and (context of the translation, name) of its field.
PARAMETERS = (
    (r"\bfeature_angle\b", ("Options", "Sharp edges from")),
    (r"\btransition(?= is \d)|(?<=smaller )transition\b", ("Options", "Rings that may move")),
    (r"`preserve`|(?<=out of )preserve\b", ("Options", "Group borders")),
    (r"\brefine(?==)", ("Options", "Refine first")),
    (r"\bjoin_groups(?==)", ("Merging", "Join groups of one name")),
)

#: Words that vary in them.
WORDS = (
    QT_TRANSLATE_NOOP("FemScalpel", "plane"),
    QT_TRANSLATE_NOOP("FemScalpel", "cylinder"),
    QT_TRANSLATE_NOOP("FemScalpel", "sphere"),
    QT_TRANSLATE_NOOP("FemScalpel", "torus"),
    QT_TRANSLATE_NOOP("FemScalpel", "cone"),
    QT_TRANSLATE_NOOP("FemScalpel", "face"),
    QT_TRANSLATE_NOOP("FemScalpel", "disk"),
    QT_TRANSLATE_NOOP("FemScalpel", "ellipse"),
    QT_TRANSLATE_NOOP("FemScalpel", "positive"),
    QT_TRANSLATE_NOOP("FemScalpel", "negative"),
)


def in_language(text):
    """A message of the engine in the user's language, in which parameters are called as in the panels."""
    for template in TEMPLATES:
        found = _pattern(template).fullmatch(text)
        if found is None:
            continue
        out = translate("FemScalpel", template)
        if out == template:
            if template not in IN_PANELS:
                break
            out = IN_PANELS[template]
        for number, part in found.groupdict().items():
            part = translate("FemScalpel", part) if part in WORDS else part
            out = out.replace("%" + number[1:], part)
        return out
    return _with_fields(text)


def _with_fields(text):
    """A message in which parameters are called as in the panels."""

    for pattern, field in PARAMETERS:
        text = re.sub(pattern, f"“{translate(*field)}”", text)
    off = translate("FemScalpel", "off")
    return re.sub("^along: ", "", re.sub("”=(False)?", lambda found: "” " + (off if found[1] else ""), text))


@functools.lru_cache(maxsize=None)
def _pattern(template):
    """A regular expression for a template."""
    seen, out = set(), ""
    for part in re.split(r"(%\d)", template):
        if not re.fullmatch(r"%\d", part):
            out += re.escape(part).replace(re.escape("(s)"), "s?")
        elif part in seen:
            out += f"(?P=n{part[1:]})"
        else:
            seen.add(part)
            out += f"(?P<n{part[1:]}>.+?)"
    return re.compile(out, re.DOTALL)
