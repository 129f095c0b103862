"""Textures of a glTF document."""

from __future__ import annotations

import io

from PIL import Image

from ....errors import InputError, warn
from ..._texture import Filter, as_rgba, open_image
from ..model import FileWrap, Picture, is_transparent
from ..table import Table
from .document import Document

#: Filters and wraps of samplers, by their numbers in OpenGL.
_NEAREST = 9728
_FILE_WRAPS: dict[int, FileWrap] = {10497: "repeat", 33071: "clamp", 33648: "mirror"}


def picture_of(gltf: Document, texture: Table, has_alpha: bool = False) -> Picture | None:
    """Return the image of a texture with its sampler; None, with a warning, if it cannot be had.

    has_alpha: whether its alpha counts.
    """
    image = _image(gltf, texture)
    if image is None:
        return None
    if not has_alpha or not is_transparent(image):
        image = image.convert("RGB")
    sampler = gltf.item(texture, "sampler", "samplers") if "sampler" in texture else Table({}, "")
    filter: Filter = "nearest" if sampler.whole("magFilter", 0) == _NEAREST else "bilinear"
    u, v = (_FILE_WRAPS.get(sampler.whole(name, 0), "repeat") for name in ("wrapS", "wrapT"))
    return Picture(image, f"{gltf.path}: {texture.where}", filter, (u, v))


def _image(gltf: Document, texture: Table) -> Image.Image | None:
    webp = texture.table("extensions").table("EXT_texture_webp")
    keys = webp if "source" in webp else texture
    if keys.place("source") not in gltf.images:
        image = None
        try:
            source = gltf.item(keys, "source", "images")
            data = gltf.view(gltf.item(source, "bufferView", "bufferViews")) if "bufferView" in source else None
            file = io.BytesIO(gltf.resource(source) if data is None else data)
            image = open_image(file, source.where, as_rgba)
        except InputError as error:
            warn(f"{gltf.path}: a texture is left out: {error}")
        gltf.images[keys.place("source")] = image
    return gltf.images[keys.place("source")]
