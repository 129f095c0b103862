"""glTF 2.0, as text or binary (GLB).

An own reader: trimesh passes over sparse accessors, fans, normalized positions and what a file requires of its reader.
"""

from __future__ import annotations

import base64
import binascii
import io
import math
import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import unquote, unquote_to_bytes

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ...errors import InputError, warn
from .._crease import filled
from .._material import EXPONENTS
from .._mesh import DEFAULT_COLOR
from .._rotation import rotate
from .._texture import Filter, open_image
from .colors import to_srgb
from .content import parse, read_bytes
from .model import FileWrap, MeshPart, Picture, finite_uvs, tinted
from .table import Table, about
from .weld import weld

Array = NDArray[np.float64]

#: How many triangles are read, each mesh as often as it is shown, and how long an accessor without data may be.
MAX_TRIANGLES = 1 << 24

_COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_POINTS_OR_LINES, _TRIANGLES, _STRIP, _FAN = range(4), 4, 5, 6

_JSON, _BIN = b"JSON", b"BIN\0"

_COMPRESSIONS = ("KHR_draco_mesh_compression", "EXT_meshopt_compression")
#: What a file may require: done here, or without effect on shape and base colour.
_KNOWN = ("KHR_mesh_quantization", "KHR_texture_transform", "KHR_lights_punctual", "EXT_texture_webp")
_KNOWN_BEGINNING = "KHR_materials_"
_GLOSSINESS = "KHR_materials_pbrSpecularGlossiness"
_UNLIT = "KHR_materials_unlit"

#: The mode of materials through which one sees what is behind them.
_BLEND = "BLEND"

#: Roughness and metalness, 0..1, and whether light falls on it; None if the file does not say.
_Surface = tuple[float, float, bool] | None
#: The exponent of the widest highlights; even wider ones only fade the colours.
_WIDEST = 10

#: Filters and wraps of samplers, by their numbers in OpenGL.
_NEAREST = 9728
_FILE_WRAPS: dict[int, FileWrap] = {10497: "repeat", 33071: "clamp", 33648: "mirror"}

_IDENTITY = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True)
class _Piece:
    """A primitive with triangles.

    colors: (n, 4), with alpha. normals: zeros if there are none. picture, uvs: of its texture, or None. opacity: of its
    material.
    """

    positions: Array
    faces: NDArray[np.int64]
    colors: Array
    normals: Array
    surface: _Surface
    picture: Picture | None
    uvs: Array
    opacity: float

    @property
    def group(self) -> tuple[int, float, bool]:
        """What pieces of one mesh have in common: the texture, and how they hide what is behind them."""
        return id(self.picture) if self.picture else 0, self.opacity, bool((self.colors[:, 3] < 255).any())


@np.errstate(all="ignore")
def read_gltf(path: Path) -> list[MeshPart]:
    """Return the meshes of a glTF or GLB file: its scene, or else its first one, with all nodes in their places.

    There is one for each base colour texture, and one for all that has none. What is not opaque, of materials that are
    blended, is apart from what is. The colour of a vertex is the product of the base colour of its material and the
    colour of the vertex, as far as they are given; light grey if none is. Both are linear in the file, and encoded as
    sRGB here. Points and lines are left out, and textures that cannot be read, of which an InputWarning tells. What
    materials say of roughness becomes the mean of the triangles of a mesh.
    """
    gltf = _Gltf(path)
    groups: dict[tuple[int, float, bool], list[_Piece]] = {}
    triangles = 0
    for node, matrix in _nodes(gltf):
        for piece in _primitives(gltf, gltf.item(node, "mesh", "meshes")) if "mesh" in node else ():
            triangles += len(piece.faces)
            if triangles > MAX_TRIANGLES:
                raise InputError(f"it shows more than {MAX_TRIANGLES:,} triangles, the most that are read")
            groups.setdefault(piece.group, []).append(_place(piece, matrix))
    if not groups:
        raise InputError("it has no triangles")
    textures = {picture for picture, _, _ in groups} - {0}
    return [_join(pieces, len(textures)) for pieces in groups.values()]


