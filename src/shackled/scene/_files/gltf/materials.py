"""Materials and textures of a glTF document, as far as they are drawn."""

from __future__ import annotations

import io
import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from PIL import Image

from ....base.checks import Color, Floats
from ....errors import InputError, warn
from ..._fields import Filter
from ..._mesh import DEFAULT_COLOR
from ..._texture import as_rgb, cutoff_of, open_image, to_srgb, with_alpha
from ..model import FileWrap, Picture, finite_uvs
from ..table import Table
from .document import Document, Vertices

#: Filters and wraps of samplers, by their numbers in OpenGL.
_NEAREST = 9728
_FILE_WRAPS: dict[int, FileWrap] = {10497: "repeat", 33071: "clamp", 33648: "mirror"}


def _picture(gltf: Document, texture: Table, has_alpha: bool) -> Picture | None:
    """Return a texture; None, with a warning, if its image cannot be had. has_alpha: whether its alpha counts."""
    webp = texture.table("extensions").table("EXT_texture_webp")
    keys = webp if "source" in webp else texture
    place, key = keys.place("source"), f"{texture.where}, alpha {has_alpha}"
    if place not in gltf.lost and key not in gltf.pictures:
        sampler = gltf.item(texture, "sampler", "samplers") if "sampler" in texture else Table({}, "")
        filter: Filter = "nearest" if sampler.whole("magFilter", 0) == _NEAREST else "bilinear"
        u, v = (_FILE_WRAPS.get(sampler.whole(name, 0), "repeat") for name in ("wrapS", "wrapT"))
        try:
            source = gltf.item(keys, "source", "images")
            image = gltf.images.image((source.where, has_alpha), partial(_image, gltf, source, has_alpha))
            gltf.pictures[key] = Picture(image, f"{gltf.path}: {texture.where}", filter, (u, v))
        except InputError as error:
            gltf.lost.add(place)
            warn(f"{gltf.path}: a texture is left out: {error}")
    return gltf.pictures.get(key)


def _image(gltf: Document, source: Table, has_alpha: bool) -> Image.Image:
    data = gltf.view(gltf.item(source, "bufferView", "bufferViews")) if "bufferView" in source else None
    file = io.BytesIO(gltf.resource(source) if data is None else data)
    return open_image(file, source.where, with_alpha if has_alpha else as_rgb)


_GLOSSINESS = "KHR_materials_pbrSpecularGlossiness"


@dataclass(frozen=True)
class Surface:
    """A material.

    factor: linear red, green, blue and alpha. texture: where the base colour texture is told. gloss: roughness and
    metalness, 0..1; None if the file does not say. cutoff: alpha below it is not seen; None if it all is.
    """

    factor: tuple[float, ...] = (1.0, 1.0, 1.0, 1.0)
    texture: Table | None = None
    gloss: tuple[float, float] | None = None
    emission: Color = (0, 0, 0)
    is_unlit: bool = False
    is_blended: bool = False
    is_two_sided: bool = False
    cutoff: float | None = None

    @property
    def opacity(self) -> float:
        """That of an object: only what is blended has one."""
        return self.factor[3] if self.is_blended else 1.0

    @property
    def has_alpha(self) -> bool:
        """Whether the alpha of the texture counts."""
        return self.is_blended or (self.cutoff is not None and self.cutoff > 0)


#: That of primitives without a material.
PLAIN = Surface()


def surface_of(gltf: Document, primitive: Table) -> Surface:
    """Return the material of a primitive."""
    if "material" not in primitive:
        return PLAIN
    material = gltf.item(primitive, "material", "materials")
    extensions = material.table("extensions")
    gltf.uses(extensions.values)
    keys, factor, texture = material.table("pbrMetallicRoughness"), "baseColorFactor", "baseColorTexture"
    if _GLOSSINESS in extensions:
        keys, factor, texture = extensions.table(_GLOSSINESS), "diffuseFactor", "diffuseTexture"
    color = tuple(np.clip(keys.numbers(factor, (1, 1, 1, 1)), 0, 1).tolist())
    shown = keys.table(texture) if texture in keys else None
    strength = extensions.table("KHR_materials_emissive_strength").number("emissiveStrength", 1)
    emitted = np.clip(np.multiply(material.numbers("emissiveFactor", (0, 0, 0)), strength), 0, 1)
    is_unlit = "KHR_materials_unlit" in extensions
    if "emissiveTexture" in material and not is_unlit:
        if emitted.any() and not any(color[:3]):
            # all that is seen of a black surface is what it emits
            color, shown, is_unlit = (*emitted.tolist(), color[3]), material.table("emissiveTexture"), True
        elif emitted.any():
            gltf.leave_out("emissive texture", material.where)
        emitted = np.zeros(3)
    for key, name in (("normalTexture", "normal texture"), ("occlusionTexture", "occlusion texture")):
        if key in material:
            gltf.leave_out(name, material.where)
    if "metallicRoughnessTexture" in keys or "specularGlossinessTexture" in keys:
        gltf.leave_out("texture", material.where, "{} of roughness")
    mode = material.choice("alphaMode", ("OPAQUE", "MASK", "BLEND"), "OPAQUE")
    cutoff = material.number("alphaCutoff", 0.5) if mode == "MASK" else None
    gloss = None if is_unlit else _gloss(keys, _GLOSSINESS in extensions)
    red, green, blue = (0, 0, 0) if is_unlit else to_srgb(emitted).astype(int).tolist()
    two_sided = material.flag("doubleSided", False)
    return Surface(color, shown, gloss, (red, green, blue), is_unlit, mode == "BLEND", two_sided, cutoff)


