# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random decks of parts are read as what they say."""

import numpy as np
import pytest
from part_decks import RandomDeck

import femscalpel as fs


def members(mesh):
    return {(g.name, g.kind): g.ids.tolist() for g in mesh.groups.all()}


@pytest.mark.parametrize("seed", range(80))
def test_random_decks_are_read_as_what_they_say(tmp_path, seed):
    deck = RandomDeck(seed)
    for name, text in deck.files.items():
        (tmp_path / name).write_text(text)
    (tmp_path / "in.inp").write_text(deck.text)
    mesh = fs.read(tmp_path / "in.inp")
    offset = {i.name: i.offset for i in mesh.instances}
    offset.setdefault("", 0)

    def flat(pairs):
        return sorted(n + offset[i] for i, n in pairs)

    assert sorted(mesh.node_ids.tolist()) == flat(deck.nodes), "no number is used twice"
    points = dict(zip(mesh.node_ids.tolist(), mesh.points))
    for (i, n), x in deck.nodes.items():
        np.testing.assert_allclose(points[n + offset[i]], x, atol=1e-13)
    cells = zip(mesh.cell_ids["hexahedron"].tolist(), mesh.cells["hexahedron"])
    assert {e: mesh.node_ids[c].tolist() for e, c in cells} == {
        e + offset[i]: [n + offset[j] for j, n in nodes] for (i, e), nodes in deck.elements.items()
    }
    groups = {(kind, name.replace(" ", "").upper()): ids for (name, kind), ids in members(mesh).items()}
    assert len(groups) == len(deck.sets)
    for (kind, name), wanted in deck.sets.items():
        if isinstance(name, tuple):
            instance, name = name
            long = (kind, f"{instance}_{name}".replace(" ", "").upper())
            got = groups[long if long in groups else (kind, name)]
        else:
            got = groups[kind, name]
        assert sorted(got) == flat(wanted), (kind, name)
    fs.write(mesh, tmp_path / "out.inp")
    back = fs.read(tmp_path / "out.inp")
    assert members(back) == members(mesh) and np.array_equal(back.points, mesh.points)
