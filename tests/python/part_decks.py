# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random decks of parts and instances, and what is in them, worked out anew from the text."""

import math

import numpy as np


def hexahedra(rng, first, gap):
    """A few hexahedra: {number: place}, {number: nodes}."""
    shape = rng.integers(1, 3, 3)
    number, nodes, elements, n = {}, {}, {}, first
    for at in np.ndindex(*(shape + 1)):
        number[at], nodes[n] = n, np.round(np.array(at) + 0.1 * rng.random(3), 5)
        n += int(rng.integers(1, gap + 1))
    e = int(rng.choice([1, 1, first, 500]))
    for at in np.ndindex(*shape):
        square = ((0, 0), (1, 0), (1, 1), (0, 1))
        elements[e] = [number[at[0] + i, at[1] + j, at[2] + k] for k in (0, 1) for i, j in square]
        e += int(rng.integers(1, gap + 1))
    return nodes, elements


def card(rng, keyword, *parameters):
    """A keyword line as people write it."""
    spelled = rng.choice([keyword, keyword.upper(), keyword.lower(), "  " + keyword, keyword[0] + " " + keyword[1:]])
    return str(rng.choice([",", ", ", " , "])).join((str(spelled), *parameters)) + "\n"


def numbers(rng, ids):
    return ", ".join(str(i) for i in ids) + str(rng.choice(["", ","])) + "\n"


class RandomDeck:
    """`text` and `files` (name: text of what it includes), and by (instance, number), instance "" being the assembly:
    `nodes` (places), `elements` (numbers of nodes), `sets` ((kind, name): pairs). Names of sets of instances are pairs
    (instance, name)."""

    def __init__(self, seed):
        self.rng = np.random.default_rng(seed)
        self.files, self.nodes, self.elements, self.sets = {}, {}, {}, {}
        self.parts = [self.part(k) for k in range(self.rng.integers(1, 4))]
        self.text = "".join(part[-1] for part in self.parts) + card(self.rng, "*Assembly", "name=Assembly") + "**\n"
        self.instances = {}
        for k in range(self.rng.integers(1, 5)):
            self.add_instance(k)
        if self.rng.random() < 0.6:
            self.add_reference_point()
        for k in range(self.rng.integers(1, 7)):
            self.add_set(k)
        self.text += "*End Assembly\n"

    def chance(self, share):
        return self.rng.random() < share

    def pick(self, entries):
        return entries[int(self.rng.integers(len(entries)))]

    def part(self, k):
        rng = self.rng
        name = f'"Part {k}"' if self.chance(0.2) else f"{self.pick('ABC')}{k}"
        nodes, elements = hexahedra(rng, self.pick([1, 1, 1001]), self.pick([1, 1, 3]))
        sets = {}
        body = card(rng, "*Node", "nset=AllNodes") + "".join(
            f"{self.pick(['', '  '])}{n},{x!r}, {y!r} , {z!r}\n"
            for n, (x, y, z) in ((n, p.tolist()) for n, p in nodes.items())
        )
        sets["node", "ALLNODES"] = list(nodes)
        body += card(rng, "*Element", "type=C3D8", "elset = EALL")
        for e, of_element in elements.items():
            cut = self.pick([8, 4])
            lines = [of_element[i : i + cut] for i in range(0, 8, cut)]
            body += f"{e}, " + ",\n  ".join(", ".join(map(str, line)) for line in lines) + "\n"
        sets["element", "EALL"] = list(elements)
        for name_of_set in set(self.pick(["TOP", "Set-1", f"own{k}", '"my set"']) for _ in range(2)):
            ids = sorted(nodes)
            if self.chance(0.5):
                step = int(rng.integers(1, 4))
                body += card(rng, "*Nset", f"nset={name_of_set}", "generate") + f"{ids[0]}, {ids[-1]}, {step}\n"
                members = [n for n in ids if (n - ids[0]) % step == 0]
            else:
                members = [self.pick(ids) for _ in range(4)]
                body += card(rng, "*Nset", f"nset={name_of_set}") + numbers(rng, members)
            sets["node", name_of_set.replace('"', "").replace(" ", "").upper()] = members
        if self.chance(0.3):
            self.files[f"part{k}.inc"], body = body, f"*Include, input=part{k}.inc\n"
        end = self.pick(["*End Part", "*ENDPART", "*end part"])
        return name, nodes, elements, sets, card(rng, "*Part", f"name={name}") + f"** a comment\n{body}{end}\n**\n"

    def add_instance(self, k):
        part, nodes, elements, sets, _ = self.pick(self.parts)
        name = self.pick([f"I{k}", f"{part}-{k}".replace('"', ""), part.replace('"', "") + f".{k}"])
        shift, a, b, angle = np.zeros(3), np.zeros(3), np.array((0, 0, 1.0)), 0.0
        lines = ""
        if self.chance(0.7):
            shift = np.round(self.rng.uniform(-9, 9, 3), 3)
            lines += ", ".join(map(repr, shift.tolist())) + "\n"
            if self.chance(0.6):
                a, b = np.round(self.rng.uniform(-5, 5, (2, 3)), 3)
                angle = self.pick([90.0, 180.0, -90.0, 33.3, 120.0])
                lines += ", ".join(map(repr, (*a.tolist(), *b.tolist(), angle))) + "\n"
        quoted = f'"{name}"'
        self.text += card(self.rng, "*Instance", f"name={quoted}", f"part={part}") + lines + "*End Instance\n"
        axis = (b - a) / np.linalg.norm(b - a)
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        for n, x in nodes.items():
            x = x + shift - a
            self.nodes[name, n] = c * x + s * np.cross(axis, x) + (1 - c) * (x @ axis) * axis + a
        for e, of_element in elements.items():
            self.elements[name, e] = [(name, n) for n in of_element]
        for (kind, set_name), members in sets.items():
            self.sets[kind, (name, set_name)] = {(name, n) for n in members}
        self.instances[name] = (nodes, elements)

    def add_reference_point(self):
        n = self.pick([1, 2, 77777])
        self.text += f"*Node, nset=RP\n{n}, 1., 2., 3.\n*Nset, nset=RPset, internal\nRP,\n"
        self.nodes["", n] = np.array((1.0, 2, 3))
        self.sets["node", "RP"] = self.sets["node", "RPSET"] = {("", n)}

    def add_set(self, k):
        name = self.pick(list(self.instances))
        nodes, elements = self.instances[name]
        kind = self.pick(["nodes", "range", "number", "set"])
        set_name = self.pick(["TOP", "G", "Set-1"]) + ("" if kind in ("nodes", "range") else kind)
        key = ("element" if kind in ("range", "set") else "node", set_name.upper())
        if kind == "nodes":
            members = [self.pick(list(nodes)) for _ in range(3)]
            self.text += card(self.rng, "*Nset", f"nset={set_name}", f'instance="{name}"') + numbers(self.rng, members)
        elif kind == "range":
            members = list(elements)
            last = members[-1] + self.pick([0, 50])
            head = card(self.rng, "*Elset", f"elset={set_name}", "internal", f'instance="{name}"', "generate")
            self.text += head + f"{members[0]}, {last}, 1\n"
        elif kind == "number":
            members = [self.pick(list(nodes))]
            self.text += card(self.rng, "*Nset", f"nset={set_name}") + f'"{name}".{members[0]}\n'
        else:
            members = list(elements)
            self.text += card(self.rng, "*Elset", f"elset={set_name}") + f"{name}.eall,\n"
        self.sets[key] = self.sets.get(key, set()) | {(name, m) for m in members}
