"""Shackled Genesis: 1024 pieces of an on-chain generator. Every seed of 32 bytes gives a piece."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ..artifacts import artifact
from ..chain._chain import CallResult, Drawing
from ..chain._opening import open_chain
from ..errors import InputError, RenderError
from ..ethereum._encoding import intrinsic_gas, keccak256
from ..image import Image, render_whole
from ..scene._effects import Background
from ..scene._light import Light
from ..scene._mesh import Mesh
from ..scene._object import Material, Object
from ..scene._scene import Scene
from ._pieces import Piece

COUNT = 1024
CONTRACT = "Genesis"

#: A packed mesh: its header, then vertices and colours, then faces (contracts/src/scene/Mesh.sol).
HEADER, VERTEX, FACE = 5, np.dtype([("position", ">i2", 3), ("color", "u1", 3)]), np.dtype((">u2", 3))

#: Colours, vertices, or corners of faces: three numbers each.
Rows = list[list[int]]

#: Every piece has full ambient light, and a light from the left.
MATERIAL = Material("flat", ambient=1, diffuse=0.8, specular=1.2, shininess=10)
LIGHT = Light("directional", (-50, 0, 0))
POSITION = (0, 0, -2500)


@dataclass(frozen=True)
class GenesisPiece:
    """The piece of a seed.

    prisms: number of prisms. culling: whether faces that point away are left out. background: the colours of the top
    and the bottom. verts: six vertices per prism. cols: their colours, red, green and blue, 0..255. faces: seven faces
    per prism.
    """

    seed: bytes
    structure: str
    chroma: str
    pseudosymmetry: str
    prisms: int
    wireframe: bool
    culling: bool
    invert: bool
    background: Rows
    verts: Rows
    cols: Rows
    faces: Rows

    def document(self) -> dict[str, Any]:
        """Return the piece as a JSON object; `seed` is 64 hexadecimal digits."""
        return asdict(self) | {"seed": self.seed.hex()}

    def scene(self) -> Scene:
        """Return the scene: 128 x 128 pixels, seen from the front, lit from the left."""
        mesh = Mesh(self.verts, self.faces, self.cols)
        return Scene(
            [Object(mesh, POSITION, material=MATERIAL, cull=self.culling, wireframe=self.wireframe)],
            lights=[LIGHT],
            background=Background(*self.background),
            invert=self.invert,
        )


def call(function: str, seed: bytes) -> CallResult:
    """Call a function of the contract that takes a seed. RenderError where the seed has no piece."""
    if len(seed) != 32:
        raise InputError(f"a seed has 32 bytes, not {len(seed)}")
    return open_chain().call(CONTRACT, artifact(CONTRACT).interface.encode(function, seed))


def generate(seed: bytes) -> GenesisPiece:
    """Generate the piece of a seed with the contract. RenderError for the rare seeds without a piece."""
    return generate_on_chain(seed)[0]


def generate_on_chain(seed: bytes) -> tuple[GenesisPiece, int]:
    """Return the piece of a seed, and the gas that making it took."""
    result = call("generate", seed)
    return decode_piece(seed, result.output), result.gas


def picture_on_chain(piece: GenesisPiece) -> Image:
    """Return the picture of a piece, 128 x 128 pixels, made by one call from its seed alone."""

    def draw(_: Scene) -> Drawing:
        result, data = call("render", piece.seed), artifact(CONTRACT).interface.encode("render", piece.seed)
        return Drawing(_decoded("render", result.output), result.gas, intrinsic_gas(data))

    return render_whole(piece.scene(), draw, open_chain().name)


def decode_piece(seed: bytes, output: bytes) -> GenesisPiece:
    """Decode what `generate` returned, a struct Piece of contracts/src/genesis/Genesis.sol."""
    traits, background, culling, mesh = _decoded("generate", output)
    structure, chroma, symmetry, prisms, wireframe, invert = traits
    vertices, faces = (int.from_bytes(mesh[at : at + 2], "big") for at in (1, 3))
    end = HEADER + VERTEX.itemsize * vertices
    if len(mesh) != end + FACE.itemsize * faces:
        raise RenderError("the contract returned a mesh that is not complete")
    packed = np.frombuffer(mesh, VERTEX, vertices, HEADER)
    colors = [[color >> 16, color >> 8 & 255, color & 255] for color in background]
    corners = np.frombuffer(mesh[end:], FACE.base).reshape(-1, 3)
    verts, cols, triangles = (each.tolist() for each in (packed["position"], packed["color"], corners))
    return GenesisPiece(
        *(seed, structure, chroma, symmetry, prisms, wireframe, culling, invert, colors, verts, cols, triangles)
    )


def _decoded(function: str, output: bytes) -> Any:
    try:
        return artifact(CONTRACT).interface.decode(function, output)
    except ValueError:
        raise RenderError(f"the contract returned {len(output)} bytes that do not hold a piece") from None


def seed_of(number: int) -> bytes:
    """Return the seed of a piece of the collection, from 0 to 1023."""
    if not 0 <= number < COUNT:
        raise InputError(f"the pieces of the collection are numbered from 0 to {COUNT - 1}, not {number}")
    return keccak256(f"shackled-{number}".encode("ascii"))


def parse_seed(text: str) -> bytes:
    """Return the seed of 64 hexadecimal digits, with or without 0x, or of the number of a piece."""
    if re.fullmatch(r"(0[xX])?[0-9a-fA-F]{64}", text):
        return bytes.fromhex(text[-64:])
    if re.fullmatch(r"0|[1-9][0-9]{0,3}", text) and int(text) < COUNT:
        return seed_of(int(text))
    raise InputError(
        f"a seed must be 64 hexadecimal digits, with or without 0x, or a number from 0 to {COUNT - 1}, not {text!r:.80}"
    )


def pieces() -> Iterator[Piece]:
    """Return the pieces of the collection."""
    return (_piece(str(number), seed_of(number)) for number in range(COUNT))


def find(name: str) -> Piece | None:
    """Return the piece of a number or seed, as `parse_seed` reads it; None if it is neither."""
    try:
        seed = parse_seed(name)
    except InputError:
        return None
    return _piece(name if len(name) < 64 else seed.hex(), seed)


def _piece(label: str, seed: bytes) -> Piece:
    title = f"Genesis {label if len(label) < 64 else label[:8]}"
    return Piece(f"genesis/{label}", "genesis", title, "MIT", lambda: generate(seed).scene())
