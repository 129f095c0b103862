"""What is kept in the Studio: the data of the calls that store it, where it will be, and what it costs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from attrs import evolve

from ..artifacts import artifact
from ..chain import ContractChain, open_chain
from ..errors import InputError
from ..ethereum import create2_address, intrinsic_gas, word
from ..scene import Object, Scene, encode_scene, fit, pack, rotate
from ._compact_mesh import compact

STUDIO = "Studio"

#: What one contract can hold: 24,576 bytes, less the instruction in front that stops all calls.
MAX_PART = 24575
#: The first bytes of what is kept (contracts/src/mesh/Kinds.sol).
PARTS = 0x13
POINTED = 0x12
SCENE = 0x20


@dataclass(frozen=True)
class Storing:
    """A transaction to the Studio.

    what: in words. data: of the call. pointer: where the Studio will keep it. kept: the bytes that it keeps there.
    gas: what the whole transaction uses, if nothing of it is kept yet.
    """

    what: str
    data: bytes
    pointer: bytes
    kept: bytes
    gas: int

    @property
    def size(self) -> int:
        """How many bytes are kept."""
        return len(self.kept)

    @property
    def code(self) -> bytes:
        """What stands at the pointer: an instruction that stops all calls, then what is kept."""
        return b"\0" + self.kept

    @property
    def gas_limit(self) -> int:
        """What a transaction must be given for that: more than it uses, since a call hands on all but a 64th."""
        return self.gas * 21 // 20


def store_scene(
    scene: Scene,
    studio: bytes,
    position_bits: int | None = None,
    normal_bits: int = 10,
    chain: ContractChain | None = None,
) -> list[Storing]:
    """Return the transactions that store a scene: its meshes, each once, then the scene with the last pointer.

    studio: the address of the Studio, 20 bytes. position_bits: if given, meshes are laid on a grid of 2^position_bits
    steps across their largest side, 4 to 16; else nothing is lost. normal_bits: see `compact`.
    chain: where gas is counted; the embedded EVM if None.
    """
    check_address(studio)
    if position_bits is not None:
        scene = evolve(scene, objects=[on_grid(o, position_bits) for o in scene.objects])
    fitted = fit(scene)
    meshes = [compact(pack(o.mesh, o.material.shading == "smooth"), normal_bits) for o in fitted.objects]
    result: list[Storing] = []
    for number, mesh in enumerate(dict.fromkeys(meshes), 1):
        result += _storings(f"mesh {number}", mesh, _call("storeMesh", mesh), studio, chain)
    struct = pointing(fitted, [kept_at(mesh, studio) for mesh in meshes])
    data = artifact(STUDIO).selectors["storeScene"] + word(32) + struct
    # as the ABI says, a struct is encoded behind the offset of itself
    kept = bytes([SCENE]) + compress_zeros(word(32) + struct)
    return result + _storings("scene", kept, data, studio, chain)


def store_mesh(
    packed: bytes, studio: bytes, normal_bits: int = 10, chain: ContractChain | None = None
) -> list[Storing]:
    """Return the transactions that store a packed mesh; mostly one. The last has its pointer."""
    check_address(studio)
    mesh = compact(packed, normal_bits)
    return _storings("mesh", mesh, _call("storeMesh", mesh), studio, chain)


def read_mesh(pointer: bytes, chain: ContractChain) -> bytes:
    """Return the packed mesh that the Studio of a chain keeps there."""
    return bytes(chain.ask(STUDIO, "mesh", check_address(pointer)))


def kept_at(data: bytes, studio: bytes) -> bytes:
    """Return the address at which a Studio keeps these bytes."""
    if len(data) <= MAX_PART:
        return _created(data, studio)
    return _created(_list(parts_of(data), studio), studio)


def parts_of(data: bytes) -> list[bytes]:
    """Return the bytes in parts that a contract can hold."""
    return [data[at : at + MAX_PART] for at in range(0, len(data), MAX_PART)]


def on_grid(o: Object, bits: int) -> Object:
    """Put the mesh of an object on a grid of 2^bits steps across its largest side, in whole numbers; it stays in place.

    This loses precision: half a step each way. Normals are those of the mesh as it was.
    """
    if not 4 <= bits <= 16:
        raise InputError(f"a grid has 4 to 16 bits a side, not {bits}")
    positions = o.mesh.positions
    low, high = positions.min(axis=0), positions.max(axis=0)
    center = (low + high) / 2
    step = float((high - low).max()) / ((1 << bits) - 2) or 1.0
    mesh = evolve(o.mesh, positions=np.rint((positions - center) / step))
    place = o.position + rotate(o.rotation, center * o.scale)
    return evolve(o, mesh=mesh, position=place, scale=o.scale * step)


def pointing(scene: Scene, pointers: Sequence[bytes]) -> bytes:
    """Return the struct Scene of a scene as `fit` makes it, with the pointers in place of its meshes."""
    from eth_abi.abi import decode, encode

    kind = scene_struct()
    (struct,) = decode([kind], word(32) + encode_scene(scene))
    *others, objects, extensions = struct
    pointed = [(bytes([POINTED]) + pointer, *o[1:]) for o, pointer in zip(objects, pointers, strict=True)]
    return encode([kind], [(*others, pointed, extensions)])[32:]


def scene_struct() -> str:
    """Return the type of the struct Scene of the contracts, as eth_abi takes it."""
    return artifact(STUDIO).interface.parameter_type("storeScene")


def compress_zeros(data: bytes) -> bytes:
    """Compress as LibZip.cdCompress of solady: runs of 0x00 and 0xff in two bytes, the first four bytes negated."""
    result = bytearray()
    at = 0
    while at < len(data):
        value, most = data[at], {0: 128, 255: 32}.get(data[at], 1)
        end = at + 1
        while end < len(data) and end - at < most and data[end] == value:
            end += 1
        result += bytes([value]) if most == 1 else bytes([0, (value & 128) + end - at - 1])
        at = end
    return bytes(value ^ 255 for value in result[:4]) + bytes(result[4:])


def check_address(address: bytes) -> bytes:
    """Return the address, if it has 20 bytes."""
    if len(address) != 20:
        raise InputError(f"an address has 20 bytes, not {len(address)}")
    return address


def _storings(what: str, kept: bytes, whole: bytes, studio: bytes, chain: ContractChain | None) -> list[Storing]:
    if len(kept) <= MAX_PART:
        return [_storing(what, whole, _created(kept, studio), kept, chain)]
    parts = parts_of(kept)
    result = [
        _storing(
            f"{what}, part {number} of {len(parts)}",
            _call("storePart", part),
            _created(part, studio),
            part,
            chain,
        )
        for number, part in enumerate(parts, 1)
    ]
    addresses = [storing.pointer for storing in result]
    listed = _list(parts, studio)
    joining = _call("join", addresses)
    # it can only be counted where the parts are: a contract of so many bytes, what finds out whether they are there
    gas = (
        intrinsic_gas(joining) + 32_000 + 200 * (len(listed) + 1) + 2_600 * (len(parts) + 1) + 3_000 + 400 * len(parts)
    )
    return [*result, Storing(f"{what}, joined", joining, _created(listed, studio), listed, gas)]


def _storing(what: str, data: bytes, pointer: bytes, kept: bytes, chain: ContractChain | None) -> Storing:
    result = (chain or _embedded()).call(STUDIO, data)
    return Storing(what, data, pointer, kept, result.gas + result.intrinsic_gas)


def _embedded() -> ContractChain:
    chain = open_chain()
    assert isinstance(chain, ContractChain)
    return chain


def _list(parts: Sequence[bytes], studio: bytes) -> bytes:
    return bytes([PARTS]) + b"".join(_created(part, studio) for part in parts)


def _created(data: bytes, studio: bytes) -> bytes:
    """Return where CREATE2 puts the contract that holds the data (solady's SSTORE2)."""
    code = bytes.fromhex("61") + (len(data) + 1).to_bytes(2, "big") + bytes.fromhex("80600a3d393df300") + data
    return create2_address(code, creator=studio)


def _call(function: str, *arguments: Any) -> bytes:
    return artifact(STUDIO).interface.encode(function, *arguments)
