"""Seeds: nobody chooses them, and they never change."""

from __future__ import annotations

import random

import pytest
import rlp

pytest.importorskip("pyrevm", reason="a chain with state needs it")

from tools.tokens.launched import PRICE, Launched, launched
from tools.tokens.world import HISTORY, HISTORY_LENGTH, Refused, keccak

from adversaries import adversary
from token_checks import refused

ROUND, DELAY = 32, 128


def drawn(s: Launched, token: int) -> bytes:
    """What the documentation says is drawn for a token."""
    block = s.genesis.call("blockOf", s.genesis.call("roundOf", token))
    address = bytes.fromhex(s.genesis.address[2:]).rjust(32, b"\0")
    return keccak(s.world.randomness(block) + address + token.to_bytes(32, "big"))


def test_a_round_has_one_block_long_after_its_own(s: Launched) -> None:
    first = s.genesis.call("firstBlock")
    assert (s.genesis.call("ROUND"), s.genesis.call("DELAY")) == (ROUND, DELAY)
    for _ in range(3 * ROUND):
        (token,) = s.mint()
        expected = (s.world.number - first) // ROUND
        assert s.genesis.call("currentRound") == s.genesis.call("roundOf", token) == expected
        block = s.genesis.call("blockOf", expected)
        assert DELAY <= block - s.world.number < DELAY + ROUND
        assert (block + 1 - DELAY - first) % ROUND == 0
        s.world.mine()


def test_all_tokens_of_a_round_are_revealed_at_once(s: Launched) -> None:
    first = s.mint(2)
    s.world.mine(ROUND)
    second = s.mint(2, s.bob)
    assert s.genesis.call("hiddenRounds", 0, 3) == (0, 1)
    with refused("NotRevealed", 0, 0):
        s.genesis.call("seedOf", 0)
    s.reveal(0)
    assert s.genesis.call("hiddenRounds", 0, 3) == (1,)
    for token in first:
        assert s.genesis.call("seedOf", token) == drawn(s, token)
    for token in second:
        for function in ("seedOf", "traitsOf", "render"):
            with refused("NotRevealed", token, 1):
                s.genesis.call(function, token)
    s.reveal(1)
    assert s.genesis.call("hiddenRounds", 0, 3) == ()


def test_nobody_can_reveal_before_the_block(s: Launched) -> None:
    s.mint()
    block = s.genesis.call("blockOf", 0)
    header = s.world.header(s.world.number - 1)
    for number in (s.world.number, block - 1, block):
        s.world.mine_to(number)
        with refused("BlockToCome", block):
            s.genesis.send("reveal", [0], [header], sender=s.owner)


def test_rounds_whose_blocks_no_chain_reaches(s: Launched) -> None:
    """The number of the block would not fit into 256 bits, or nearly so."""
    last = 2**64 - 1
    assert s.genesis.call("blockOf", last) == s.genesis.call("blockOf", 0) + 32 * last
    with refused("BlockToCome", s.genesis.call("blockOf", last)):
        s.genesis.send("reveal", [last], [b""])
    for round_ in (last + 1, 2**251 - 6, 2**251, 2**256 - 1):
        with refused("RoundTooLarge", round_, last):
            s.genesis.call("blockOf", round_)
        with refused("RoundTooLarge", round_, last):
            s.genesis.send("reveal", [round_], [b""])


def test_only_the_header_of_the_block_counts(s: Launched) -> None:
    s.mint()
    block = s.genesis.call("blockOf", 0)
    s.world.mine_to(block + 300)
    right = s.world.header(block)
    rng = random.Random(1)
    wrong = [s.world.header(number) for number in (block - 1, block + 1)] + [b"", right[:-1], right + b"\0"]
    for _ in range(20):
        place = rng.randrange(len(right))
        wrong.append(right[:place] + bytes([right[place] ^ (1 << rng.randrange(8))]) + right[place + 1 :])
    for header in wrong:
        with refused("WrongHeader", block, keccak(right), keccak(header)):
            s.genesis.send("reveal", [0], [header])
    for rounds, headers in (([0], []), ([], [right]), ([0, 0], [right])):
        with refused("AsManyHeadersAsRounds", len(headers), len(rounds)):
            s.genesis.send("reveal", rounds, headers)
    s.genesis.send("reveal", [0], [right])


