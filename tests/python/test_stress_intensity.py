# SPDX-License-Identifier: LGPL-2.1-or-later
"""K from displacements: exact fields on the nodes, and cracks that CalculiX solves."""

import shutil
import subprocess

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic

YOUNG, POISSON = 210e3, 0.3
K = (10.0, 4.0, -3.0)
TIP = np.array((5.1, 5.03, 0))


def straight_crack(second_order):
    """A block of 10 x 10 x 4 with a crack from its left side, whose front is straight along z."""
    mesh = grid_box((20, 20, 8), (10.0, 10.0, 4.0))
    mesh = quadratic(mesh) if second_order else mesh
    return fs.crack(mesh, fs.Plane(TIP, (0, 1, 0)), within=fs.HalfPlane(TIP, (-1, 0, 0))).mesh


def asymptotic(mesh, k):
    """Williams's displacements of plane strain on the nodes, each lip's on its own."""
    x = mesh.points - TIP
    side = np.zeros(mesh.node_count)
    for kind, cells in mesh.cells.items():
        if kind.startswith("tetra"):
            above = np.sign(x[cells[:, :4]].mean(axis=1)[:, 1])
            for column in cells.T:
                np.add.at(side, column, above)
    y = np.where(abs(x[:, 1]) < 1e-9, np.copysign(1e-300, side), x[:, 1])
    r, theta = np.hypot(x[:, 0], x[:, 1]), np.arctan2(y, x[:, 0])
    mu, kappa = YOUNG / (2 * (1 + POISSON)), 3 - 4 * POISSON
    s, c, cosine, f = np.sin(theta / 2), np.cos(theta / 2), np.cos(theta), np.sqrt(r / (2 * np.pi)) / (2 * mu)
    return np.column_stack(
        [
            f * (k[0] * c * (kappa - cosine) + k[1] * s * (kappa + 2 + cosine)),
            f * (k[0] * s * (kappa - cosine) - k[1] * c * (kappa - 2 + cosine)),
            f * 4 * s * k[2],
        ]
    )


@pytest.mark.parametrize("second_order", [False, True])
def test_the_asymptotic_field(second_order):
    mesh = straight_crack(second_order)
    found = fs.stress_intensity(mesh, asymptotic(mesh, K), young=YOUNG, poisson=POISSON)
    # Its sides are not free of what K3 and K2 do there, so that the ends of the front say nothing.
    inner = (found.s > 1.1) & (found.s < found.s[-1] - 1.1)
    assert inner.sum() >= 3
    tolerance = 0.005 if second_order else 0.01
    for values, exact in zip((found.K1, found.K2, found.K3), K):
        assert abs(values[inner] - exact).max() < tolerance * K[0]
    assert abs(found.inside[inner] - K).max() < (0.025 if second_order else 0.05) * K[0]
    np.testing.assert_allclose(found.by_lips[inner], np.broadcast_to(K, (inner.sum(), 3)), atol=1e-6)
    plane = (1 - POISSON**2) / YOUNG
    g = plane * (found.K1**2 + found.K2**2) + (1 + POISSON) / YOUNG * found.K3**2
    np.testing.assert_allclose(found.G, g, rtol=1e-12)
    assert not found.warnings and "K1 by lips" in found.to_text()


def test_modes_are_apart_and_signed():
    mesh = straight_crack(True)
    for mode in range(3):
        for sign in (1, -1):
            k = np.zeros(3)
            k[mode] = sign
            found = fs.stress_intensity(mesh, asymptotic(mesh, k), young=YOUNG, poisson=POISSON)
            middle = len(found.s) // 2
            row = found.K1[middle], found.K2[middle], found.K3[middle]
            np.testing.assert_allclose(row, k, atol=0.01)
            if mode == 0:
                assert any("K1 is negative" in text for text in found.warnings) == (sign < 0)