class _Gltf:
    """A document, and what its parts refer to."""

    def __init__(self, path: Path) -> None:
        self.path = path
        data = read_bytes(path)
        self.binary: bytes | None = None
        if data.startswith(b"glTF"):
            text, self.binary = _chunks(data)
        else:
            text = data
        self.keys = Table(parse(path, text.decode("utf-8-sig", errors="replace"), ".json"), "")
        self.images: dict[str, Image.Image | None] = {}
        self.pictures: dict[str, Picture | None] = {}
        self.buffers: dict[str, bytes] = {}
        self._check()

    def _check(self) -> None:
        """Refuse what asks for another reader."""
        if "asset" not in self.keys:
            raise InputError("it is no glTF file: asset, with the version of glTF, is missing")
        asset = self.keys.table("asset")
        for key, most in (("version", "2."), ("minVersion", "2.0")):
            version = asset.get(key)
            if (key == "version" or version is not None) and not f"{version}".startswith(most):
                raise InputError(f"asset.{key} is {version!r:.20}; glTF 2.0 is read")
        required, used = ([name for _, name in self.keys.rows(key)] for key in ("extensionsRequired", "extensionsUsed"))
        for name in _COMPRESSIONS:
            if name in required or name in used:
                raise InputError(f"it is compressed with {name}, which is not read; export it without compression")
        for name in map(str, required):
            if name not in _KNOWN and not name.startswith(_KNOWN_BEGINNING):
                raise InputError(f"it requires the extension {name:.60}, which is not read; export it without")

    def item(self, keys: Table, key: str, kind: str) -> Table:
        """Return the part of the document that a key names by its number."""
        return self.numbered(keys.whole(key), kind, keys.place(key))

    def numbered(self, number: int, kind: str, place: str) -> Table:
        """Return the part of this kind and number, which stands at a place in the document."""
        items = self.keys.get(kind)
        count = len(items) if isinstance(items, list) else 0
        if number >= count:
            raise InputError(f"{place} is {number}, but there are {count} {kind}, numbered from 0")
        return Table(items[number], f"{kind}[{number}]")

    def numbers(self, keys: Table, key: str, *types: str) -> NDArray[Any]:
        """Return the elements of the accessor that a key names, (n, width); normalized integers as fractions."""
        accessor = self.item(keys, key, "accessors")
        width = _WIDTHS[accessor.choice("type", types)]
        count = accessor.whole("count")
        if "bufferView" in accessor:
            values = self._rows(accessor, self._component(accessor), count, width)
        elif count <= MAX_TRIANGLES:
            values = np.zeros((count, width), self._component(accessor))
        else:
            raise InputError(f"{accessor.where} has {count:,} elements but no data")
        if "sparse" in accessor:
            values = self._changed(values, accessor.table("sparse"), self._component(accessor))
        if values.dtype.kind in "iu" and accessor.flag("normalized", False):
            return np.maximum(values / np.iinfo(values.dtype).max, -1)
        return values

    def _changed(self, values: NDArray[Any], sparse: Table, component: str) -> NDArray[Any]:
        """Return the elements, some of them with other values."""
        count, indices = sparse.whole("count"), sparse.table("indices")
        rows = self._rows(indices, self._component(indices), count, 1)[:, 0]
        if count and not 0 <= rows.min() <= rows.max() < len(values):
            raise InputError(f"{sparse.where} changes element {rows.max()}, but there are {len(values)}")
        values = values.copy()
        values[rows.astype(np.int64)] = self._rows(sparse.table("values"), component, count, values.shape[1])
        return values

    def _component(self, keys: Table) -> str:
        kind = keys.whole("componentType")
        if kind not in _COMPONENTS:
            known = ", ".join(map(str, _COMPONENTS))
            raise InputError(f"{keys.place('componentType')} must be one of {known}, not {kind}")
        return _COMPONENTS[kind]

    def _rows(self, keys: Table, component: str, count: int, width: int) -> NDArray[Any]:
        view = self.item(keys, "bufferView", "bufferViews")
        data = self.view(view)
        size = np.dtype(component).itemsize
        start, stride = keys.whole("byteOffset", 0), view.whole("byteStride", 0) or size * width
        if stride < size * width:
            raise InputError(f"{view.place('byteStride')} is {stride}, less than an element of {size * width} bytes")
        needed = start + stride * (count - 1) + size * width if count else 0
        if needed > len(data):
            raise InputError(f"{keys.where} needs {needed:,} bytes of {view.where}, which has {len(data):,}")
        return np.ndarray((count, width), component, data, start, (stride, size))

    def view(self, view: Table) -> memoryview:
        """Return the bytes of a buffer view."""
        buffer = self.item(view, "buffer", "buffers")
        if buffer.where not in self.buffers:
            inside = self.binary if buffer.where == "buffers[0]" and "uri" not in buffer else None
            self.buffers[buffer.where] = self._resource(buffer) if inside is None else inside
        data = self.buffers[buffer.where]
        start, length = view.whole("byteOffset", 0), view.whole("byteLength")
        if start + length > len(data):
            raise InputError(f"{view.where} needs {start + length:,} bytes of {buffer.where}, which has {len(data):,}")
        return memoryview(data)[start : start + length]

    def _resource(self, keys: Table) -> bytes:
        """Return what the `uri` of a buffer or image holds."""
        uri, place = keys.get("uri"), keys.place("uri")
        if not isinstance(uri, str):
            raise InputError(f"{place} must name a file or hold data, not {uri!r:.60}")
        if uri.startswith("data:"):
            head, _, payload = uri.partition(",")
            try:
                return base64.b64decode(payload) if head.endswith(";base64") else unquote_to_bytes(payload)
            except binascii.Error:
                raise InputError(f"{place} does not hold valid base64") from None
        name = PurePosixPath(unquote(uri).replace("\\", "/"))
        if name.is_absolute() or ".." in name.parts or ":" in uri:
            raise InputError(f"{place} is {uri!r:.60}; only files in the folder of the glTF file are read")
        with about(place):
            return read_bytes(self.path.parent.joinpath(*name.parts))

    def picture(self, texture: Table) -> Picture | None:
        """Return the image of a texture with its sampler; None, with a warning, if it cannot be had."""
        key = texture.where
        if key not in self.pictures:
            image = self.image(texture)
            sampler = self.item(texture, "sampler", "samplers") if "sampler" in texture else Table({}, "")
            filter: Filter = "nearest" if sampler.whole("magFilter", 0) == _NEAREST else "bilinear"
            u, v = (_FILE_WRAPS.get(sampler.whole(name, 0), "repeat") for name in ("wrapS", "wrapT"))
            name = f"{self.path}: {texture.where}"
            self.pictures[key] = None if image is None else Picture(image, name, filter, (u, v))
        return self.pictures[key]

    def image(self, texture: Table) -> Image.Image | None:
        """Return the image of a texture; None, with a warning, if it cannot be had."""
        webp = texture.table("extensions").table("EXT_texture_webp")
        keys = webp if "source" in webp else texture
        if keys.place("source") not in self.images:
            image = None
            try:
                source = self.item(keys, "source", "images")
                data = self.view(self.item(source, "bufferView", "bufferViews")) if "bufferView" in source else None
                image = open_image(io.BytesIO(self._resource(source) if data is None else data), source.where)
            except InputError as error:
                warn(f"{self.path}: a texture is left out: {error}")
            self.images[keys.place("source")] = image
        return self.images[keys.place("source")]


