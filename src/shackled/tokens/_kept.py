"""What a chain keeps of a scene, read without trusting it: every byte is what its address is made of."""

from __future__ import annotations

from collections.abc import Iterator

from ..chain import Connection
from ..errors import VerificationError
from ..ethereum import checksum_address
from ..studio import PARTS, POINTED, SCENE, kept_at, scene_struct


def kept_codes(connection: Connection, studio: bytes, pointer: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Yield address and code of all that is kept of a scene: itself, its meshes, and their parts where they have any.

    VerificationError if anything is missing, or is not what belongs there.
    """
    kept: dict[bytes, bytes] = {}

    def read(place: bytes) -> bytes:
        """Return the bytes that are kept at a place, parts and all."""
        code = connection.code(place)
        if not code:
            raise VerificationError(f"nothing is kept at {checksum_address(place)}")
        # it starts with an instruction that stops all calls; the bytes after it make the address
        if code[:1] != b"\0" or kept_at(code[1:], studio) != place:
            raise VerificationError(f"the bytes at {checksum_address(place)} are not those that belong there")
        kept[place] = code
        data = code[1:]
        if data[:1] != bytes([PARTS]):
            return data
        return b"".join(read(data[at : at + 20]) for at in range(1, len(data), 20))

    for mesh in meshes_of(read(pointer)):
        if mesh[:1] == bytes([POINTED]):
            read(mesh[1:])
    yield from kept.items()


def meshes_of(data: bytes) -> list[bytes]:
    """Return the field `mesh` of each object of a scene as it is kept. VerificationError if it is none."""
    from eth_abi.abi import decode
    from eth_abi.exceptions import DecodingError

    if data[:1] != bytes([SCENE]):
        raise VerificationError("what is kept there is no scene")
    try:
        (struct,) = decode([scene_struct()], expand_zeros(data[1:]))
    except (DecodingError, IndexError, OverflowError) as error:
        raise VerificationError(f"what is kept there is no whole scene: {error}") from None
    *_, objects, _ = struct
    return [thing[0] for thing in objects]


def expand_zeros(data: bytes) -> bytes:
    """Return the bytes of which `compress_zeros` made these."""
    result = bytearray()
    whole = iter(bytes(value ^ 255 for value in data[:4]) + data[4:])
    for value in whole:
        if value:
            result.append(value)
            continue
        run = next(whole, 0)
        result += (b"\xff" if run & 128 else b"\0") * ((run & 127) + 1)
    return bytes(result)
