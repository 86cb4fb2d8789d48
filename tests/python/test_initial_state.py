# SPDX-License-Identifier: LGPL-2.1-or-later
"""Initial stresses and temperatures of a deck after a crack, a hole and refinement."""

import re
import shutil
import subprocess

import numpy as np
import pytest

import femscalpel as fs

needs_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
CUBE = ((0, 1, 3, 7), (0, 1, 7, 5), (0, 5, 7, 4), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7))
EDGES = {
    4: ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
    6: ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    8: ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
}
#: Corners and integration points.
TYPES = {
    "C3D4": (4, 1), "C3D10": (4, 4), "C3D6": (6, 2), "C3D15": (6, 9), "C3D8": (8, 8), "C3D8R": (8, 1),
    "C3D20": (8, 27), "C3D20R": (8, 8),
}  # fmt: skip
SIZE = (5, 3, 3)


def bar(label):
    """Places {number: (x, y, z)} and elements {number: nodes} of a bar of 5 x 3 x 3 cubes, a little jittered."""
    corners, _ = TYPES[label]
    rng = np.random.default_rng(5)
    at = {key: n for n, key in enumerate(np.ndindex(*(np.array(SIZE) + 1)), 1)}
    inner = {key: all(0 < k < s for k, s in zip(key, SIZE)) for key in at}
    nodes = {n: np.round(np.array(key) + inner[key] * rng.uniform(-0.1, 0.1, 3), 6) for key, n in at.items()}
    elements = []
    for i, j, k in np.ndindex(*SIZE):
        c = [at[i + (q & 1), j + (q >> 1 & 1), k + (q >> 2)] for q in range(8)]
        if corners == 8:
            elements.append([c[q] for q in (0, 1, 3, 2, 4, 5, 7, 6)])
        elif corners == 6:
            elements += [[c[q] for q in (0, 1, 3, 4, 5, 7)], [c[q] for q in (0, 3, 2, 4, 7, 6)]]
        else:
            elements += [[c[q] for q in tetra] for tetra in CUBE]
    if label in ("C3D10", "C3D15", "C3D20", "C3D20R"):
        middles = {}
        for element in elements:
            for a, b in EDGES[corners]:
                pair = frozenset((element[a], element[b]))
                if pair not in middles:
                    middles[pair] = len(nodes) + 1
                    nodes[middles[pair]] = (nodes[element[a]] + nodes[element[b]]) / 2
                element.append(middles[pair])
    return nodes, dict(enumerate(elements, 1))


def deck(label, cards):
    nodes, elements = bar(label)
    text = "*NODE, NSET=NALL\n" + "".join(f"{n},{x:.9g},{y:.9g},{z:.9g}\n" for n, (x, y, z) in nodes.items())
    text += f"*ELEMENT, TYPE={label}, ELSET=EALL\n"
    for e, of in elements.items():
        line = ",".join(map(str, [e, *of]))
        text += ",\n".join(",".join(line.split(",")[k : k + 12]) for k in range(0, len(of) + 1, 12)) + "\n"
    return (
        text
        + cards
        + "*MATERIAL, NAME=M\n*ELASTIC\n1000.,0.3\n*SOLID SECTION, ELSET=EALL, MATERIAL=M\n*STEP\n*STATIC\n"
        "*BOUNDARY\nNALL, 1, 3\n*EL PRINT, ELSET=EALL\nCOORD\n*END STEP\n"
    )


def values_of(text, kind):
    """Of each line under *INITIAL CONDITIONS, its numbers."""
    lines = re.search(rf"\*INITIAL ?CONDITIONS, ?TYPE={kind}\n((?:[^*\n][^\n]*\n)*)", text)[1].splitlines()
    return [[float(x) for x in line.split(",") if x.strip()] for line in lines]


def points_in_ccx(folder, text):
    """Where CalculiX integrates: {(element, point): place}."""
    (folder / "job.inp").write_text(text)
    out = subprocess.run(["ccx", "-i", "job"], cwd=folder, capture_output=True, text=True, timeout=300).stdout
    assert "*ERROR" not in out, out[out.find("*ERROR") :][:300]
    rows = [line.split() for line in (folder / "job.dat").read_text().splitlines()]
    return {(int(r[0]), int(r[1])): np.array(r[2:], float) for r in rows if len(r) == 5 and r[0].isdigit()}