def _chunks(data: bytes) -> tuple[bytes, bytes | None]:
    """Return the JSON and the binary chunk of a GLB file."""
    if len(data) < 12:
        raise InputError("it ends within its header")
    version, length = struct.unpack("<II", data[4:12])
    if version != 2:
        raise InputError(f"it is of version {version} of GLB; version 2 is read")
    if length > len(data):
        raise InputError(f"it ends after {len(data):,} of its {length:,} bytes")
    found: dict[bytes, bytes] = {}
    at = 12
    while at + 8 <= length:
        size, kind = struct.unpack("<I4s", data[at : at + 8])
        if at + 8 + size > length:
            raise InputError(f"its chunk at byte {at:,} reaches beyond the end of the file")
        found.setdefault(kind, data[at + 8 : at + 8 + size])
        at += 8 + size
    if _JSON not in found:
        raise InputError("it has no JSON chunk")
    return found[_JSON], found.get(_BIN)


def _nodes(gltf: _Gltf) -> Iterator[tuple[Table, Array]]:
    """Return the nodes of the scene, each with the matrix that puts it into its place."""
    nodes = [Table(value, where) for where, value in gltf.keys.rows("nodes")]
    children = [_links(node, "children", len(nodes)) for node in nodes]
    if "scene" in gltf.keys or gltf.keys.rows("scenes"):
        scene = gltf.numbered(gltf.keys.whole("scene", 0), "scenes", "scene")
        roots = _links(scene, "nodes", len(nodes))
    else:
        roots = sorted(set(range(len(nodes))).difference(*children))
    waiting = [(number, np.eye(4)) for number in reversed(roots)]
    seen: set[int] = set()
    while waiting:
        number, above = waiting.pop()
        node = nodes[number]
        if number in seen:
            raise InputError(f"{node.where} hangs on several nodes, or on itself, which glTF does not allow")
        seen.add(number)
        matrix = above @ _matrix(node)
        yield node, matrix
        waiting += [(child, matrix) for child in reversed(children[number])]


