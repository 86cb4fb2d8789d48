# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random tools on meshes of quadrangles, hexahedra and prisms, and how they come out.

    PYTHONPATH=build/release/Mod/FemScalpel /usr/bin/python3 tests/python/mixed_cases.py --cases 300

Each kind: planes and spheres that crack, cylinders that drill, on a jittered grid or a bent one, in first or second
order. A result is checked: every face of a solid has one element on each side or is on the skin or a lip, volumes are
positive, the group of all elements keeps its measure where the mesh is flat and nothing is removed. Printed: how many
were refused, the smallest and usual quality, how many are poor (below 0.1), and the seeds that failed a check; with
--refused those that were refused, too.
"""

import numpy as np

import femscalpel as fs
from campaign import Tally, case_arguments
from mixed_meshes import grid, outer_area, prisms_of, second_order_of_all, worst_of

BENT = 0.15


def bent(points):
    """Bent to an arc about the axis y; lengths are kept where z = 0, and up to three times as long outside."""
    radius, angle = 1 / BENT + points[:, 2], BENT * points[:, 0]
    return np.stack([radius * np.sin(angle), points[:, 1], radius * np.cos(angle)], axis=1)


def cells_of(kind, rng):
    if kind == "quad":
        points, quads = grid(rng.integers(8, 20, 2), rng.uniform(0, 0.3))
        return points, {"quad": quads}
    counts = rng.integers(4, 13, 3)
    points, hexahedra = grid(counts, rng.uniform(0, 0.25))
    if kind == "hexahedron":
        return points, {"hexahedron": hexahedra}
    if kind == "wedge":
        return points, {"wedge": prisms_of(hexahedra)}
    half = counts[0] // 2 * counts[1] * counts[2]
    return points, {"hexahedron": hexahedra[:half], "wedge": prisms_of(hexahedra[half:])}


def make(kind, seed):
    """Mesh, tool, whether it drills, whether the mesh is flat."""
    rng = np.random.default_rng(seed)
    points, cells = cells_of(kind, rng)
    if rng.integers(2):
        points, cells = second_order_of_all(points, cells)
    flat = bool(rng.integers(3))
    low, high = points.min(axis=0), points.max(axis=0)
    at = low + (high - low) * rng.uniform(0.2, 0.8, 3)
    direction = rng.normal(size=3)
    if kind == "quad":
        direction[2] *= 0.2
    if not flat:
        points = bent(points)
        at = bent(at[None])[0]
    mesh = fs.Mesh(points, cells)
    mesh.add_group("ALL", "element", np.concatenate([mesh.cell_ids[k] for k in cells]))
    what = rng.integers(3)
    if what == 0:
        return mesh, fs.Plane(at, direction), False, flat
    if what == 1:
        return mesh, fs.Sphere(at, rng.uniform(1.2, 3)), False, flat
    return mesh, fs.Cylinder(at, (0.1, 0.2, 1) if kind == "quad" else direction, rng.uniform(0.7, 2)), True, flat


def check(mesh, result, drilled, flat):
    """What does not hold."""
    found = []
    sizes = {k: v.min() for k, v in fs.measure(result.mesh).items() if len(v)}
    if min(sizes.values()) <= 0:
        found.append("an element without volume")
    groups = {g.name: g for g in result.report.groups}
    whole = groups["ALL"]
    bent = result.report.straightened.count > 0  # which is told in a warning
    if flat and not (drilled or bent) and abs(whole.measure_after / whole.measure_before - 1) > 1e-9:
        found.append(f"measure {whole.measure_before} -> {whole.measure_after}")
    second = any(k in result.mesh.cells for k in ("tetra10", "hexahedron20", "wedge15"))
    if any(k.startswith(("tetra", "hexa", "wedge")) for k in result.mesh.cells):
        try:
            area = outer_area(result.mesh)
        except AssertionError as error:
            return found + [str(error)]
        if flat and not drilled and not second:
            lips = sum(groups[n].measure_after for n in ("T_P", "T_N"))
            if abs(area - lips - outer_area(mesh)) > 1e-6 * area:
                found.append(f"area {outer_area(mesh)} -> {area - lips}")
    return found


def name_of(error):
    if not isinstance(error, fs.ToolError):
        return type(error).__name__
    return "misses" if "miss" in str(error) or "outside" in str(error) else "tool"


def run(kind, cases, first, list_refused):
    tally, qualities = Tally(kind, list_refused, name_of), []
    for seed in range(first, first + cases):
        mesh, tool, drills, flat = make(kind, seed)
        result = tally.run(seed, lambda: (fs.drill if drills else fs.crack)(mesh, tool, name="T"))
        if result is None:
            continue
        if wrong := check(mesh, result, drills, flat):
            tally.failed[seed] = wrong
        qualities.append(min(result.report.quality.after.minimum, worst_of(result.mesh)))
        if qualities[-1] < 0.1:
            before = result.report.quality.before.minimum
            tally.tell(seed, f"quality {qualities[-1]:.3f}, {before:.3f} before")
    q = np.array(qualities or [np.nan])
    print(
        f"{kind:<11} {cases} cases, refused {dict(tally.refused)}, quality {q.min():.3f} / "
        f"{np.percentile(q, 10):.3f} / {np.median(q):.3f} (least, of 90 %, usual), poor {(q < 0.1).sum()}, "
        f"{tally.mean_seconds:.3f} s each"
    )
    return tally.is_sound()


def main():
    kinds = ("quad", "hexahedron", "wedge", "mixed")
    options = case_arguments(__doc__, kinds).parse_args()
    sound = [run(k, options.cases, options.seed, options.refused) for k in kinds if options.kind in (None, k)]
    raise SystemExit(0 if all(sound) else 1)


if __name__ == "__main__":
    main()
