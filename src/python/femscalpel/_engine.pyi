# SPDX-License-Identifier: LGPL-2.1-or-later
# Made by src/bindings/make_stub.py. The package femscalpel says what everything is for.
import os
from collections.abc import Sequence
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray


class CadShape:
    @overload
    def __init__(self, brep: bytes) -> None: ...
    @overload
    def __init__(self, path: str) -> None: ...
    @property
    def edge_count(self) -> int: ...
    @property
    def face_count(self) -> int: ...

class CancelToken:
    def __init__(self) -> None: ...
    def cancel(self) -> None: ...
    @property
    def cancelled(self) -> bool: ...
    def enter(self) -> None: ...
    def leave(self) -> None: ...

class Mesh:
    def __init__(
        self,
        points: ArrayLike,
        node_ids: ArrayLike,
        cells: Sequence[tuple[str, ArrayLike, ArrayLike]],
        groups: Sequence[tuple[str, str, ArrayLike]],
    ) -> None: ...
    def add_group(self, name: str, kind: str, ids: ArrayLike) -> None: ...
    @property
    def cell_count(self) -> int: ...
    @property
    def cell_ids(self) -> dict[str, NDArray[np.int64]]: ...
    @property
    def cells(self) -> dict[str, NDArray[np.int64]]: ...
    def copy(self) -> Mesh: ...
    @property
    def dimension(self) -> int: ...
    def group_ids(self, name: str, kind: str) -> NDArray[np.int64]: ...
    def groups(self) -> list[tuple[str, str]]: ...
    @property
    def has_solver_input(self) -> bool: ...
    def mean_ratios(self) -> dict[str, NDArray[np.float64]]: ...
    def measures(self) -> dict[str, NDArray[np.float64]]: ...
    @property
    def name(self) -> str: ...
    @name.setter
    def name(self, value: str) -> None: ...
    @property
    def node_count(self) -> int: ...
    @property
    def node_ids(self) -> NDArray[np.int64]: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    def remove_group(self, name: str, kind: str) -> None: ...
    def rename_group(self, old_name: str, new_name: str, kind: str) -> None: ...
    def set_group_ids(self, name: str, kind: str, ids: ArrayLike) -> None: ...
    @property
    def unit(self) -> str: ...
    @unit.setter
    def unit(self, value: str) -> None: ...
    def validate(self) -> None: ...

class Options:
    def __init__(self) -> None: ...
    @property
    def band_only(self) -> bool: ...
    @band_only.setter
    def band_only(self, value: bool) -> None: ...
    @property
    def feature_angle(self) -> float: ...
    @feature_angle.setter
    def feature_angle(self, value: float) -> None: ...
    @property
    def method(self) -> str: ...
    @method.setter
    def method(self, value: str) -> None: ...
    @property
    def name(self) -> str: ...
    @name.setter
    def name(self, value: str) -> None: ...
    @property
    def preserve(self) -> list[str] | None: ...
    @preserve.setter
    def preserve(self, value: list[str] | None) -> None: ...
    @property
    def refine(self) -> float | None: ...
    @refine.setter
    def refine(self, value: float | None) -> None: ...
    @property
    def skin(self) -> CadShape: ...
    @skin.setter
    def skin(self, value: CadShape) -> None: ...
    @property
    def strict(self) -> bool: ...
    @strict.setter
    def strict(self, value: bool) -> None: ...
    @property
    def transition(self) -> int | None: ...
    @transition.setter
    def transition(self, value: int | None) -> None: ...

class Scalpel:
    def __init__(self, mesh: Mesh) -> None: ...
    @property
    def mesh(self) -> Mesh: ...

class Tool:
    def distances(self, points: ArrayLike) -> NDArray[np.float64]: ...
    @property
    def feature_size(self) -> float: ...
    @property
    def kind(self) -> str: ...

class Within: ...

class Cone(Tool):
    def __init__(
        self,
        origin: Sequence[float],
        axis: Sequence[float],
        radius: float,
        half_angle: float,
    ) -> None: ...
    @property
    def apex(self) -> Sequence[float]: ...
    @property
    def half_angle(self) -> float: ...
    @property
    def origin(self) -> Sequence[float]: ...
    @property
    def radius(self) -> float: ...
    @property
    def unit_axis(self) -> Sequence[float]: ...

class Cylinder(Tool):
    def __init__(self, origin: Sequence[float], axis: Sequence[float], radius: float) -> None: ...
    @property
    def origin(self) -> Sequence[float]: ...
    @property
    def radius(self) -> float: ...
    @property
    def unit_axis(self) -> Sequence[float]: ...

class CylinderPart(Within):
    def __init__(self, low: float, high: float, angles: tuple[float, float, Sequence[float]] | None) -> None: ...

class Disk(Within):
    def __init__(self, center: Sequence[float], radius: float) -> None: ...

class Ellipse(Within):
    def __init__(
        self,
        center: Sequence[float],
        first: float,
        second: float,
        direction: Sequence[float],
    ) -> None: ...

class Face(Tool):
    @overload
    def __init__(self, brep: bytes) -> None: ...
    @overload
    def __init__(self, path: str) -> None: ...
    def beyond(self, points: ArrayLike) -> NDArray[np.float64]: ...
    @property
    def face_count(self) -> int: ...

class HalfPlane(Within):
    def __init__(self, origin: Sequence[float], direction: Sequence[float]) -> None: ...

class Plane(Tool):
    def __init__(self, origin: Sequence[float], normal: Sequence[float]) -> None: ...
    @property
    def origin(self) -> Sequence[float]: ...
    @property
    def unit_normal(self) -> Sequence[float]: ...