def _links(keys: Table, key: str, count: int) -> list[int]:
    """Return the numbers of nodes."""
    for place, number in keys.rows(key):
        if type(number) is not int or not 0 <= number < count:
            raise InputError(f"{place} is {number!r:.20}, but there are {count} nodes, numbered from 0")
    return [int(number) for number in keys.get(key) or []]


def _matrix(node: Table) -> Array:
    """Return the matrix of a node, (4, 4), for columns."""
    if "matrix" in node:
        return np.array(node.numbers("matrix", _IDENTITY)).reshape(4, 4).T
    matrix = np.eye(4)
    with about(node.where):
        turned = rotate(node.numbers("rotation", (0, 0, 0, 1)), np.eye(3)).T
    matrix[:3, :3] = turned * node.numbers("scale", (1, 1, 1))
    matrix[:3, 3] = node.numbers("translation", (0, 0, 0))
    return matrix


def _primitives(gltf: _Gltf, mesh: Table) -> Iterator[_Piece]:
    """Return the primitives of a mesh that have triangles."""
    for where, value in mesh.rows("primitives"):
        keys = Table(value, where)
        attributes = keys.table("attributes")
        mode = keys.whole("mode", _TRIANGLES)
        if mode in _POINTS_OR_LINES or "POSITION" not in attributes:
            continue
        positions = gltf.numbers(attributes, "POSITION", "VEC3")
        order = np.arange(len(positions))
        if "indices" in keys:
            order = gltf.numbers(keys, "indices", "SCALAR")[:, 0]
            if order.dtype.kind != "u":
                raise InputError(f"{keys.place('indices')} must be of whole numbers without a sign")
        used, numbers = np.unique(order[_corners(mode, len(order), keys.place("mode"))], return_inverse=True)
        if not len(used):
            continue
        if used[-1] >= len(positions):
            raise InputError(
                f"{keys.place('indices')} name vertex {used[-1]}, but they are numbered 0 to {len(positions) - 1}"
            )
        vertices = _Vertices(gltf, attributes, used, len(positions))
        with about(where):
            normals = vertices.values("NORMAL", "VEC3")
            colors, opacity = _colors(vertices, keys)
            surface = _surface(gltf, keys)
            picture, uvs = _picture(vertices, keys)
        if picture is not None and not picture.is_varied:
            colors, picture = tinted(colors, picture, uvs), None
        yield _Piece(
            positions[used].astype(np.float64),
            numbers.reshape(-1, 3),
            colors,
            np.zeros((len(used), 3)) if normals is None else normals.astype(np.float64),
            surface,
            picture,
            uvs,
            opacity,
        )


