"""Pieces and pictures from the contract."""

from __future__ import annotations

import time
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ...artifacts import artifact
from ...chain import CallResult, Chain, ContractChain, open_chain
from ...errors import InputError, RenderError
from ...image import Image, decode_bmp
from ._piece import GenesisPiece, Point3

CONTRACT = "Genesis"
#: The side of a picture, in pixels.
SIDE = 128

#: A packed mesh: its header, then vertices and colours, then faces (contracts/src/scene/Mesh.sol).
HEADER, VERTEX, FACE = 5, np.dtype([("position", ">i2", 3), ("color", "u1", 3)]), np.dtype((">u2", 3))


def call(function: str, seed: bytes, chain: Chain | None = None) -> CallResult:
    """Call a function of the contract that takes a seed. RenderError where the seed has no piece."""
    place = open_chain() if chain is None else chain
    if not isinstance(place, ContractChain):
        raise InputError(f"{place.name} runs no contracts")
    if len(seed) != 32:
        raise InputError(f"a seed has 32 bytes, not {len(seed)}")
    return place.call(CONTRACT, artifact(CONTRACT).interface.encode(function, seed))


def generate_on_chain(seed: bytes, chain: Chain | None = None) -> tuple[GenesisPiece, int]:
    """Return the piece of a seed, and the gas that making it took."""
    result = call("generate", seed, chain)
    return decode_piece(seed, result.output), result.gas


def picture_on_chain(piece: GenesisPiece, chain: Chain | None = None) -> Image:
    """Return the picture of a piece, 128 x 128 pixels, made by one call from its seed alone."""
    from ..._on import Embedded
    from ...parallel import Counter

    place = open_chain() if chain is None else chain
    started = time.perf_counter()
    result = call("render", piece.seed, place)
    seconds = time.perf_counter() - started
    bmp = _decoded("render", result.output)
    return Image(
        pixels=decode_bmp(bmp, SIDE, SIDE),
        bmp=bmp,
        gas=result.gas,
        intrinsic_gas=result.intrinsic_gas,
        made_by=place.name,
        seconds=seconds,
        scene=piece.scene(),
        counter=Counter(Embedded(place)),
    )


def decode_piece(seed: bytes, output: bytes) -> GenesisPiece:
    """Decode what `generate` returned, a struct Piece of contracts/src/genesis/Genesis.sol."""
    traits, background, culling, mesh = _decoded("generate", output)
    structure, chroma, pseudosymmetry, prisms, wireframe, invert = traits
    vertices, faces = (int.from_bytes(mesh[at : at + 2], "big") for at in (1, 3))
    end = HEADER + VERTEX.itemsize * vertices
    if len(mesh) != end + FACE.itemsize * faces:
        raise RenderError("the contract returned a mesh that is not complete")
    packed = np.frombuffer(mesh, VERTEX, vertices, HEADER)
    return GenesisPiece(
        seed=seed,
        structure=structure,
        chroma=chroma,
        pseudosymmetry=pseudosymmetry,
        prisms=prisms,
        wireframe=wireframe,
        culling=culling,
        invert=invert,
        background=(_color(background[0]), _color(background[1])),
        verts=_triples(packed["position"]),
        cols=_triples(packed["color"]),
        faces=_triples(np.frombuffer(mesh[end:], FACE.base).reshape(-1, 3)),
    )


def _decoded(function: str, output: bytes) -> Any:
    try:
        return artifact(CONTRACT).interface.decode(function, output)
    except ValueError:
        raise RenderError(f"the contract returned {len(output)} bytes that do not hold a piece") from None


def _triples(rows: NDArray[Any]) -> list[Point3]:
    return [cast(Point3, tuple(row)) for row in rows.tolist()]


def _color(value: int) -> Point3:
    return value >> 16, value >> 8 & 255, value & 255
