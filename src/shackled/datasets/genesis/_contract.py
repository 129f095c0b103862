"""Pieces as the contract makes them."""

from __future__ import annotations

import time
from typing import cast

from ...artifacts import artifact
from ...chain import CallResult, Chain, ContractChain, open_chain
from ...errors import InputError, RenderError
from ...image import Image, decode_bmp
from ._piece import GenesisPiece, Point3

CONTRACT = "Genesis"
#: Of a picture, in pixels.
SIDE = 128

HEADER_SIZE = 5
VERTEX_SIZE = 9
FACE_SIZE = 6


def call(function: str, seed: bytes, chain: Chain | None = None) -> CallResult:
    """Calls a function of the contract that takes a seed. RenderError where the seed has no piece."""
    place = open_chain() if chain is None else chain
    if not isinstance(place, ContractChain):
        raise InputError(f"{place.name} runs no contracts, and has no pieces")
    if len(seed) != 32:
        raise InputError(f"a seed has 32 bytes, not {len(seed)}")
    return place.call(CONTRACT, artifact(CONTRACT).selectors[function] + seed)


def generate_on_chain(seed: bytes, chain: Chain | None = None) -> tuple[GenesisPiece, int]:
    """The piece of a seed, and the gas that making it took."""
    result = call("generate", seed, chain)
    return decode_piece(seed, result.output), result.gas


def picture_on_chain(piece: GenesisPiece, chain: Chain | None = None) -> Image:
    """The picture of a piece, 128 x 128 pixels, made by one call from nothing but its seed; and the gas of that."""
    place = open_chain() if chain is None else chain
    started = time.perf_counter()
    result = call("render", piece.seed, place)
    seconds = time.perf_counter() - started
    bmp = _bytes(result.output, _number(result.output, 0))
    return Image(
        pixels=decode_bmp(bmp, SIDE, SIDE),
        bmp=bmp,
        gas=result.gas,
        intrinsic_gas=result.intrinsic_gas,
        chain=place.name,
        seconds=seconds,
        scene=piece.scene(),
    )


def decode_piece(seed: bytes, output: bytes) -> GenesisPiece:
    """What `generate` returned: a struct Piece of contracts/src/genesis/Genesis.sol."""
    piece = _number(output, 0)
    traits = piece + _number(output, piece)
    mesh = _bytes(output, piece + _number(output, piece + 128))
    vertices, faces = (int.from_bytes(mesh[at : at + 2], "big") for at in (1, 3))
    end = HEADER_SIZE + VERTEX_SIZE * vertices
    if len(mesh) != end + FACE_SIZE * faces:
        raise RenderError("the contract returned a mesh that is not complete")
    packed = [mesh[at : at + VERTEX_SIZE] for at in range(HEADER_SIZE, end, VERTEX_SIZE)]
    structure, chroma, pseudosymmetry = (
        _bytes(output, traits + _number(output, traits + 32 * k)).decode("ascii") for k in range(3)
    )
    return GenesisPiece(
        seed=seed,
        structure=structure,
        chroma=chroma,
        pseudosymmetry=pseudosymmetry,
        prisms=_number(output, traits + 96),
        wireframe=_number(output, traits + 128) == 1,
        culling=_number(output, piece + 96) == 1,
        invert=_number(output, traits + 160) == 1,
        background=(_color(_number(output, piece + 32)), _color(_number(output, piece + 64))),
        verts=[_triple(vertex[:6], signed=True) for vertex in packed],
        cols=[_color(int.from_bytes(vertex[6:], "big")) for vertex in packed],
        faces=[_triple(mesh[at : at + FACE_SIZE], signed=False) for at in range(end, len(mesh), FACE_SIZE)],
    )


def _number(output: bytes, at: int) -> int:
    if at + 32 > len(output):
        raise RenderError(f"the contract returned {len(output)} bytes that do not hold a piece")
    return int.from_bytes(output[at : at + 32], "big")


def _bytes(output: bytes, at: int) -> bytes:
    data = output[at + 32 : at + 32 + _number(output, at)]
    if len(data) != _number(output, at):
        raise RenderError(f"the contract returned {len(output)} bytes that do not hold a piece")
    return data


def _triple(data: bytes, signed: bool) -> Point3:
    """Three numbers of two bytes."""
    numbers = tuple(int.from_bytes(data[at : at + 2], "big", signed=signed) for at in (0, 2, 4))
    return cast(Point3, numbers)


def _color(value: int) -> Point3:
    return value >> 16, value >> 8 & 255, value & 255