class Polygon(Within):
    def __init__(self, corners: Sequence[Sequence[float]]) -> None: ...

class Sphere(Tool):
    def __init__(self, center: Sequence[float], radius: float) -> None: ...
    @property
    def center(self) -> Sequence[float]: ...
    @property
    def radius(self) -> float: ...

class Torus(Tool):
    def __init__(
        self,
        center: Sequence[float],
        axis: Sequence[float],
        major_radius: float,
        minor_radius: float,
    ) -> None: ...
    @property
    def center(self) -> Sequence[float]: ...
    @property
    def major_radius(self) -> float: ...
    @property
    def minor_radius(self) -> float: ...
    @property
    def unit_axis(self) -> Sequence[float]: ...

class Error(RuntimeError):
    @property
    def parameter(self) -> str | None: ...

class Cancelled(Error): ...

class QualityError(Error): ...

class ReadError(Error): ...

class ToolError(Error): ...

class UnsupportedElementError(Error): ...

class WriteError(Error): ...

def cell_types() -> dict[str, tuple[int, int, int]]: ...

@overload
def crack(mesh: Mesh, tool: Tool, options: Options, within: Within | None) -> tuple[Mesh, dict[str, Any]]: ...
@overload
def crack(
    session: Scalpel,
    tool: Tool,
    options: Options,
    within: Within | None,
) -> tuple[Mesh, dict[str, Any]]: ...

@overload
def crack_along_faces(mesh: Mesh, faces: str, options: Options) -> tuple[Mesh, dict[str, Any]]: ...
@overload
def crack_along_faces(session: Scalpel, faces: str, options: Options) -> tuple[Mesh, dict[str, Any]]: ...

@overload
def cut(
    mesh: Mesh,
    positive: Tool,
    negative: Tool,
    options: Options,
    bottom: Tool | None,
) -> tuple[Mesh, dict[str, Any]]: ...
@overload
def cut(
    session: Scalpel,
    positive: Tool,
    negative: Tool,
    options: Options,
    bottom: Tool | None,
) -> tuple[Mesh, dict[str, Any]]: ...
@overload
def cut(
    mesh: Mesh,
    plane: Plane,
    width: float,
    options: Options,
    bottom: Tool | None,
) -> tuple[Mesh, dict[str, Any]]: ...
@overload
def cut(
    session: Scalpel,
    plane: Plane,
    width: float,
    options: Options,
    bottom: Tool | None,
) -> tuple[Mesh, dict[str, Any]]: ...

@overload
def drill(
    mesh: Mesh,
    tools: Sequence[Tool],
    options: Options,
    depth: float | None,
) -> tuple[Mesh, dict[str, Any]]: ...
@overload
def drill(
    session: Scalpel,
    tools: Sequence[Tool],
    options: Options,
    depth: float | None,
) -> tuple[Mesh, dict[str, Any]]: ...

def elementary_groups(mesh: Mesh) -> list[tuple[str, int, tuple[str, ...], NDArray[np.int64]]]: ...

@overload
def fillet(
    mesh: Mesh,
    group: str,
    nodes: Sequence[int],
    points: ArrayLike,
    radius: float,
    options: Options,
) -> tuple[Mesh, dict[str, Any]]: ...
@overload
def fillet(
    session: Scalpel,
    group: str,
    nodes: Sequence[int],
    points: ArrayLike,
    radius: float,
    options: Options,
) -> tuple[Mesh, dict[str, Any]]: ...

def formats() -> list: ...

@overload
def merge(
    mesh: Mesh,
    addition: Mesh,
    options: Options,
    keep_addition: bool,
    tolerance: float | None,
    prefix: str,
    join_groups: bool,
    keep_side: Sequence[float] | None,
    tie: bool,
) -> tuple[Mesh, dict[str, Any]]: ...
@overload
def merge(
    session: Scalpel,
    addition: Mesh,
    options: Options,
    keep_addition: bool,
    tolerance: float | None,
    prefix: str,
    join_groups: bool,
    keep_side: Sequence[float] | None,
    tie: bool,
) -> tuple[Mesh, dict[str, Any]]: ...

def read(path: str | os.PathLike[str]) -> Mesh: ...

def refine(
    mesh: Mesh,
    tools: Sequence[Tool],
    points: ArrayLike,
    size: float,
    gradation: float,
    reach: float,
    relax: bool,
    max_elements: int,
    feature_angle: float,
    strict: bool,
    skin: CadShape | None,
) -> tuple[Mesh, dict[str, Any]]: ...

@overload
def reshape(
    mesh: Mesh,
    group: str,
    onto: Tool,
    by: Sequence[float] | None,
    scale: tuple[float, Sequence[float]] | None,
    name: str,
    feature_angle: float,
    preserve: Sequence[str] | None,
    strict: bool,
) -> tuple[Mesh, dict[str, Any]]: ...
@overload
def reshape(
    session: Scalpel,
    group: str,
    onto: Tool,
    by: Sequence[float] | None,
    scale: tuple[float, Sequence[float]] | None,
    name: str,
    feature_angle: float,
    preserve: Sequence[str] | None,
    strict: bool,
) -> tuple[Mesh, dict[str, Any]]: ...

def virtual_boundaries(
    mesh: Mesh,
    groups: Sequence[tuple[str, str]],
) -> list[
    tuple[dict[str, NDArray[np.int64]], dict[str, NDArray[np.int64]], dict[str, NDArray[np.int64]], NDArray[np.int64]]
]: ...

def write(mesh: Mesh, path: str | os.PathLike[str]) -> None: ...