def test_who_reveals_and_when_makes_no_difference(s: Launched) -> None:
    """Delays of any length, different callers: the seed is the same."""
    s.mint()
    block = s.genesis.call("blockOf", 0)
    seeds = set()
    for delay, caller in ((257, s.alice), (258, s.owner), (1000, s.bob), (8000, s.alice), (8191, s.bob)):
        with s.world.attempt():
            s.world.mine_to(block + delay)
            s.genesis.send("reveal", [0], [s.world.header(block)], sender=caller)
            seeds.add(s.genesis.call("seedOf", 0))
    assert seeds == {drawn(s, 0)}


def test_a_second_reveal_changes_nothing(s: Launched) -> None:
    s.mint()
    s.reveal(0)
    before = s.genesis.call("seedOf", 0)
    block = s.genesis.call("blockOf", 0)
    for header in (s.world.header(block), s.world.header(block + 1), b""):
        receipt = s.genesis.send("reveal", [0], [header], sender=s.alice)
        assert receipt.events == []
    # so nobody makes the reveal of several rounds fail by being first with one of them
    s.mint(sender=s.bob)
    late = s.genesis.call("currentRound")
    block = s.genesis.call("blockOf", late)
    s.world.mine_to(block + 300)
    s.genesis.send("reveal", [0, late], [b"", s.world.header(block)])
    assert s.genesis.call("seedOf", 0) == before
    assert s.genesis.call("seedOf", 1) == drawn(s, 1)


def test_a_round_that_is_forgotten_is_proven_by_headers(s: Launched) -> None:
    """More than a day late: the seed is the same, it only takes more headers."""
    s.mint()
    block = s.genesis.call("blockOf", 0)
    s.world.mine_to(block + HISTORY_LENGTH + 90)
    with refused("BlockForgotten", block):
        s.genesis.send("reveal", [0], [s.world.header(block)])
    newest = block + 95
    # a part of the way, by anyone; each is checked
    headers = [s.world.header(number) for number in range(newest, newest - 60, -1)]
    with refused("WrongHeader"):
        s.genesis.send("keepHash", newest, headers[1:])
    with refused("WrongHeader"):
        s.genesis.send("keepHash", newest, headers[:20] + headers[21:])
    with refused("BlockForgotten", newest - 60):
        s.genesis.send("keepHash", newest - 60, [])
    s.genesis.send("keepHash", newest, headers, sender=s.bob)
    assert s.genesis.call("hashOf", newest - 60) == keccak(s.world.header(newest - 60))
    # the rest later, when the first block is forgotten too
    s.world.mine(200)
    rest = [s.world.header(number) for number in range(newest - 60, block, -1)]
    receipt = s.genesis.send("keepHash", newest - 60, rest, sender=s.alice)
    assert receipt.events == [("HashKept", {"blockNumber": block, "hash": keccak(s.world.header(block))})]
    s.genesis.send("reveal", [0], [s.world.header(block)])
    assert s.genesis.call("seedOf", 0) == drawn(s, 0)


def test_a_hash_can_be_kept_before_it_is_forgotten(s: Launched) -> None:
    s.mint()
    block = s.genesis.call("blockOf", 0)
    with refused("BlockToCome", block):
        s.genesis.send("keepHash", block, [])
    s.world.mine_to(block + 300)
    s.genesis.send("keepHash", block, [])
    s.world.mine(HISTORY_LENGTH)
    s.genesis.send("reveal", [0], [s.world.header(block)])
    assert s.genesis.call("seedOf", 0) == drawn(s, 0)


def test_a_chain_without_randomness_says_so(s: Launched, monkeypatch: pytest.MonkeyPatch) -> None:
    s.mint()
    monkeypatch.setattr(s.world, "randomness", lambda number: bytes(32))
    block = s.genesis.call("blockOf", 0)
    with refused("NoRandomness", block):
        s.reveal(0)


#: Place of PREVRANDAO among the fields of a header.
PREV_RANDAO = 13


def test_the_hash_of_the_block_is_no_part_of_the_seed(s: Launched) -> None:
    """A proposer can try any number of hashes: headers that differ in any field but PREVRANDAO give the same seed."""
    s.mint()
    block = s.genesis.call("blockOf", 0)
    s.world.mine_to(block + 300)
    right = rlp.decode(s.world.header(block))
    hashes, seeds = set(), {}
    for place, field in enumerate(right):
        # another value in as many bytes; a field without bytes gets some
        other = bytes(byte ^ 0x15 for byte in field) or b"\x07"
        header = rlp.encode([*right[:place], other, *right[place + 1 :]])
        with s.world.attempt():
            # a chain on which this is the header of the block
            s.world.of(HISTORY).storage[block % HISTORY_LENGTH] = int.from_bytes(keccak(header), "big")
            assert s.genesis.call("hashOf", block) == keccak(header)
            s.genesis.send("reveal", [0], [header])
            randomness = s.genesis.call("randomnessOf", 0)
            assert randomness == rlp.decode(header)[PREV_RANDAO] != keccak(header)
            seeds[place] = s.genesis.call("seedOf", 0)
        hashes.add(keccak(header))
    assert len(hashes) == len(seeds) == 21
    assert seeds.pop(PREV_RANDAO) != drawn(s, 0)
    assert set(seeds.values()) == {drawn(s, 0)}


