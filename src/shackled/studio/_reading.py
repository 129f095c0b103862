"""Stored scenes, read from an untrusted node: the address of each part is a hash of its bytes."""

from __future__ import annotations

from ..chain import Connection
from ..errors import VerificationError
from ..ethereum import checksum_address, decode_values
from ._storage import PARTS, POINTED, SCENE, scene_struct, storage_address

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
