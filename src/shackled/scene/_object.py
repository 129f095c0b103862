"""Objects: meshes placed in the world, with their materials."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from attrs import evolve, field, frozen
from numpy.typing import ArrayLike

from ..base.checks import Color, Floats, choice, color, flag, instance, number, vector, whole
from ..base.synonyms import Given, with_synonyms
from ..base.values import Value, checked
from ..errors import InputError
from ._arithmetic import ORTHOGONAL, matrix_of, quaternion_of, rotate, rotation_of
from ._fields import Shading
from ._mesh import Mesh, is_trimesh
from ._table import USUAL, from_table
from ._texture import Texture


def _texture(value: Texture | None) -> Texture | None:
    if isinstance(value, str | os.PathLike):
        return Texture.open(value)
    return None if value is None else instance(value, "the texture of a material", Texture)


@with_synonyms()
@frozen(field_transformer=from_table)
class Material:
    """Coefficients of Blinn-Phong shading, each 0..4; the exponent `shininess` 1..128, a whole number.

    shading: "unlit" shows the vertex colours as they are, "flat" takes the normals of the faces, "smooth" those of the
        vertices.
    texture: multiplied with the colours of the vertices, or None; also the path of an image. The mesh needs `uvs`.
    emission: the colour of the light that the surface emits, added to what it reflects; black for none. Other objects
        are not lit by it.
    """

    shading: Shading = field(default=USUAL, converter=choice)
    ambient: float = field(default=USUAL, converter=number)
    diffuse: float = field(default=USUAL, converter=number)
    specular: float = field(default=USUAL, converter=number)
    shininess: int = field(default=USUAL, converter=whole)
    texture: Texture | None = field(default=None, converter=_texture)
    emission: Color = field(default=USUAL, converter=color)


def _mesh(value: Mesh) -> Mesh:
    if is_trimesh(value):
        return Mesh.from_trimesh(value)
    if isinstance(value, str | os.PathLike):
        raise InputError(f"the mesh of an object must be a shackled.Mesh: shackled.load({value!r:.60}) has objects")
    return instance(value, "the mesh of an object", Mesh)


def _material(value: Material) -> Material:
    return instance(value, "the material of an object", Material)


def _fade(value: ArrayLike | None, name: str = "the fade") -> tuple[float, float] | None:
    if value is None:
        return None
    first, second = vector(value, name, 2).tolist()
    if not 0 <= first < second:
        raise InputError(f"the distances of {name} must be 0 <= first < second, not {value!r:.60}")
    return first, second


def _of_words(given: Given) -> Given:
    """Return the fields of an object, whose mesh may be given a colour, and whose place a matrix."""
    if "transform" in given:
        given |= _place(given.pop("transform"))
    if "color" in given and "mesh" in given:
        given["mesh"] = evolve(_mesh(given["mesh"]), colors=given.pop("color"))
    return given


def _place(matrix: ArrayLike) -> Given:
    """Return position, rotation and scale of a (4, 4) matrix."""
    m = matrix_of(matrix, 4, "the matrix of an object")
    lengths = np.linalg.norm(m[:3, :3], axis=0)
    scale = float(lengths.max())
    if scale == 0 or (lengths < (1 - ORTHOGONAL) * scale).any() or (m[3] != (0, 0, 0, 1)).any():
        raise InputError("the matrix of an object must scale all axes alike, and have (0, 0, 0, 1) as its last row")
    return {"position": m[:3, 3], "rotation": quaternion_of(m[:3, :3] / scale), "scale": scale}


@with_synonyms("color", "transform", read=_of_words)
@frozen(field_transformer=from_table)
class Object(Value):
    """p = position + rotation(scale * v) for every vertex v of the mesh.

    mesh: also a trimesh.Trimesh. `color` gives it one colour; `transform`, a matrix as in `from_matrix`, its place.
    rotation: a quaternion (x, y, z, w) of any length but zero; the identity is (0, 0, 0, 1). Also given as three angles
        in degrees about x, then y, then z, or as a (3, 3) matrix.
    cull: whether faces that turn away from the viewer are left out. wireframe: draw the edges only, one pixel wide.
    opacity: 0..1. Objects below 1, and those whose mesh has opacities, are drawn after the others, blended in the order
        of the scene; the farthest should come first.
    fade: of a ground, which casts no shadow: the distances from its position, in world units, at which it begins to
        fade into what is behind it, and at which nothing is left of it; (0 <= first < second). None for other objects.
    two_sided: whether faces that turn away from the viewer, if they are not left out, are lit as from their front: with
        the opposite normals. Wires always have the light of the front.
    """

    mesh: Mesh = field(converter=_mesh)
    position: Floats = field(default=USUAL, converter=vector)
    rotation: Floats = field(default=USUAL, converter=rotation_of, metadata=checked("the rotation of an object"))
    scale: float = field(default=USUAL, converter=number)
    material: Material = field(factory=Material, converter=_material)
    cull: bool = field(default=USUAL, converter=flag)
    wireframe: bool = field(default=USUAL, converter=flag)
    opacity: float = field(default=USUAL, converter=number)
    fade: tuple[float, float] | None = field(default=None, converter=_fade)
    two_sided: bool = field(default=USUAL, converter=flag)

    def __attrs_post_init__(self) -> None:
        if self.material.texture is not None and self.mesh.uvs is None:
            raise InputError("a material with a texture needs a mesh with uvs, the texture coordinates of its vertices")

    @classmethod
    def from_matrix(cls, mesh: Mesh, matrix: ArrayLike, **fields: Any) -> Object:
        """Return a mesh placed by a (4, 4) matrix, p = matrix @ (v, 1), of a scale, a rotation and a translation.

        The other fields as keywords. InputError for a matrix that shears, mirrors, or scales the axes differently.
        """
        return cls(mesh, **_place(matrix), **fields)

    @property
    def is_opaque(self) -> bool:
        """Whether it hides all that is behind it: the contracts have opacities in steps of 2^-24."""
        texture = self.material.texture
        is_solid = texture is None or texture.alpha is None or texture.cutoff > 0
        return round(self.opacity * 2**24) == 2**24 and self.mesh.opacities is None and is_solid

    def world_positions(self) -> Floats:
        """Return the vertices of the mesh in the world, (n, 3)."""
        return self.position + rotate(self.rotation, self.scale * self.mesh.positions)