def test_headers_of_another_form_give_no_randomness(s: Launched) -> None:
    """A fork that changed headers altogether must not lead to seeds made of something else."""

    def header(randomness: int = 32, bloom: int = 256) -> bytes:
        before: list[bytes | int] = [*[bytes(32)] * 2, bytes(20), *[bytes(32)] * 3, bytes(bloom), 0, 1, 2, 3, 4, b""]
        return bytes(rlp.encode([*before, b"\x55" * randomness, bytes(8)]))

    s.mint()
    block = s.genesis.call("blockOf", 0)
    s.world.mine_to(block + 300)
    # a randomness of 31 and of 33 bytes, a short bloom filter, a list, and an end within the randomness
    others = header(31), header(33), header(bloom=100), b"\xf9\x02\x00" + b"\xc0" * 600
    for other in (*others, header()[: header().index(b"\x55") + 31]):
        s.world.of(HISTORY).storage[block % HISTORY_LENGTH] = int.from_bytes(keccak(other), "big")
        with refused("NotAHeader"):
            s.genesis.send("reveal", [0], [other])
    assert s.genesis.call("randomnessOf", 0) == bytes(32)


@pytest.mark.parametrize("while_it_arrives", [False, True])
def test_mint_look_and_revert_does_not_work(s: Launched, while_it_arrives: bool) -> None:
    """The seed is not there to be looked at in the transaction of the mint."""
    looker = s.world.deploy(adversary("Looker"))
    data = looker.encode("mintAndLook", (s.genesis, while_it_arrives))[1]
    for _ in range(8):
        with refused("NotRevealed"):
            s.world.run(s.alice, looker.address, data, PRICE, 10**8, True, s.genesis.abi)
        s.world.mine()


def test_what_a_hidden_token_shows_says_nothing_of_its_seed(s: Launched) -> None:
    """The same in two worlds whose blocks to come differ."""
    shown = []
    for salt in ("one", "another"):
        world = launched()
        world.world.salt = salt
        world.mint(3)
        shown.append([world.genesis.call("tokenURI", token) for token in range(3)])
        world.reveal(0)
        shown[-1].append(world.genesis.call("seedOf", 0))
    assert shown[0][:3] == shown[1][:3]
    assert shown[0][3] != shown[1][3]


def test_seeds_without_a_piece_are_passed_over(s: Launched) -> None:
    for number in (253, 308884):
        bad = keccak(f"seed-{number}".encode())
        with pytest.raises(Refused):
            s.generator.call("render", bad)
        seed, traits = s.metadata.call("settle", bad)
        assert seed == keccak(bad)
        assert traits == s.generator.call("traits", seed)
        assert len(s.metadata.call("tokenURI", 0, bad)) > 10_000


def test_too_little_gas_leads_to_no_other_seed(s: Launched) -> None:
    """The generator runs out of gas in the middle: that must not be taken for a seed without a piece."""
    seed = keccak(b"seed")
    settled, _ = s.metadata.call("settle", seed)
    needed = s.metadata.gas_of("settle", seed)
    for gas in range(30_000, needed + needed // 32, needed // 40):
        try:
            found, _ = s.metadata.call("settle", seed, gas=gas)
        except Refused:
            continue
        assert found == settled


def test_the_gas_of_a_reveal_does_not_grow_with_its_tokens(s: Launched) -> None:
    with s.world.attempt():
        s.mint()
        s.world.mine_to(s.genesis.call("blockOf", 0) + 300)
        header = s.world.header(s.genesis.call("blockOf", 0))
        few = s.genesis.send("reveal", [0], [header]).gas
    for _ in range(40):
        s.mint(10)
    s.world.mine_to(s.genesis.call("blockOf", 0) + 300)
    assert abs(s.genesis.send("reveal", [0], [header]).gas - few) < 500
