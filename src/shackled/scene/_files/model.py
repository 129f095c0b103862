"""What a mesh file holds: meshes, each with what the file says of its material; and their textures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike
from PIL import Image

from ...base.checks import Color, Floats, Ints
from ...errors import warn
from .._crease import filled
from .._fields import Filter, Wrap
from .._mesh import DEFAULT_COLOR, Mesh, faces_of_all, weld
from .._texture import MAX_TEXTURE_SIDE, Texture, reduced, sample
from .images import FileImage, Images, is_plain

#: The warning for a mesh whose textures have more than one colour, if only the mesh is read.
TEXTURED = "its textures give their colours at the vertices only; what they show between them is lost"

#: What becomes of triangles with a texture that have colours of their own, too: these are often those of the same
#: surface, as in scans, of which the product would be dark.
REPLACED = "drawn in the colours of a texture, not in their own"

#: How an image goes on outside of 0..1 in files.
FileWrap = Literal["repeat", "clamp", "mirror"]


#: Texture coordinates beyond this are moved by whole images.
_FAR = 100
#: Coordinates that are outside of 0..1 by less are taken as rounded.
_ROUNDING = 1e-4
#: The same of texels.
_TEXEL_ROUNDING = 1e-3
#: An image is so large at most before it is mirrored.
_MIRRORED = 1 << 12
#: How many textures of the full size a file may have; a quarter of the texels allows four times as many.
_FULL_SIZE = 4


@dataclass(frozen=True)
class MeshPart:
    """A mesh of a file, and fields of a `Material` that the file gives, by their names, such as its texture.

    opacity: of the `Object`. two_sided: whether its faces are meant to look the same from behind.
    """

    mesh: Mesh
    material: dict[str, Any] = field(default_factory=dict)
    opacity: float = 1.0
    two_sided: bool = False


@dataclass(frozen=True, eq=False)
class Picture:
    """An image, RGB, or RGBA if its alpha counts, and how it is sampled. name: for messages, with the path."""

    image: FileImage
    name: str
    filter: Filter = "bilinear"
    wraps: tuple[FileWrap, FileWrap] = ("repeat", "repeat")
    cutoff: int = 0

    def is_plain(self, uvs: Floats) -> bool:
        """Return whether each triangle, (m, 3, 2), is within the image and shows one colour, as of a palette.

        False, too, for what is beyond the pixels that may be compared.
        """
        if self.image.has_alpha:
            return False
        # the texels that are seen: those between whose centres, or in which, the corners lie
        shift = 0.5 if self.filter == "bilinear" else 0.0
        low, high = (bound * self.image.size - shift for bound in (uvs.min(axis=1), uvs.max(axis=1)))
        low = np.floor(low + _TEXEL_ROUNDING).astype(np.int64)
        high = np.ceil(high - _TEXEL_ROUNDING).astype(np.int64)
        high = np.maximum(low, high if shift else high - 1)
        if (low < 0).any() or (high >= self.image.size).any():
            return False
        pixels = self.image.open()
        for left, top, right, bottom in np.unique(np.hstack([low, high + 1]), axis=0).tolist():
            compared = (right - left) * (bottom - top)
            if not self.image.images.compares(compared) or not is_plain(pixels.crop((left, top, right, bottom))):
                return False
        return True

    def texture(self, uvs: Floats, count: int) -> tuple[Texture, Floats]:
        """Return the texture of a file with so many, and where corners, (m, 3, 2), are on it; warn of what changes."""
        uvs, side = uvs.copy(), _side(count)
        outside = [bool((axis < -_ROUNDING).any() or (axis > 1 + _ROUNDING).any()) for axis in np.moveaxis(uvs, 2, 0)]
        wraps: list[Wrap] = []
        mirrored: Image.Image | None = None
        for axis, wrap in enumerate(self.wraps):
            if wrap == "mirror" and outside[axis]:
                pixels = np.asarray(reduced(mirrored or self.image.open(), _MIRRORED))
                mirrored = Image.fromarray(np.concatenate([pixels, np.flip(pixels, 1 - axis)], axis=1 - axis))
                uvs[:, :, axis] /= 2
            wraps.append("clamp" if wrap == "clamp" or (wrap == "mirror" and not outside[axis]) else "repeat")
        needed = {wrap for wrap, is_outside in zip(wraps, outside, strict=True) if is_outside} or set(wraps)
        if len(needed) > 1 and all(outside):
            warn(f"{self.name} repeats in one direction only; it is shown as repeating in both")
        wrap = needed.pop() if len(needed) == 1 else "repeat" if any(outside) else "clamp"
        if wrap == "repeat" and uvs.size and np.abs(uvs).max() > _FAR:
            uvs -= np.floor(uvs.min(axis=1, keepdims=True))
        smaller = self.image.reduced(side) if mirrored is None else reduced(mirrored, side)
        (width, height), (old_width, old_height) = smaller.size, (mirrored or self.image).size
        if smaller.size != (old_width, old_height):
            warn(f"{self.name} is reduced from {old_width} x {old_height} to {width} x {height} texels")
        return Texture.of_image(smaller, self.filter, wrap, self.cutoff), uvs


@dataclass(frozen=True)
class Look:
    """What the triangles of a part have in common."""

    picture: Picture | None = None
    emission: Color = (0, 0, 0)
    opacity: float = 1.0


def seen(parts: Sequence[MeshPart], name: str) -> list[MeshPart]:
    """Return the parts of a model, opaque if all of them are invisible, of which an InputWarning tells.

    Writers without transparency leave 0 as alpha, and of the statement Tr of OBJ files some mean the opposite.
    """
    if not parts or any(is_visible(part.mesh, part.opacity, part.material.get("texture")) for part in parts):
        return list(parts)
    warn(f"{name}: its opacity is 0 everywhere, which cannot be meant; it is drawn opaque")
    return [_opaque(part) for part in parts]


def is_visible(mesh: Mesh, opacity: float, texture: Texture | None) -> bool:
    """Return whether a mesh with an opacity and a texture is not transparent everywhere."""
    is_shown = texture is None or texture.alpha is None or bool((texture.alpha >= max(texture.cutoff, 1)).any())
    return opacity > 0 and is_shown and (mesh.opacities is None or bool(mesh.opacities.any()))


def _opaque(part: MeshPart) -> MeshPart:
    fields = dict(part.material)
    if (texture := fields.get("texture")) is not None:
        fields["texture"] = evolve(texture, alpha=None, cutoff=0)
    return replace(part, mesh=evolve(part.mesh, opacities=None), material=fields, opacity=1.0)


def split(
    positions: Floats,
    corners: Ints,
    colors: Floats,
    normals: Floats | None,
    uvs: Floats,
    look: Ints,
    looks: Sequence[Look],
) -> list[MeshPart]:
    """Return the triangles as meshes, one for each look that some of them have.

    corners: (m, 3), rows of `positions`. colors, normals, uvs: of corners. look: (m,), places in `looks`.
    """
    textures = len({each.picture for each in looks if each.picture is not None})
    parts = []
    for number in np.unique(look).tolist():
        own, each = np.flatnonzero(look == number), looks[number]
        fields: dict[str, Any] = {"emission": each.emission} if any(each.emission) else {}
        own_uvs = None
        if each.picture is not None:
            fields["texture"], own_uvs = each.picture.texture(uvs[own], textures)
        own_normals = None if normals is None else normals[own]
        mesh = weld(positions, corners[own], colors[own], own_normals, own_uvs)
        parts.append(MeshPart(mesh, fields, each.opacity))
    return parts


def under(picture: Picture, uvs: Floats, colors: Floats) -> tuple[Floats, bool]:
    """Return white for the corners of triangles, (m, 3, n), or their colours on a picture of which each shows only one;
    and whether they need the picture as a texture.
    """
    shown = np.array(colors, dtype=np.float64)
    shown[..., :3] = 255
    if picture.image.is_varied and not picture.is_plain(uvs):
        return shown, True
    return tinted(shown, picture, uvs), False


def replaced(colors: Floats) -> int:
    """Return how many triangles lose their own colours, (m, 3, n), to a texture; white and light grey are none."""
    plain = [(colors[..., :3] == each).all(axis=(1, 2)) for each in (255, DEFAULT_COLOR)]
    return int((~(plain[0] | plain[1])).sum())


def _side(count: int) -> int:
    side = MAX_TEXTURE_SIDE
    while count > _FULL_SIZE and side > 1:
        side, count = side // 2, (count + 3) // 4
    return side


def finite_uvs(uvs: ArrayLike, name: str) -> Floats:
    """Return texture coordinates, with 0 in place of what is not a finite number, of which an InputWarning tells."""
    found = np.asarray(uvs, dtype=np.float64)
    if np.isfinite(found).all():
        return found
    warn(f"{name} has texture coordinates that are not finite numbers; they are replaced by 0")
    return np.nan_to_num(found, nan=0.0, posinf=0.0, neginf=0.0)


def given_normals(normals: Floats | None, positions: Floats, corners: Ints, name: str) -> Floats | None:
    """Return normals of corners, (m, 3, 3), of those of vertices, (n, 3): computed where these are 0 or not finite."""
    if normals is None:
        return None
    bad = np.asarray(~np.isfinite(normals).all(axis=1))
    if bad.any():
        warn(f"{name}: normals that are not finite numbers are computed: {bad.sum():,}")
        normals = np.where(bad[:, None], 0.0, normals)
    return filled(positions, corners, normals[corners]) if normals.any() else None


def tinted(colors: Floats, picture: Picture, uvs: Floats) -> Floats:
    """Return colours, (..., 3), times those of an image at texture coordinates, (..., 2): 0..255. An alpha stays."""
    places = uvs.reshape(-1, 2)
    texels = sample(picture.image.open(), np.stack([places[:, 0], 1 - places[:, 1]], axis=1))
    product = np.array(colors, dtype=np.float64)
    product[..., :3] = np.rint(product[..., :3] * texels.reshape(*product.shape[:-1], 3) / 255)
    return product


def merged(parts: Sequence[MeshPart]) -> tuple[Mesh, bool]:
    """Return all meshes as one, with the colours of their textures at the vertices, and whether that loses anything."""
    textured = [part for part in parts if "texture" in part.material]
    if len(parts) == 1 and not textured and parts[0].opacity == 1:
        return parts[0].mesh, False
    faces = faces_of_all(part.mesh for part in parts)
    colors = np.concatenate([_vertex_colors(part) for part in parts])
    positions = np.concatenate([part.mesh.positions for part in parts])
    normals = [part.mesh.normals for part in parts if part.mesh.normals is not None]
    found = np.concatenate(normals)[faces] if len(normals) == len(parts) else None
    return weld(positions, faces, colors[faces], found), bool(textured)


def _vertex_colors(part: MeshPart) -> Floats:
    colors: Floats = np.rint(part.mesh.rgba * np.array([1, 1, 1, part.opacity]))
    texture: Texture | None = part.material.get("texture")
    if texture is None or part.mesh.uvs is None:
        return colors
    image = Image.fromarray(texture.pixels)
    return tinted(colors, Picture(Images().image("", lambda: image), ""), part.mesh.uvs)
