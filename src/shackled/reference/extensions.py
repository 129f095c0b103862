"""What a scene, its lights and its objects have beyond the fields of their structs: records."""

from __future__ import annotations

#: Kinds.
SPOT, OPACITY = 1, 2
#: Bytes of kind, index and size; and of what follows, by kind.
HEADER = 5
SIZES = {SPOT: 40, OPACITY: 4}
#: One, as Q24.
OPAQUE = 1 << 24

#: The contents by kind and index.
Records = dict[tuple[int, int], bytes]


def read_records(data: bytes) -> Records:
    """The records of a scene that was checked."""
    records = {}
    while data:
        size = int.from_bytes(data[3:HEADER], "big")
        records[data[0], int.from_bytes(data[1:3], "big")] = data[HEADER : HEADER + size]
        data = data[HEADER + size :]
    return records


def spot_numbers(content: bytes) -> tuple[int, ...]:
    """The direction, and the cosines of the inner and the outer angle."""
    return tuple(int.from_bytes(content[i : i + 8], "big", signed=True) for i in range(0, 40, 8))
