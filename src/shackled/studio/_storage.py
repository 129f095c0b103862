"""Storage of scenes in the Studio: the transactions that store one, and the code that one consists of."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from attrs import evolve

from ..artifacts import artifact
from ..chain._connection import Connection
from ..chain._opening import open_chain
from ..errors import InputError, VerificationError
from ..ethereum._abi import decode_values, encode_values
from ..ethereum._encoding import checksum_address, create2_address, intrinsic_gas, word
from ..scene._arithmetic import rotate
from ..scene._codec import encode_scene
from ..scene._in_range import in_range
from ..scene._object import Object
from ..scene._packed import pack
from ..scene._scene import Scene
from ._compact_mesh import compact, vertex_order

STUDIO = "Studio"
#: The Studio's function that makes an animated PNG file: of a pointer, how it turns (the struct Turn), and Changes.
ANIMATE = (
    "animate(address,(uint256,uint256,uint256,(int256,int256,int256),bool),"
    "(uint256,(int256,int256,int256,int256),uint256,(uint256,uint256),uint256,(uint256,uint256)))"
)

#: Maximum size of a part: a contract of 24,576 bytes, less the STOP instruction in front.
MAX_PART = 24575
#: First bytes of stored data (contracts/src/mesh/Kinds.sol): a list of parts, a pointer to a mesh, a scene.
PARTS = 0x13
POINTED = 0x12
SCENE = 0x20


@dataclass(frozen=True)
class StoreTransaction:
    """A transaction to the Studio.

    what: description. data: of the call. pointer: the address at which the bytes are stored. content: these bytes.
    gas: of the whole transaction if none of it is stored yet.
    """

    what: str
    data: bytes
    pointer: bytes
    content: bytes
    gas: int

    @property
    def size(self) -> int:
        """Number of stored bytes."""
        return len(self.content)

    @property
    def code(self) -> bytes:
        """Code at the pointer: a STOP instruction, then the stored bytes."""
        return b"\0" + self.content

    @property
    def gas_limit(self) -> int:
        """Gas limit of the transaction, more than it uses, since a call passes on all but a 64th."""
        return self.gas * 21 // 20


def store_scene(
    scene: Scene, studio: bytes, position_bits: int | None = None, normal_bits: int = 10
) -> list[StoreTransaction]:
    """Return the transactions that store a scene: each of its meshes once, then the scene, whose pointer is the last.

    studio: address of the Studio, 20 bytes. position_bits: round vertices to a grid of 2^position_bits steps across
    the longest side of each mesh, 4 to 16; None is exact. normal_bits: see `compact`.
    """
    if len(studio) != 20:
        raise InputError(f"an address has 20 bytes, not {len(studio)}")
    if position_bits is not None:
        scene = evolve(scene, objects=[quantize(o, position_bits) for o in scene.objects])
    fitted = in_range(scene)
    meshes = [compact(pack(o.mesh, o.material.shading == "smooth"), normal_bits) for o in fitted.objects]
    result: list[StoreTransaction] = []
    for number, mesh in enumerate(dict.fromkeys(meshes), 1):
        result += store_mesh(f"mesh {number}", mesh, studio)
    ordered = evolve(fitted, objects=[_as_stored(o) for o in fitted.objects])
    struct = encode_with_pointers(ordered, [storage_address(mesh, studio) for mesh in meshes])
    data = artifact(STUDIO).selectors["storeScene"] + word(32) + struct
    # the ABI encodes a struct after its own offset
    content = bytes([SCENE]) + compress_zeros(word(32) + struct)
    return result + _transactions("scene", content, data, studio)


def _as_stored(o: Object) -> Object:
    """Return the object with texture coordinates and opacities in the order that vertices have in a stored mesh."""
    uvs, opacities = o.mesh.uvs, o.mesh.opacities
    if uvs is None and opacities is None:
        return o
    order = vertex_order(pack(o.mesh))
    uvs, opacities = (None if each is None else each[order] for each in (uvs, opacities))
    return evolve(o, mesh=evolve(o.mesh, uvs=uvs, opacities=opacities))


def store_mesh(what: str, mesh: bytes, studio: bytes) -> list[StoreTransaction]:
    """Return the transactions that store a compact mesh, usually one; `what` describes it. The last has its pointer."""
    return _transactions(what, mesh, artifact(STUDIO).interface.encode("storeMesh", mesh), studio)


def storage_address(data: bytes, studio: bytes) -> bytes:
    """Return the address at which a Studio stores these bytes."""
    if len(data) <= MAX_PART:
        return _created(data, studio)
    return _created(_part_list(_parts(data), studio), studio)


def quantize(o: Object, bits: int) -> Object:
    """Round the vertices of an object to a grid of 2^bits steps across its longest side; it stays in place.

    The error is at most half a step along each axis. Normals are those of the original mesh.
    """
    if not 4 <= bits <= 16:
        raise InputError(f"a grid has 4 to 16 bits a side, not {bits}")
    positions = o.mesh.positions
    low, high = positions.min(axis=0), positions.max(axis=0)
    center, span = (low + high) / 2, float((high - low).max())
    if o.fade is not None:
        # its radii are about the object's position, which therefore stays
        center, span = np.zeros(3), 2 * float(np.abs(positions).max())
    step = span / ((1 << bits) - 2) or 1.0
    mesh = evolve(o.mesh, positions=np.rint((positions - center) / step))
    place = o.position + rotate(o.rotation, center * o.scale)
    return evolve(o, mesh=mesh, position=place, scale=o.scale * step)


def encode_with_pointers(scene: Scene, pointers: Sequence[bytes]) -> bytes:
    """Encode the struct of a scene that `in_range` made, with pointers in place of its meshes."""
    kind = scene_struct()
    (struct,) = decode_values([kind], word(32) + encode_scene(scene))
    *others, objects, extensions = struct
    pointed = [(bytes([POINTED]) + pointer, *o[1:]) for o, pointer in zip(objects, pointers, strict=True)]
    return encode_values([kind], [(*others, pointed, extensions)])[32:]


def scene_struct() -> str:
    """Return the ABI type of the contracts' struct Scene."""
    return artifact(STUDIO).interface.parameter_type("storeScene")