def _corners(mode: int, count: int, place: str) -> NDArray[np.int64]:
    """Return the triangles of a mode, (m, 3), as numbers of so many corners."""
    if mode == _TRIANGLES:
        if count % 3:
            raise InputError(f"{place} is that of separate triangles, but there are {count} corners, no multiple of 3")
        return np.arange(count).reshape(-1, 3)
    first = np.arange(max(count - 2, 0))
    if mode == _STRIP:
        return np.stack([first, first + 1 + first % 2, first + 2 - first % 2], axis=1)
    if mode == _FAN:
        return np.stack([first + 1, first + 2, np.zeros_like(first)], axis=1)
    raise InputError(f"{place} must be from 0 to 6, not {mode}")


@dataclass(frozen=True)
class _Vertices:
    """Those of the vertices of a primitive that its triangles use."""

    gltf: _Gltf
    attributes: Table
    used: NDArray[Any]
    #: of all vertices
    count: int

    def values(self, name: str, *types: str) -> NDArray[Any] | None:
        """Return an attribute of them, or None if it is absent."""
        if name not in self.attributes:
            return None
        values = self.gltf.numbers(self.attributes, name, *types)
        if len(values) != self.count:
            raise InputError(f"{name} has {len(values)} values, but POSITION {self.count}")
        return np.asarray(values[self.used])


def _surface(gltf: _Gltf, primitive: Table) -> _Surface:
    """Return roughness and metalness, 0..1, and whether light falls on it; None if the file does not say.

    A roughness by texture is not read, and one that is left out, of 1 by the specification, is often not meant.
    """
    if "material" not in primitive:
        return None
    material = gltf.item(primitive, "material", "materials")
    extensions, keys = material.table("extensions"), material.table("pbrMetallicRoughness")
    if _UNLIT in extensions:
        return 1.0, 0.0, False
    if _GLOSSINESS in extensions:
        older = extensions.table(_GLOSSINESS)
        return None if "specularGlossinessTexture" in older else (1 - older.number("glossinessFactor", 1), 0.0, True)
    if "roughnessFactor" not in keys or "metallicRoughnessTexture" in keys:
        return None
    return keys.number("roughnessFactor"), keys.number("metallicFactor", 1), True


def _material(pieces: Sequence[_Piece]) -> dict[str, Any]:
    """Return the fields of a Material: the mean of all pieces that have a surface, by area."""
    known = [(piece, piece.surface) for piece in pieces if piece.surface is not None]
    if len(known) == len(pieces) and not any(lit for _, (_, _, lit) in known):
        return {"shading": "unlit"}
    areas = []
    for piece, _ in known:
        a, b, c = piece.positions[piece.faces].transpose(1, 0, 2)
        areas.append(float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()))
    if not 0 < sum(areas) < math.inf:
        return {}
    roughness, metalness = np.clip(np.average([surface[:2] for _, surface in known], 0, areas), 0, 1).tolist()
    # Beckmann's roughness of a Blinn-Phong exponent; the strength of highlights is a matter of taste
    return {
        "specular": round((0.8 + 0.3 * metalness) * (1 - roughness), 3),
        "shininess": round(min(max(2 / max(roughness, 0.1) ** 4 - 2, _WIDEST), EXPONENTS[1])),
    }


def _base_color(gltf: _Gltf, primitive: Table) -> tuple[Table, str, str]:
    """Return the table with the base colour of a material, and the names of its factor and its texture."""
    material = gltf.item(primitive, "material", "materials")
    extensions = material.table("extensions")
    if _GLOSSINESS in extensions:
        return extensions.table(_GLOSSINESS), "diffuseFactor", "diffuseTexture"
    return material.table("pbrMetallicRoughness"), "baseColorFactor", "baseColorTexture"


