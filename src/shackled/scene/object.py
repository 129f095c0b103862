"""A mesh with its place in the world."""

from __future__ import annotations

from dataclasses import dataclass, field

from numpy.typing import ArrayLike

from ..checks import instance, number, vector
from ..errors import InputError
from .material import Material
from .mesh import Mesh
from .value import Value


@dataclass(frozen=True, eq=False)
class Object(Value):
    """p = position + rotation(scale * v) for every vertex v of the mesh.

    rotation: a quaternion (x, y, z, w) of any length but zero; the identity is (0, 0, 0, 1).
    cull: whether faces that turn away from the viewer are left out. wireframe: draw the edges only, one pixel wide.
    opacity: what it hides of what is behind it, 0..1. Objects of less than 1 are drawn after the others, in the order
        of the scene, each over what is there; the farthest should come first.
    """

    mesh: Mesh
    position: ArrayLike = (0, 0, 0)
    rotation: ArrayLike = (0, 0, 0, 1)
    scale: float = 1.0
    material: Material = field(default_factory=Material)
    cull: bool = True
    wireframe: bool = False
    opacity: float = 1.0

    def __post_init__(self) -> None:
        instance(self.mesh, "the mesh of an object", Mesh)
        instance(self.material, "the material of an object", Material)
        object.__setattr__(self, "position", vector(self.position, "the position of an object"))
        object.__setattr__(self, "rotation", vector(self.rotation, "the rotation of an object", 4))
        if not self.rotation.any():  # type: ignore[union-attr]
            raise InputError("the rotation of an object must not be the zero quaternion; the identity is (0, 0, 0, 1)")
        object.__setattr__(self, "scale", number(self.scale, "the scale of an object", 0))
        object.__setattr__(self, "opacity", number(self.opacity, "the opacity of an object", 0, 1))