def compress_zeros(data: bytes) -> bytes:
    """Compress like LibZip.cdCompress of solady: runs of 0x00 and 0xff in two bytes, the first four bytes negated."""
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


def _parts(data: bytes) -> list[bytes]:
    return [data[at : at + MAX_PART] for at in range(0, len(data), MAX_PART)]


def _transactions(what: str, content: bytes, data: bytes, studio: bytes) -> list[StoreTransaction]:
    if len(content) <= MAX_PART:
        return [_transaction(what, data, content, studio)]
    parts, interface = _parts(content), artifact(STUDIO).interface
    result = [
        _transaction(f"{what}, part {number} of {len(parts)}", interface.encode("storePart", part), part, studio)
        for number, part in enumerate(parts, 1)
    ]
    content = _part_list(parts, studio)
    joining = interface.encode("join", [each.pointer for each in result])
    # an estimate, since the parts are not there yet: a contract of the size of the list, and reading each part
    gas = (
        intrinsic_gas(joining) + 32_000 + 200 * (len(content) + 1) + 2_600 * (len(parts) + 1) + 3_000 + 400 * len(parts)
    )
    return [*result, StoreTransaction(f"{what}, joined", joining, _created(content, studio), content, gas)]


def _transaction(what: str, data: bytes, content: bytes, studio: bytes) -> StoreTransaction:
    gas = open_chain().call(STUDIO, data).gas + intrinsic_gas(data)
    return StoreTransaction(what, data, _created(content, studio), content, gas)


def _part_list(parts: Sequence[bytes], studio: bytes) -> bytes:
    return bytes([PARTS]) + b"".join(_created(part, studio) for part in parts)


def _created(data: bytes, studio: bytes) -> bytes:
    """Return the address that CREATE2 gives the contract with the data (solady's SSTORE2)."""
    code = bytes.fromhex("61") + (len(data) + 1).to_bytes(2, "big") + bytes.fromhex("80600a3d393df300") + data
    return create2_address(code, creator=studio)


#: The parts of a list have at most this many bytes together (Storage.sol).
MAX_SIZE = 1 << 20


def stored_codes(connection: Connection, studio: bytes, pointer: bytes) -> dict[bytes, bytes]:
    """Return code by address of all parts of a stored scene: the scene, its meshes, and their parts.

    Raises VerificationError if a part is missing or its bytes do not belong to its address.
    """
    codes: dict[bytes, bytes] = {}

    def part(place: bytes) -> bytes:
        """Return the bytes of one contract; each is read once."""
        if place not in codes:
            code = connection.code(place)
            if not code:
                raise VerificationError(f"nothing is stored at {checksum_address(place)}")
            # the first byte is a STOP instruction; the bytes after it determine the address
            if code[:1] != b"\0" or storage_address(code[1:], studio) != place:
                raise VerificationError(f"the bytes at {checksum_address(place)} do not belong to that address")
            codes[place] = code
        return codes[place][1:]

    def read(place: bytes) -> bytes:
        """Return the bytes stored at an address. As in Storage.sol, the parts of a list are never lists themselves."""
        data = part(place)
        if data[:1] != bytes([PARTS]):
            return data
        places = [data[1 + 20 * k : 21 + 20 * k] for k in range((len(data) - 1) // 20)]
        if sum(len(part(each)) for each in places) > MAX_SIZE:
            raise VerificationError(
                f"the parts at {checksum_address(place)} have more than {MAX_SIZE:,} bytes together"
            )
        return b"".join(part(each) for each in places)

    for mesh in stored_meshes(read(pointer)):
        if mesh[:1] == bytes([POINTED]):
            read(mesh[1:])
    return codes


def stored_meshes(data: bytes) -> list[bytes]:
    """Return the field `mesh` of each object of a stored scene. Raises VerificationError if the bytes are invalid."""
    if data[:1] != bytes([SCENE]):
        raise VerificationError("the stored bytes are not a scene")
    try:
        (struct,) = decode_values([scene_struct()], expand_zeros(data[1:]))
    except (ValueError, IndexError) as error:
        raise VerificationError(f"the stored bytes are not a complete scene: {error}") from None
    *_, objects, _ = struct
    return [each[0] for each in objects]


def expand_zeros(data: bytes) -> bytes:
    """Decompress the result of `compress_zeros`."""
    result = bytearray()
    source = iter(bytes(value ^ 255 for value in data[:4]) + data[4:])
    for value in source:
        if value:
            result.append(value)
            continue
        run = next(source, 0)
        result += (b"\xff" if run & 128 else b"\0") * ((run & 127) + 1)
    return bytes(result)
