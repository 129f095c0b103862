"""The materials of Wavefront OBJ files: MTL, as exporters write it rather than as it is specified."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from ...errors import InputError, warn
from .beside import read_beside
from .content import read_text, with_points
from .model import FileWrap

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?!\S)"
#: Options of a map and their values; they stand before the name of the image, or behind it.
_OPTION = re.compile(
    rf"(?<!\S)-(?:(s|o|t|mm)((?:\s+{_NUMBER}){{1,3}})|(clamp|blend[uv]|cc)\s+(on|off)"
    r"|(bm|boost|texres|imfchan|type)\s+(\S+))(?!\S)",
    re.IGNORECASE,
)
#: An option that is in no specification, before the name.
_OTHER_OPTION = re.compile(rf"-[A-Za-z_]+(?:\s+(?:on|off|{_NUMBER}))*\s+", re.IGNORECASE)
#: The values without effect of options that are not drawn. Of the others, any: there are neither mipmaps nor bumps.
_DEFAULTS = {"t": (0.0, 0.0, 0.0), "mm": (0.0, 1.0)}

#: Names of files, which may have spaces in them.
_FILES = re.compile(r'"[^"]*"|\S.*?\.mtl(?!\S)|\S.*', re.IGNORECASE)
#: A comment within a name begins where # stands alone: "Material #1" and "wood#2.png" are names.
_COMMENT = re.compile(r"(?:^|(?<=\s))#(?=\s|$).*")
#: Statements of numbers.
_OF_NUMBERS = r"K[ades]|N[is]|d|Tr|Tf"
#: The comment of the program that writes an opacity, not a transparency, as Tr.
_MESHLAB = re.compile(r"^#.*\bmeshlab\b", re.IGNORECASE | re.MULTILINE)


@dataclass(frozen=True)
class Map:
    """An image that a material names, "" for a white one. folders: where it may be. alpha: the image of its alpha."""

    name: str
    folders: tuple[Path, ...]
    wrap: FileWrap
    alpha: str | None = None


@dataclass
class ObjMaterial:
    """What a material file says of a material. Colours are 0..1.

    left_out: statements, and options of its image, that are not drawn. scale, offset: of texture coordinates.
    """

    color: Sequence[float] = (1.0, 1.0, 1.0)
    emission: Sequence[float] = (0.0, 0.0, 0.0)
    opacity: float = 1.0
    image: Map | None = None
    alpha: Map | None = None
    scale: Sequence[float] = (1.0, 1.0)
    offset: Sequence[float] = (0.0, 0.0)
    left_out: set[str] = field(default_factory=set)

    @property
    def texture(self) -> Map | None:
        """Its image, with its alpha."""
        if self.alpha is None:
            return self.image
        return replace(self.image or replace(self.alpha, name=""), alpha=self.alpha.name)


def name_of(line: str) -> str:
    """Return what follows the keyword of a line, without a comment."""
    return "".join(_COMMENT.sub("", line).split(maxsplit=1)[1:]).strip()


def material_name(line: str) -> str:
    """Return the material that a line names, without quotes, with single spaces."""
    return " ".join(unquoted(name_of(line)).split())


def unquoted(name: str) -> str:
    """Return a name without the quotes around it."""
    inner = name[1:-1]
    return inner if inner and name[0] == name[-1] and name[0] in "\"'" and name[0] not in inner else name


def read_materials(path: Path, line: str) -> dict[str, ObjMaterial]:
    """Return the materials of the files that a `mtllib` line names; an InputWarning tells of those that are not read.

    path: of the OBJ file, beside which they are.
    """
    materials: dict[str, ObjMaterial] = {}
    for name in _FILES.findall(name_of(line)):
        try:
            file, text = read_beside((path.parent,), unquoted(name), lambda each: (each, read_text(each)))
        except InputError as error:
            warn(f"{path}: its materials are left out: {error}")
        else:
            text = with_points(file, text, _OF_NUMBERS)
            materials.update(_parse(tuple(dict.fromkeys((file.parent, path.parent))), text))
    return materials


def _parse(folders: tuple[Path, ...], text: str) -> dict[str, ObjMaterial]:
    materials: dict[str, ObjMaterial] = {}
    material, given = ObjMaterial(), set[str]()
    opacities = ("d", "tr") if _MESHLAB.search(text) else ("d",)
    for line in text.split("\n"):
        keyword, *words = _COMMENT.sub("", line).split() or [""]
        key = keyword.lower()
        if key == "newmtl":
            material, given = ObjMaterial(), set()
            materials[material_name(line)] = material
        elif key in ("kd", "ke", "d", "tr"):
            values = []
            with suppress(ValueError):
                values = [float(word) for word in words[words[:1] == ["-halo"] :]]
            if len(values) not in (1, 3, 4) or not np.isfinite(values).all():
                material.left_out.add(keyword)
            elif key == "kd":
                material.color = (3 * values)[:3]  # one number is all of them
            elif key == "ke" and "map_ke" not in given:
                material.emission = (3 * values)[:3]
            elif key == "d" or (key == "tr" and "d" not in given):  # some exporters write the same number to both
                material.opacity = min(max(values[0] if key in opacities else 1 - values[0], 0.0), 1.0)
            given.add(key)
        elif key == "map_kd" or (key == "map_ka" and "map_kd" not in given):
            material.image, material.scale, material.offset = _map(material, folders, name_of(line))
            given.add(key)
        elif key == "map_d":
            material.alpha, *_ = _map(material, folders, name_of(line))
        elif key.startswith(("map_", "bump", "norm", "disp", "decal", "refl")) and key != "map_ka":
            material.left_out.add(keyword)
            if key == "map_ke":  # without it, all of the surface would emit light
                material.emission = (0.0, 0.0, 0.0)
                given.add(key)
    return materials


def _map(
    material: ObjMaterial, folders: tuple[Path, ...], text: str
) -> tuple[Map | None, Sequence[float], Sequence[float]]:
    """Return the image that a statement names, with the scale and the offset of texture coordinates."""
    wrap: FileWrap = "repeat"
    scale: Sequence[float] = (1.0, 1.0)
    offset: Sequence[float] = (0.0, 0.0)
    for several, numbers, switch, state, *_ in _OPTION.findall(text):
        option, values = (several or switch).lower(), tuple(map(float, numbers.split()))
        if option == "s":
            scale = (values[0], *values[1:2], 1.0)[:2]
        elif option == "o":
            offset = (values[0], *values[1:2], 0.0)[:2]
        elif option == "clamp" and state.lower() == "on":
            wrap = "clamp"
        elif option in _DEFAULTS and values != _DEFAULTS[option][: len(values)]:
            material.left_out.add(f"-{option}")
    name = _OPTION.sub(" ", text).strip()
    while other := _OTHER_OPTION.match(name):
        material.left_out.add(other[0].split()[0])
        name = name[other.end() :]
    return Map(unquoted(name), folders, wrap) if name else None, scale, offset
