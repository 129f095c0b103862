"""The preview of contracts of a few instructions: which tokens are read, and what is said of them."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pytest

from preview.small_contracts import DEAR, ENDLESS, REVERT, SVG, Made, answering, contract, drawing, function, output
from shackled import load
from shackled.chain import open_chain
from shackled.ethereum._encoding import keccak256, word
from shackled.evm._instance import Answer
from shackled.preview._arguments import Call
from shackled.preview._preview import Preview, Request, Token
from shackled.preview._project import Compiled
from shackled.preview._report import folded
from shackled.preview._world import World, in_units
from shackled.scene._codec import render_call

PANIC = bytes.fromhex("4e487b71")
SUPPLY = function("totalSupply", output="uint256")


@pytest.fixture
def preview(tmp_path: Path) -> Any:
    """Make a preview of a contract."""
    source = tmp_path / "Small.sol"
    source.write_text("contract Small {}")

    def make(found: Compiled, **request: Any) -> Preview:
        return Preview(Made(source, found), Request(**request))

    return make


def error(words: str) -> bytes:
    """Return what `revert` sends with words."""
    return bytes.fromhex("08c379a0") + output(words)


@pytest.mark.parametrize(
    ("data", "first"),
    [
        (b"", 1),
        (error("ERC721: invalid token ID"), 1),
        (keccak256(b"TokenDoesNotExist()")[:4], 1),
        (error("locked"), 0),
        (PANIC + word(0x11), 0),
    ],
)
def test_token_0_is_left_out_only_where_it_is_missing(preview: Any, data: bytes, first: int) -> None:
    entry = {"type": "error", "name": "TokenDoesNotExist", "inputs": []}
    found = contract(answering(data, output(SVG), REVERT), function("image", "uint256"), entry)
    assert preview(found).first == first


def test_token_0_is_shown_where_it_is_too_expensive(preview: Any) -> None:
    """A call inside runs out of gas, and the contract reverts without a reason, as for a token that does not exist."""
    answer = output(SVG)
    size = len(answer).to_bytes(2, "big").hex()
    # without data, 17.6 million gas are used; for 0 such a call is made, and its failure is passed on without data
    starts, tries = "3615602557" + "600435601857", "5f5f5f5f305afa" + "601857" + "5f5ffd"
    code = bytes.fromhex(starts + tries + f"5b61{size}602e5f3961{size}5ff3" + "5b") + DEAR
    assert code.index(DEAR) == 0x26
    made = preview(contract(code + answer), count=2)
    (problem,) = made.token(0).problems
    assert (made.first, made.token(1).problems) == (0, [])
    assert problem.startswith("image(0) takes 17,")


@pytest.mark.parametrize(("supply", "count"), [(16, 16), (10_000, 256), (0, 256)])
def test_as_many_tokens_as_there_are(preview: Any, supply: int, count: int) -> None:
    # `totalSupply` is a call without a number, which reads as 0
    found = contract(answering(word(supply), output(SVG)), function("image", "uint256"), SUPPLY)
    assert preview(found).count == count
    assert preview(found, count=3).count == 3


def test_first_tokens_up_to_the_greatest_number(preview: Any) -> None:
    found = contract(answering(output(SVG), output(SVG)))
    last = (1 << 256) - 1
    assert [token.number for token in preview(found, first=last).tokens()] == [last]
    with pytest.raises(ValueError, match=r"the first token must be from 0 to 2\^256 - 1"):
        preview(found, first=last + 1)


@pytest.mark.parametrize(
    ("data", "ends", "problem"),
    [
        (PANIC + word(0x11), REVERT, "image(0) fails: arithmetic overflow (Panic 0x11)"),
        (PANIC + word(0x99), REVERT, "image(0) fails: panic (Panic 0x99)"),
        (b"", REVERT, "image(0) fails: reverted without a reason"),
        (b"", 0xF3, "image(0) returns nothing"),
        (output(b"a\xff"), 0xF3, "image(0) returns no valid UTF-8: byte 1 is 0xff"),
        (b"\1", 0xF3, "image(0) returns 1 bytes that are not text or bytes as the ABI encodes them"),
    ],
)
def test_outputs_that_cannot_be_read(preview: Any, data: bytes, ends: int, problem: str) -> None:
    assert preview(contract(answering(data, zero_ends=ends)), first=0).token(0).problems == [problem]


@pytest.mark.parametrize(
    ("error", "values", "said"),
    [
        ("CoefficientOutOfRange(uint256,int256)", (1, (4 << 32) + 1), "(object=1, value=4.00000000023)"),
        ("ScaleOutOfRange(uint256,int256)", (0, -1 << 32), "ScaleOutOfRange(object=0, scale=-1)"),
        ("FogOutOfRange(int256,int256)", (900 << 32, 100 << 32), "FogOutOfRange(near=900, far=100)"),
        ("OpacityOutOfRange(uint256,uint256)", (0, 3 << 23), "OpacityOutOfRange(object=0, opacity=1.5)"),
        ("ExposureOutOfRange(uint256)", (129 << 15,), "ExposureOutOfRange(exposure=64.5)"),
        (
            "PositionOutOfRange(uint256,int256,int256,int256)",
            (2, 1 << 60, 0, -(1 << 59)),
            "x=268435456, y=0, z=-134217728)",
        ),
        ("ScaleLooksUnscaled(uint256,int256)", (0, 2), "ScaleLooksUnscaled(object=0, scale=2)"),
        ("CanvasSize(uint256,uint256)", (0, 4096), "CanvasSize(width=0, height=4096)"),
    ],
)
def test_quantities_of_errors(preview: Any, error: str, values: tuple[int, ...], said: str) -> None:
    """In units, where the contracts of the package have fixed-point numbers."""
    data = keccak256(error.encode())[:4] + b"".join(word(value % (1 << 256)) for value in values)
    (problem,) = preview(contract(answering(data, zero_ends=REVERT)), first=0).token(0).problems
    assert problem.startswith("image(0) fails: ")
    assert problem.endswith(said)
    # of the scene builder, whose errors are in the author's contract
    assert in_units("PositionOutOfRange(x=40000, y=0, z=0)") == "PositionOutOfRange(x=40000, y=0, z=0)"


def test_a_precompiled_contract_that_is_missing(preview: Any) -> None:
    # STATICCALL of the contract 2
    code = bytes.fromhex("5f5f5f5f60025afa00")
    (problem,) = preview(contract(code)).token(0).problems
    assert problem == f"image(0) fails: the precompiled contract 0x{word(2)[12:].hex()} is not part of this EVM"


def test_an_endless_loop_takes_its_time_once(preview: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.preview._preview.MOST_GAS", 1 << 26)
    made = preview(contract(ENDLESS), max_gas=1 << 20)
    allowed: list[int] = []
    call = made.world.call

    def counted(data: bytes, gas: int) -> Answer:
        allowed.append(gas)
        answer: Answer = call(data, gas)
        return answer

    monkeypatch.setattr(made.world, "call", counted)
    problems = [made.token(number).problems[0] for number in range(4)]
    assert "is there an endless loop?" in problems[0]
    assert problems[3] == "image(3) fails: more than 1,048,576 gas are needed"
    assert allowed.count(1 << 26) == 1


def test_transactions_that_take_more_gas_than_one_may(preview: Any) -> None:
    found = contract(DEAR, function("image", "uint256"), function("big"))
    (problem,) = preview(found, setup=("big()",)).problems
    assert problem.startswith("the call big() takes 17,")
    assert problem.endswith("gas, more than 16,777,216, the most of one transaction")
    (problem,) = preview(Compiled("Dear", found.abi, DEAR)).problems
    assert problem.startswith("the deployment of Dear takes 17,")
    assert preview(contract(answering(output(SVG)))).problems == []


def test_each_transaction_has_a_block_of_its_own(preview: Any) -> None:
    # without data it stores NUMBER, TIMESTAMP and PREVRANDAO in slots 0 to 2; with a number it returns that slot
    code = bytes.fromhex("3660105743 5f55 42600155 44600255 00 5b 600435 54 5f52 60205ff3".replace(" ", ""))
    first, second = (World(contract(code), setup=[Call(b"", 0, times, "write")]) for times in (1, 2))

    def kept(world: World) -> list[int]:
        return [int.from_bytes(world.call(bytes(4) + word(slot)).output, "big") for slot in range(3)]

    (number, seconds, random), (later, more_seconds, other) = kept(first), kept(second)
    assert later == number + 1 > 256
    assert 10 <= more_seconds - seconds <= 14
    assert abs(seconds - time.time()) < 120
    assert 0 != random != other
    assert kept(World(contract(code), setup=[Call(b"", 0, 1, "write")]))[2] == random


def test_a_hint_where_no_token_can_be_read(preview: Any) -> None:
    made = preview(contract(answering(b"", b"", REVERT), function("image", "uint256")), first=0, count=1)
    assert "`setup`" in made.hint(list(made.tokens()))
    assert made.hint([Token(0, gas=1)]) is None


def test_faces_that_miss_the_quick_path_are_a_note(preview: Any) -> None:
    entry = function("image", "uint256", output="bytes")
    for specular, notes in (
        (0, []),
        (0.08, ["of 12 faces, these miss the quick path of effects: 12 because of a highlight of 8 percent"]),
    ):
        scene = load("cube", size=16, shading="flat", color="tan", specular=specular, hemisphere="white")
        made = preview(contract(drawing(render_call(scene), open_chain().address("Renderer")), entry), count=2)
        token = made.token(0)
        assert (token.problems, token.notes) == ([], notes)
        # the renderer draws again afterwards
        assert made.token(0).gas == token.gas
        assert folded([token], "notes") == [("0", note) for note in notes]
    # pictures of others have none
    assert preview(contract(answering(output(SVG), output(SVG)))).token(0).notes == []


def test_equal_problems_of_many_tokens_are_one_line() -> None:
    tokens = [Token(number, problems=[f"image({number}) fails: No(id={number})"]) for number in (3, 4, 5, 9, 16)]
    tokens += [
        Token(number, problems=[f"image({number}) takes {number}6,777,217 gas", "no name"]) for number in (16, 17)
    ]
    assert folded(tokens) == [
        ("3 to 5, 9, 16", "image(3) fails: No(id=3); the others alike"),
        ("16 to 17", "image(16) takes 166,777,217 gas; the others alike"),
        ("16 to 17", "no name"),
    ]
    (line,) = folded([Token(number, problems=["no"]) for number in range(0, 100, 2)])
    assert line[0].endswith("36, 38 and 30 more")
