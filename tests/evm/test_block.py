"""The block in which calls run: number, timestamp, PREVRANDAO, and the hashes of the blocks before it."""

from __future__ import annotations

import pytest

from evms import ADDRESS, Ours, pyrevm_call
from shackled import InputError
from shackled.ethereum._encoding import keccak256, word
from shackled.evm._instance import Answer, Instance, Status

Block = tuple[int, int, bytes]

GAS = 1_000_000
RANDOM = bytes(range(1, 33))
FIRST: Block = (0, 1, bytes(32))
LATE: Block = (20_000_000, 1_750_000_000, RANDOM)
LARGEST = (1 << 64) - 1
BLOCKS: list[Block] = [
    FIRST,
    (1, 0, RANDOM),
    (256, 1 << 63, bytes(31) + b"\1"),
    (257, 1 << 32, b"\x80" + bytes(31)),
    LATE,
    (LARGEST, LARGEST, b"\xff" * 32),
]

#: Returns TIMESTAMP, NUMBER and PREVRANDAO.
BLOCK = bytes.fromhex("42 5f52 43 602052 44 604052 60605ff3")
#: Returns BLOCKHASH of the number in the call's data.
HASH = bytes.fromhex("5f35 40 5f52 60205ff3")
#: Returns COINBASE, GASLIMIT, CHAINID, BASEFEE, BLOBBASEFEE.
OTHERS = bytes.fromhex("41 5f52 45 602052 46 604052 48 606052 4a 608052 60a05ff3")


def expected(block: Block) -> bytes:
    number, timestamp, prevrandao = block
    return word(timestamp) + word(number) + prevrandao


def agree(ours: Ours, block: Block, code: bytes, data: bytes = b"") -> bytes:
    """Check that a program returns the same for the same gas in pyrevm, and return what."""
    ours.instance.set_block(*block)
    answer = ours.call({ADDRESS: code}, ADDRESS, data, GAS)
    assert answer == pyrevm_call({ADDRESS: code}, ADDRESS, data, GAS, block)
    assert answer.status == Status.SUCCESS
    return answer.output


@pytest.mark.parametrize("block", BLOCKS)
def test_blocks(block: Block) -> None:
    ours = Ours()
    assert agree(ours, block, BLOCK) == expected(block)
    number = block[0]
    for distance in (0, 1, 2, 255, 256, 257, 300):
        if distance <= number:
            hashed = agree(ours, block, HASH, word(number - distance))
            assert hashed == (keccak256(b"%d" % (number - distance)) if 1 <= distance <= 256 else bytes(32))
    for asked in (number + 1, 1 << 64, (1 << 256) - 1):
        assert agree(ours, block, HASH, word(asked)) == bytes(32)


def test_what_is_not_set() -> None:
    """Before the first call of `set_block` the block is the first one; other fields never change."""
    made = Instance()
    made.put(ADDRESS, BLOCK)
    assert made.call(ADDRESS, b"", GAS).output == expected(FIRST)
    assert made.create(BLOCK, GAS).output == expected(FIRST)
    made.put(ADDRESS, OTHERS)
    before = made.call(ADDRESS, b"", GAS)
    made.set_block(*LATE)
    assert made.call(ADDRESS, b"", GAS) == before


def test_all_kinds_of_calls_run_in_it() -> None:
    """And what a transaction stored in one block is there in the next."""
    made, place = Instance(), bytes(20)
    made.put(ADDRESS, BLOCK)
    # returns the timestamp that is stored, and stores that of the block
    made.put(place, bytes.fromhex("5f54 5f52 42 5f55 60205ff3"))
    before = 0
    for block in (LATE, FIRST, LATE):
        made.set_block(*block)
        answers: list[Answer] = [
            made.call(ADDRESS, b"", GAS),
            made.send(ADDRESS, b"", GAS),
            made.profile(ADDRESS, b"", GAS)[0],
            made.create(BLOCK, GAS),
        ]
        assert [answer.output for answer in answers] == [expected(block)] * 4
        # the constructor's result is the code of the contract: EXTCODECOPY of all of it
        deployed = made.deploy(BLOCK, GAS).output
        made.put(b"\1" * 20, bytes.fromhex("60605f5f73") + deployed + bytes.fromhex("3c60605ff3"))
        assert made.call(b"\1" * 20, b"", GAS).output == expected(block)
        assert made.send(place, b"", GAS).output == word(before)
        before = block[1]


@pytest.mark.parametrize("wrong", [-1, 1 << 64, 1.5, "1", None, True])
def test_wrong_numbers(wrong: int) -> None:
    made = Instance()
    made.put(ADDRESS, BLOCK)
    for name, block in (("number", (wrong, 1, RANDOM)), ("timestamp", (1, wrong, RANDOM))):
        with pytest.raises(InputError, match=rf"`{name}` must be a whole number from 0 to 2\^64 - 1, not"):
            made.set_block(*block)
    assert made.call(ADDRESS, b"", GAS).output == expected(FIRST)


@pytest.mark.parametrize("wrong", [b"", bytes(31), bytes(33), "0" * 32, 1])
def test_wrong_randomness(wrong: bytes) -> None:
    with pytest.raises(InputError, match="`prevrandao` must be 32 bytes, not"):
        Instance().set_block(1, 1, wrong)