def test_csv(tmp_path):
    mesh = straight_crack(False)
    found = fs.stress_intensity(mesh, asymptotic(mesh, K), young=YOUNG, poisson=POISSON)
    found.write_csv(tmp_path / "k.csv")
    table = np.genfromtxt(tmp_path / "k.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["node"], found.nodes)
    np.testing.assert_array_equal(table["K1"], found.K1)


def solved(mesh, displacements, folder):
    """Displacements that CalculiX finds with these on the mesh's outer nodes, all but the crack's."""
    lips = np.union1d(*(_nodes_of(mesh, name) for name in ("CRACK_P", "CRACK_N")))
    size = mesh.points.max(axis=0)
    outside = np.isclose(mesh.points, 0).any(axis=1) | np.isclose(mesh.points, size).any(axis=1)
    outside &= ~np.isin(mesh.node_ids, lips)
    solids = np.concatenate([ids for kind, ids in mesh.cell_ids.items() if kind.startswith("tetra")])
    with pytest.warns(UserWarning):
        fs.write(mesh, folder / "mesh.inp")
    lines = ["*INCLUDE,INPUT=mesh.inp", "*ELSET,ELSET=SOLIDS", *(f"{i}," for i in solids)]
    lines += ["*MATERIAL,NAME=STEEL", "*ELASTIC", f"{YOUNG},{POISSON}", "*SOLID SECTION,ELSET=SOLIDS,MATERIAL=STEEL"]
    lines += ["*STEP", "*STATIC", "*BOUNDARY"]
    for number, u in zip(mesh.node_ids[outside], displacements[outside]):
        lines += [f"{number},{k + 1},{k + 1},{u[k]:.11e}" for k in range(3)]
    (folder / "job.inp").write_text("\n".join([*lines, "*NODE FILE", "U", "*END STEP", ""]))
    done = subprocess.run(["ccx", "job"], cwd=folder, capture_output=True, text=True, timeout=900)
    assert "ERROR" not in done.stdout, done.stdout[-1000:]
    return fs.read_displacements(folder / "job.frd")


def _nodes_of(mesh, name):
    ids = mesh.groups[name].ids
    return np.unique(
        np.concatenate(
            [mesh.node_ids[mesh.cells[kind][np.isin(all_ids, ids)]].ravel() for kind, all_ids in mesh.cell_ids.items()]
        )
    )


@pytest.mark.skipif(not shutil.which("ccx"), reason="CalculiX is not installed")
@pytest.mark.parametrize("degrees, tolerance", [(0, 0.025), (30, 0.03)])
def test_penny(tmp_path, degrees, tolerance):
    """A round crack in a block under tension; Sneddon 1946, Kassir and Sih 1975. The block is ten radii wide."""
    tilt = np.radians(degrees)
    centre, normal = np.array((5.02, 4.97, 5.03)), np.array((0, np.sin(tilt), np.cos(tilt)))
    mesh = quadratic(grid_box((8, 8, 8), (10.0, 10.0, 10.0)))
    mesh = fs.crack(mesh, fs.Plane(centre, normal), within=fs.Disk(centre, 1), refine=0.2).mesh
    strain = 100 / YOUNG
    remote = (mesh.points - 5) * (-POISSON * strain, -POISSON * strain, strain)
    result = solved(mesh, remote, tmp_path)
    assert result.step == 1 and len(result.nodes) == mesh.node_count
    found = fs.stress_intensity(mesh, result, young=YOUNG, poisson=POISSON)
    opening, shear = 100 * np.cos(tilt) ** 2, 100 * np.sin(tilt) * np.cos(tilt)
    k1, k23 = 2 * opening / np.sqrt(np.pi), 4 * shear / (2 - POISSON) / np.sqrt(np.pi)
    out = (found.points - centre) @ np.cross(normal, (1, 0, 0))
    along = found.points[:, 0] - centre[0]
    assert len(found.nodes) > 40 and found.domain_difference < 0.02
    assert abs(found.K1 / k1 - 1).max() < tolerance
    assert abs(found.K1.mean() / k1 - 1) < 0.01
    # The upper lip moves along -out against the lower one.
    assert abs(abs(found.K2) - k23 * abs(out)).max() < tolerance * k1
    assert abs(abs(found.K3) - k23 * (1 - POISSON) * abs(along)).max() < tolerance * k1
    if degrees:
        assert abs(np.corrcoef(found.K2, out)[0, 1]) > 0.99 and abs(np.corrcoef(found.K3, along)[0, 1]) > 0.99


def test_what_does_not_fit_is_said(tmp_path):
    mesh = straight_crack(False)
    u = asymptotic(mesh, K)

    def message(*arguments, **more):
        with pytest.raises((fs.Error, ValueError)) as caught:
            fs.stress_intensity(*arguments, **{"young": YOUNG, "poisson": POISSON, **more})
        return caught.value.parameter, str(caught.value)

    assert message(mesh, u[:-1]) == ("displacements", message(mesh, u[:-1])[1])
    assert "NAME_FRONT" in message(mesh, u, "CRACK_P")[1]
    assert "no element group 'OTHER_FRONT'" in message(mesh, u, "OTHER_FRONT")[1]
    assert message(mesh, u, poisson=0.5)[0] == "poisson" and message(mesh, u, young=0)[0] == "young"
    parameter, text = message(mesh, u, radius=4.97)
    assert parameter == "radius" and "too large" in text and "another surface" in text
    u[7] = np.nan
    assert "node 8 is no number" in message(mesh, u)[1]
    part = fs.Displacements(mesh.node_ids[5:], u[5:], 1, 1.0)
    assert "5 nodes of the mesh have no displacement, the first is 1" in message(mesh, part)[1]


@pytest.mark.parametrize(
    "card, text",
    [
        ("*DLOAD\nCRACK_P, P, 3.\n", "a load on the lips"),
        ("*DLOAD\nALL_, GRAV, 9810., 0., 0., -1.\n", "forces in the volume"),
        ("*TEMPERATURE\n1, 300.\n", "thermal strain"),
    ],
)
def test_loads_that_the_integral_does_not_know_are_refused(tmp_path, card, text):
    mesh = straight_crack(False)
    u = asymptotic(mesh, K)
    with pytest.warns(UserWarning):
        fs.write(mesh, tmp_path / "mesh.inp")
    deck = (tmp_path / "mesh.inp").read_text()
    deck += "*MATERIAL, NAME=M\n*ELASTIC\n210000., 0.3\n*EXPANSION\n1.2e-5\n*STEP\n*STATIC\n" + card + "*END STEP\n"
    (tmp_path / "deck.inp").write_text(deck)
    read = fs.read(tmp_path / "deck.inp")
    with pytest.raises(fs.Error, match=text) as caught:
        fs.stress_intensity(read, u, young=YOUNG, poisson=POISSON)
    assert "deck.inp:" in str(caught.value)


def test_results_that_cannot_be_read(tmp_path):
    for content, text in (
        (b"", "no result of CalculiX"),
        (b"    1C\n    2C\n 9999\n", "has no results"),
    ):
        (tmp_path / "a.frd").write_bytes(content)
        with pytest.raises(fs.ReadError, match=text):
            fs.read_displacements(tmp_path / "a.frd")
    with pytest.raises(fs.ReadError, match="No such file"):
        fs.read_displacements(tmp_path / "none.frd")
