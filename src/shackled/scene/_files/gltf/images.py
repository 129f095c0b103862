"""Textures of a glTF document."""

from __future__ import annotations

import io
import warnings

from PIL import Image

from ....errors import InputError, warn
from ..._texture import Filter, open_image
from ..model import FileWrap, Picture, is_transparent
from ..table import Table
from .document import Document

#: Filters and wraps of samplers, by their numbers in OpenGL.
_NEAREST = 9728
_FILE_WRAPS: dict[int, FileWrap] = {10497: "repeat", 33071: "clamp", 33648: "mirror"}


def picture_of(gltf: Document, texture: Table) -> Picture | None:
    """Return the image of a texture with its sampler; None, with a warning, if it cannot be had."""
    found = _image(gltf, texture)
    if found is None:
        return None
    sampler = gltf.item(texture, "sampler", "samplers") if "sampler" in texture else Table({}, "")
    filter: Filter = "nearest" if sampler.whole("magFilter", 0) == _NEAREST else "bilinear"
    u, v = (_FILE_WRAPS.get(sampler.whole(name, 0), "repeat") for name in ("wrapS", "wrapT"))
    return Picture(found[0], f"{gltf.path}: {texture.where}", filter, (u, v))


def has_alpha(gltf: Document, texture: Table) -> bool:
    """Return whether the image of a texture is transparent anywhere."""
    found = _image(gltf, texture)
    return found is not None and found[1]


def _image(gltf: Document, texture: Table) -> tuple[Image.Image, bool] | None:
    webp = texture.table("extensions").table("EXT_texture_webp")
    keys = webp if "source" in webp else texture
    if keys.place("source") not in gltf.images:
        image = None
        try:
            source = gltf.item(keys, "source", "images")
            data = gltf.view(gltf.item(source, "bufferView", "bufferViews")) if "bufferView" in source else None
            file = io.BytesIO(gltf.resource(source) if data is None else data)
            opened = open_image(file, source.where)
            with warnings.catch_warnings(action="ignore", category=Image.DecompressionBombWarning):
                whole = Image.open(file)
            with whole:
                image = opened, is_transparent(whole)
        except InputError as error:
            warn(f"{gltf.path}: a texture is left out: {error}")
        gltf.images[keys.place("source")] = image
    return gltf.images[keys.place("source")]