def _gloss(keys: Table, is_older: bool) -> tuple[float, float] | None:
    """Return roughness and metalness, if they are told without a texture."""
    # a roughness that is left out, of 1 by the specification, is often not meant
    if is_older:
        return None if "specularGlossinessTexture" in keys else (1 - keys.number("glossinessFactor", 1), 0.0)
    if "roughnessFactor" not in keys or "metallicRoughnessTexture" in keys:
        return None
    return keys.number("roughnessFactor"), keys.number("metallicFactor", 1)


def colors_of(vertices: Vertices, surface: Surface, where: str) -> Floats:
    """Return colours of vertices with alpha, (n, 4), 0..255, without a texture's and the opacity of the material."""
    vertex_colors = vertices.values("COLOR_0", "VEC3", "VEC4")
    if surface is PLAIN and vertex_colors is None:
        return np.full((len(vertices.used), 4), (*DEFAULT_COLOR, 255), dtype=np.float64)
    linear = np.tile([*surface.factor[:3], 1.0], (len(vertices.used), 1))
    if vertex_colors is not None:
        most = np.iinfo(vertex_colors.dtype).max if vertex_colors.dtype.kind in "iu" else 1
        own = vertex_colors.astype(np.float64) / most
        bad = np.flatnonzero(~np.isfinite(own).all(axis=1))
        if len(bad):
            raise InputError(f"colour {bad[0]} must be finite numbers, not {own[bad[0]].tolist()}")
        linear[:, : own.shape[1]] *= np.clip(own, 0, 1)
    if surface.cutoff is not None and (linear[:, 3] * surface.factor[3] < surface.cutoff).any():
        vertices.gltf.leave_out("primitive", where, "the alpha of vertices of {}")
    alpha = np.rint(255 * linear[:, 3:]) if surface.is_blended else np.full((len(linear), 1), 255.0)
    return np.hstack([to_srgb(linear[:, :3]), alpha])


def picture_on(vertices: Vertices, surface: Surface, where: str) -> tuple[Picture | None, Floats]:
    """Return the image of the base colour texture, None if there is none, and where the vertices are on it, (n, 2)."""
    nowhere = np.zeros((len(vertices.used), 2))
    if surface.texture is None:
        return None, nowhere
    info = surface.texture
    transform = info.table("extensions").table("KHR_texture_transform")
    number = transform.whole("texCoord", info.whole("texCoord", 0))
    coordinates = vertices.values(f"TEXCOORD_{number}", "VEC2")
    picture = _picture(vertices.gltf, vertices.gltf.item(info, "index", "textures"), surface.has_alpha)
    if picture is not None and surface.cutoff is not None and surface.has_alpha:
        # of the texture times the factor
        picture = replace(picture, cutoff=cutoff_of(surface.cutoff / max(surface.factor[3], 1e-9)))
    if coordinates is None:
        vertices.gltf.leave_out("primitive", where, "the texture of {} without coordinates")
    if picture is None or coordinates is None:
        return None, nowhere
    u, v = (coordinates * np.array(transform.numbers("scale", (1, 1)))).T
    angle, (right, down) = transform.number("rotation", 0), transform.numbers("offset", (0, 0))
    sine, cosine = math.sin(angle), math.cos(angle)
    u, v = right + cosine * u + sine * v, down - sine * u + cosine * v
    return picture, finite_uvs(np.stack([u, v], axis=1), picture.name)
