# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is known at a crack front: stress intensity, energy release."""

import csv
import os
from dataclasses import dataclass
from typing import List, Optional, Union

import numpy as np

from . import _arguments, _engine
from .mesh import Mesh, check_mesh
from .results import Displacements


@dataclass(frozen=True, eq=False)
class StressIntensity:
    """Stress intensity along the fronts of a crack, from :func:`stress_intensity`: arrays with a value for each node.

    K is in the unit of stress times the root of the mesh's unit, G in that of stress times the mesh's unit.
    """

    #: Numbers of the nodes, in order along each front.
    nodes: np.ndarray
    #: Which front each is of, from 0.
    front: np.ndarray
    #: Arc length from the front's first node.
    s: np.ndarray
    #: (n, 3)
    points: np.ndarray
    #: Opening, sliding and tearing.
    K1: np.ndarray
    K2: np.ndarray
    K3: np.ndarray
    #: Energy release rate, of all three.
    G: np.ndarray
    #: K1, K2, K3 once more in a domain of two thirds of the radius: (n, 3).
    inside: np.ndarray
    #: K1, K2, K3 by the displacements of the lips; NaN where they have too few nodes: (n, 3).
    by_lips: np.ndarray
    #: Of the domain of integration.
    radius: float
    #: Mean length of the edges of elements at the front.
    edge: float
    #: What to look at before trusting it.
    warnings: List[str]

    @property
    def domain_difference(self) -> float:
        """Largest difference between the two domains over all nodes and modes, over the largest K."""
        k = np.column_stack([self.K1, self.K2, self.K3])
        return float(np.abs(k - self.inside).max() / np.abs(k).max()) if k.any() else 0.0

    def to_text(self) -> str:
        """A table."""
        lines = [f"{'node':>10} {'s':>12} {'K1':>12} {'K2':>12} {'K3':>12} {'G':>12} {'K1 by lips':>12}"]
        for row in zip(self.nodes, self.s, self.K1, self.K2, self.K3, self.G, self.by_lips[:, 0]):
            lines.append(f"{row[0]:>10} " + " ".join(f"{value:>12.5g}" for value in row[1:]))
        lines.append(
            f"domain of radius {self.radius:.4g}, {self.radius / self.edge:.1f} element edges; "
            f"one of two thirds of it differs by {100 * self.domain_difference:.2g} % of the largest K"
        )
        return "\n".join([*lines, *(f"warning: {text}" for text in self.warnings)]) + "\n"

    def write_csv(self, path) -> None:
        """Writes all columns to a file. Raises WriteError when that is not possible."""
        columns = {
            "front": self.front,
            "node": self.nodes,
            "s": self.s,
            **{name: self.points[:, k] for k, name in enumerate("xyz")},
            "K1": self.K1,
            "K2": self.K2,
            "K3": self.K3,
            "G": self.G,
            **{f"K{k + 1} inside": self.inside[:, k] for k in range(3)},
            **{f"K{k + 1} by lips": self.by_lips[:, k] for k in range(3)},
        }
        try:
            with open(os.fspath(path), "w", newline="", encoding="utf-8") as file:
                writer = csv.writer(file)
                writer.writerow(columns)
                writer.writerows(zip(*(column.tolist() for column in columns.values())))
        except OSError as error:
            raise _engine.WriteError(f"{path}: {error.strerror or error}") from None


def stress_intensity(
    mesh: Mesh,
    displacements: Union[np.ndarray, Displacements],
    front: str = "CRACK_FRONT",
    *,
    young: float,
    poisson: float,
    plane_stress: bool = False,
    radius: Optional[float] = None,
) -> StressIntensity:
    """Stress intensity along the front of a crack, from the displacements that a solver has found.

    By the interaction integral over the elements around the front (Yau, Wang and Corten 1980), with the terms of curved
    fronts (Gosz and Moran 2002); beside it, by the displacements of the lips. K1 is positive where the crack opens.
    K2 is where the positive lip moves ahead, against the negative one, K3 where it moves along the front: ahead,
    the normal to the positive side and along make a right-handed frame.

    Parameters
    ----------
    mesh : Mesh
        With a crack that :func:`crack` has made, so that the front's group and those of its lips are there; of solids,
        or of shells in one plane. With elements of second order, five of them over a round crack's radius, K is within
        some 3 % of the largest K at every node, and within 1 % in the mean.
    displacements : array or Displacements
        (n, 3), in the order of the mesh's nodes; or from :func:`read_displacements`, by number. Mid-side nodes that
        a solver leaves out are not put in.
    front : str
        Name of the front's group.
    young, poisson : float
        Young's modulus and Poisson's ratio of the material around the front, which is isotropic.
    plane_stress : bool
        Of shells; plane strain when false. Solids have no use for it.
    radius : float, optional
        Of the domain around the front; three element edges when not given, less where the front bends or another
        surface is near.

    Returns
    -------
    StressIntensity

    Raises
    ------
    Error
        A group is missing, displacements are missing or no numbers, the radius is too large, the lips are not plane,
        or the mesh's deck has temperatures or a pressure on the lips, which the integral does not know.
    """
    mesh = check_mesh(mesh)
    values = _by_node(mesh, displacements)
    k = _engine.stress_intensity(
        mesh,
        values,
        _arguments.text(front, "front"),
        _arguments.real(young, "young"),
        _arguments.real(poisson, "poisson"),
        _arguments.flag(plane_stress, "plane_stress"),
        0.0 if radius is None else _arguments.real(radius, "radius"),
    )
    by_mode = k.pop("k")
    return StressIntensity(
        K1=by_mode[:, 0],
        K2=by_mode[:, 1],
        K3=by_mode[:, 2],
        inside=k.pop("k_inside"),
        by_lips=k.pop("k_lips"),
        **k,
    )


def _by_node(mesh, displacements):
    """(n, 3) in the order of the mesh's nodes."""
    if not isinstance(displacements, Displacements):
        values = np.asarray(displacements, float)
        if values.ndim != 2 or values.shape[1] != 3:
            raise _arguments.about(
                "displacements", ValueError(f"displacements must be of shape (n, 3), not {values.shape}")
            )
        return values
    order = np.argsort(displacements.nodes)
    at = np.searchsorted(displacements.nodes, mesh.node_ids, sorter=order)
    at = order[np.minimum(at, len(order) - 1)] if len(order) else np.zeros(mesh.node_count, int)
    missing = mesh.node_ids[displacements.nodes[at] != mesh.node_ids] if len(order) else mesh.node_ids
    if len(missing):
        raise _engine.Error(
            f"{len(missing)} nodes of the mesh have no displacement, the first is {missing[0]}: "
            "the result is of another mesh, or of a part of it"
        )
    return displacements.values[at]