def _colors(vertices: _Vertices, primitive: Table) -> tuple[Array, float]:
    """Return the colours of vertices with alpha, (n, 4), 0..255, without those of a texture; and the opacity of the
    material.

    Only materials that are blended have either.
    """
    vertex_colors = vertices.values("COLOR_0", "VEC3", "VEC4")
    if "material" not in primitive and vertex_colors is None:
        return np.full((len(vertices.used), 4), (*DEFAULT_COLOR, 255), dtype=np.float64), 1.0
    linear, opacity, is_blended = np.ones((len(vertices.used), 4)), 1.0, False
    if "material" in primitive:
        keys, name, _ = _base_color(vertices.gltf, primitive)
        *factor, opacity = np.clip(keys.numbers(name, (1, 1, 1, 1)), 0, 1).tolist()
        linear[:, :3] *= factor
        is_blended = vertices.gltf.item(primitive, "material", "materials").get("alphaMode") == _BLEND
    if vertex_colors is not None:
        most = np.iinfo(vertex_colors.dtype).max if vertex_colors.dtype.kind in "iu" else 1
        own = vertex_colors.astype(np.float64) / most
        bad = np.flatnonzero(~np.isfinite(own).all(axis=1))
        if len(bad):
            raise InputError(f"colour {bad[0]} must be finite numbers, not {own[bad[0]].tolist()}")
        linear[:, : own.shape[1]] *= np.clip(own, 0, 1)
    alpha = np.rint(255 * linear[:, 3:]) if is_blended else np.full((len(linear), 1), 255.0)
    return np.hstack([to_srgb(linear[:, :3]), alpha]), opacity if is_blended else 1.0


def _picture(vertices: _Vertices, primitive: Table) -> tuple[Picture | None, Array]:
    """Return the image of the base colour texture, None if there is none, and where the vertices are on it, (n, 2)."""
    nowhere = np.zeros((len(vertices.used), 2))
    if "material" not in primitive:
        return None, nowhere
    keys, _, texture = _base_color(vertices.gltf, primitive)
    if texture not in keys:
        return None, nowhere
    info = keys.table(texture)
    transform = info.table("extensions").table("KHR_texture_transform")
    number = transform.whole("texCoord", info.whole("texCoord", 0))
    coordinates = vertices.values(f"TEXCOORD_{number}", "VEC2")
    picture = vertices.gltf.picture(vertices.gltf.item(info, "index", "textures"))
    if picture is None or coordinates is None:
        return None, nowhere
    u, v = (coordinates * np.array(transform.numbers("scale", (1, 1)))).T
    angle, (right, down) = transform.number("rotation", 0), transform.numbers("offset", (0, 0))
    sine, cosine = math.sin(angle), math.cos(angle)
    u, v = right + cosine * u + sine * v, down - sine * u + cosine * v
    return picture, finite_uvs(np.stack([u, v], axis=1), picture.name)


def _place(piece: _Piece, matrix: Array) -> _Piece:
    """Return a piece where its node puts it."""
    faces, linear = piece.faces, matrix[:3, :3]
    # the matrix of the cofactors turns normals right under any scale; its sign follows that of a mirror
    cofactors = np.stack(
        [np.cross(linear[1], linear[2]), np.cross(linear[2], linear[0]), np.cross(linear[0], linear[1])]
    )
    if np.linalg.det(linear) < 0:
        faces, cofactors = faces[:, ::-1], -cofactors
    normals = piece.normals @ cofactors.T
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.asarray(np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0))
    return replace(piece, positions=piece.positions @ linear.T + matrix[:3, 3], faces=faces, normals=normals)


def _join(pieces: Sequence[_Piece], count: int) -> MeshPart:
    """Return pieces with one texture, or with none, as one. count: how many textures the file has."""
    starts = np.cumsum([0, *(len(piece.positions) for piece in pieces)])
    corners = np.concatenate([piece.faces + start for piece, start in zip(pieces, starts, strict=False)])
    positions, colors, normals, uvs = (
        np.concatenate([getattr(piece, name) for piece in pieces]) for name in ("positions", "colors", "normals", "uvs")
    )
    material = _material(pieces)
    corner_colors, corner_uvs = colors[corners], None
    picture = pieces[0].picture
    if picture is not None and picture.is_plain(uvs[corners]):
        corner_colors = tinted(corner_colors, picture, uvs[corners])
    elif picture is not None:
        material["texture"], corner_uvs = picture.texture(uvs[corners], count)
    found = filled(positions, corners, normals[corners]) if normals.any() else None
    return MeshPart(weld(positions, corners, corner_colors, found, corner_uvs), material, pieces[0].opacity)