@needs_ccx
@pytest.mark.parametrize("change", ("crack", "drill"))
@pytest.mark.parametrize("label", TYPES)
def test_integration_points_have_what_the_nearest_of_their_element_had(tmp_path, label, change):
    _, points = TYPES[label]
    _, elements = bar(label)
    # The value says which element and point it is of.
    stresses = "*INITIAL CONDITIONS, TYPE=STRESS\n" + "".join(
        f"{e}, {p}, {e}., {p}., 0., 0., 0., 0.\n" for e in elements for p in range(1, points + 1)
    )
    (tmp_path / "in.inp").write_text(deck(label, stresses))
    mesh = fs.read(tmp_path / "in.inp")
    if change == "crack":
        result = fs.crack(mesh, fs.Plane((2.4, 0, 0), (1, 0.2, 0.1)), strict=True)
    else:
        result = fs.drill(mesh, fs.Cylinder((2.4, 1.5, 0), (0, 0.1, 1), 1.0))
    said = [w for w in result.report.warnings if "*INITIALCONDITIONS" in w]
    made = [w for w in said if "have the values of the nearest one" in w]
    assert bool(made) == (label != "C3D4") and all("was removed" in w for w in said if w not in made)
    fs.write(result.mesh, tmp_path / "out.inp")
    text = (tmp_path / "out.inp").read_text()
    had, has = points_in_ccx(tmp_path, deck(label, "")), points_in_ccx(tmp_path, text)
    given = {(int(e), int(p)): (int(of), int(at)) for e, p, of, at, *_ in values_of(text, "STRESS")}
    assert given.keys() == has.keys() and len(given) == len(values_of(text, "STRESS"))
    old = set(elements)
    assert set(e for e, _ in given) - old, "the crack made elements"
    far, behind = 0, []
    moved = {e for e in old if all(given.get((e, p)) == (e, p) for p in range(1, points + 1))}
    for (e, p), (of, at) in given.items():
        if e in moved:  # whole, with its points
            continue
        distance = {k: np.linalg.norm(had[of, k] - has[e, p]) for k in range(1, points + 1)}
        behind.append(distance[at] - min(distance.values()))
        far = max(far, distance[at])
        assert e not in elements or of == e
    nearest = np.mean(np.array(behind) < 1e-5)
    print(f"POINTS {label}: {len(behind)}, {100 * nearest:.0f} % nearest, others at most {max(behind):.2g} farther")
    # What is made tetrahedra first is divided and moves afterwards.
    if change == "crack":
        assert nearest == 1 if label in ("C3D4", "C3D10") else nearest > 0.7
    assert nearest > 0.3 and max(behind) < 1.0
    assert 0 < far < 1.3, "within the element"


def test_shells_whose_parts_are_of_another_type_have_no_values_and_it_is_said(tmp_path):
    nodes = "".join(f"{4 * j + i + 1}, {i}, {j}, 0\n" for j in range(4) for i in range(4))
    quads = "".join(f"{3 * j + i + 1}, {a}, {a + 1}, {a + 5}, {a + 4}\n"
                    for j in range(3) for i in range(3) for a in (4 * j + i + 1,))  # fmt: skip
    stress = "".join(f"{e}, {p}, 1., 0., 0., 0., 0., 0.\n" for e in range(1, 10) for p in range(1, 9))
    text = f"*NODE\n{nodes}*ELEMENT, TYPE=S4, ELSET=E\n{quads}*INITIAL CONDITIONS, TYPE=STRESS\n{stress}"
    (tmp_path / "in.inp").write_text(text)
    mesh = fs.read(tmp_path / "in.inp")
    plane = fs.Plane((0.5, 0, 0), (1, 0.1, 0))
    with pytest.raises(
        fs.Error, match=r"in.inp:\d+: \*INITIALCONDITIONS names element .* whose integration points are"
    ):
        fs.crack(mesh, plane, strict=True)
    result = fs.crack(mesh, plane)
    fs.write(result.mesh, tmp_path / "out.inp")
    numbered = {int(e) for e, *_ in values_of((tmp_path / "out.inp").read_text(), "STRESS")}
    assert numbered == set(result.mesh.cell_ids.get("quad", np.zeros(0)).tolist()) and len(numbered) < 9


@pytest.mark.parametrize("change", ("crack", "drill", "refine"))
@pytest.mark.parametrize("label", ("C3D4", "C3D10", "C3D8"))
def test_linear_temperatures_stay_linear_and_it_is_said_which_were_made(tmp_path, label, change):
    nodes, _ = bar(label)

    def field(x):
        return 20 + x @ (3.0, -2.0, 0.5)

    lines = "".join(f"{n}, {float(field(x))!r}\n" for n, x in ((n, np.round(x, 9)) for n, x in nodes.items()))
    text = deck(label, f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\n{lines}")
    (tmp_path / "in.inp").write_text(text)
    mesh = fs.read(tmp_path / "in.inp")
    if change == "crack":
        result = fs.crack(mesh, fs.Plane((2.4, 0, 0), (1, 0.2, 0.1)))
    elif change == "drill":
        result = fs.drill(mesh, fs.Cylinder((2.4, 1.5, 0), (0, 0.1, 1), 0.6))
    else:
        result = fs.refine(mesh, near=fs.Sphere((2.4, 1.5, 1.5), 0.7), size=0.5)
    fs.write(result.mesh, tmp_path / "out.inp")
    said = [w for w in result.report.warnings if re.search(r"in.inp:\d+: \*INITIALCONDITIONS, TYPE=TEMPERATURE: ", w)]
    assert said and all(re.search(r"\d+ new nodes?, the first is \d+, with values between those", w) for w in said)
    given = {int(n): value for n, value in values_of((tmp_path / "out.inp").read_text(), "TEMPERATURE")}
    places = dict(zip(result.mesh.node_ids.tolist(), result.mesh.points))
    assert given.keys() == places.keys()
    worst = max(abs(given[n] - field(x)) for n, x in places.items())
    print(f"TEMPERATURES {label} {change}: {len(given)} nodes, {len(given.keys() - nodes.keys())} new, off {worst:.2g}")
    assert worst < 1e-9
