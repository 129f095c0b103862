"""STL, as text or binary, with the colours that VisCAM, SolidView and Materialise Magics keep in binary files."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import numpy as np

from ...base.checks import Floats, Ints
from ...base.values import plural
from ...errors import InputError, warn
from .._mesh import DEFAULT_COLOR, weld
from .content import plain_text, read_content, with_points
from .model import MeshPart

_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER, _COUNT = 80, 4

#: What stands before red, green, blue and alpha of the whole model in a header of Magics, and of its material.
_COLOR, _MATERIAL = b"COLOR=", b"MATERIAL="
_MATERIAL_SIZE = 12

#: Bytes at random make coordinates that are mostly beyond this, or no numbers.
_PLAUSIBLE = 1e15


def read_stl(path: Path) -> list[MeshPart]:
    """Return the mesh of an STL file, in light grey unless its facets have colours.

    An InputWarning tells of facets that are not finite, of a wrong count, and of what is not a facet.
    """
    data = read_content(path)
    text = data.rstrip(b"\0")
    if b"\0" in text:
        corners, colors = _binary(path, data)
    else:
        corners, colors = _text(path, plain_text(text)), None
    finite = np.isfinite(corners).all(axis=(1, 2))
    if not finite.any():
        raise InputError("it has no triangles" if not len(corners) else "none of its facets has finite coordinates")
    if not finite.all():
        warn(f"{path}: facets with coordinates that are not finite numbers are left out: {(~finite).sum()}")
    faces = np.arange(3 * int(finite.sum())).reshape(-1, 3)
    corner_colors = None if colors is None else colors[finite].repeat(3, axis=1)
    return [MeshPart(weld(corners[finite].reshape(-1, 3), faces, corner_colors))]


def _binary(path: Path, data: bytes) -> tuple[Floats, Floats | None]:
    """Return the corners of facets, (n, 3, 3), and their colours with alpha, (n, 1, 4), or None."""
    header, body = data[:_HEADER], data[_HEADER + _COUNT :]
    declared = int.from_bytes(data[_HEADER : _HEADER + _COUNT], "little")
    # many a writer leaves out the count, or the attribute of the last facet, which is rarely of use
    count = (len(body) + 2) // _FACET.itemsize
    if not count:
        raise InputError(f"it is not text, and with {len(data)} bytes too short for a triangle of a binary STL file")
    if 0 < declared < count and (len(body) - declared * _FACET.itemsize) % _FACET.itemsize:
        count = declared  # what follows is something else
    facets = np.frombuffer(body + b"\0\0", _FACET, count)
    with np.errstate(invalid="ignore"):  # of numbers that are none
        corners = facets["corners"].astype(np.float64)
    if declared != count:
        if (np.abs(corners) < _PLAUSIBLE).all(axis=(1, 2)).mean() < 0.5:
            raise InputError("it is neither text nor binary STL")
        warn(f"{path}: its header says {plural(declared, 'facet')}; there are {count:,}, which are read")
    behind = len(body) - count * _FACET.itemsize
    if behind > 0:
        warn(f"{path}: what is behind its facets is left out: {plural(behind, 'byte')}")
    return corners, _colors(path, header, facets["attribute"].astype(np.int64))


def _colors(path: Path, header: bytes, attributes: Ints) -> Floats | None:
    """Return the colours of facets, 0..255 with alpha, (n, 1, 4); None if there are none."""
    # five bits for each of red, green and blue; the highest one says in Magics that the facet has the colour of the
    # header, else that it has its own. Many programs write the colour of the header only, and 0 as all attributes
    own = attributes >= 1 << 15
    default = np.array([*DEFAULT_COLOR, 255])
    shifts = [10, 5, 0]
    _, is_magics, behind = header.partition(_COLOR)
    if is_magics and len(behind) >= 4:
        own = ~own & attributes.any()
        shifts.reverse()
        default = np.frombuffer(behind, np.uint8, 4).astype(np.int64)
        if default[3] in (0, ord(" ")):  # of writers without transparency
            default[3] = 255
        if behind.partition(_MATERIAL)[2][:_MATERIAL_SIZE].strip(b"\0"):
            warn(f"{path}: the material of its header is left out; of STL files only colours are read")
    elif unknown := int(np.count_nonzero(attributes[~own])):
        warn(f"{path}: attributes of facets that are no colours are left out: {unknown}")
    if not is_magics and not own.any():
        return None
    levels = np.rint((attributes[:, None] >> shifts & 31) * (255 / 31))
    colors = np.where(own[:, None], np.column_stack([levels, np.full(len(own), 255)]), default)
    return np.asarray(colors[:, None], dtype=np.float64)


def _text(path: Path, text: str) -> Floats:
    """Return the corners of the facets of all solids of a text, (n, 3, 3), which may be in one line."""
    # names may be of any words
    text = re.sub(r"(?im)^[ \t]*(end)?solid\b(?:(?!\bfacet[ \t]+normal\b).)*", "", text)
    text = with_points(path, text)
    facets, wrong = [], list[str]()
    for number, facet in enumerate(re.split(r"(?i)\bendfacet\b", text), 1):
        vertices = [words.split()[:3] for words in re.split(r"(?i)\bvertex\b", facet)[1:]]
        try:
            points = [(float(x), float(y), float(z)) for x, y, z in vertices]
            if 0 < len(points) < 3:
                wrong.append(f"facet {number} has {plural(len(points), 'vertex', 'vertices')}, not 3")
            # a fan if there are more
            facets += [(points[0], *pair) for pair in pairwise(points[1:])]
        except ValueError:
            wrong.append(f"facet {number} has a vertex that is not three numbers: {vertices}")
    if wrong and not facets:
        raise InputError(wrong[0])
    if wrong:
        warn(f"{path}: {plural(len(wrong), 'facet')} left out: {wrong[0]}")
    return np.array(facets, dtype=np.float64).reshape(-1, 3, 3)
