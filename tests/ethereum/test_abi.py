"""Calls, answers and errors as the ABI has them."""

from __future__ import annotations

from typing import Any

import pytest
from eth_abi import abi
from eth_abi.exceptions import DecodingError
from hypothesis import given
from hypothesis import strategies as st

from shackled.artifacts import known_errors
from shackled.chain._failures import describe_revert
from shackled.errors import InputError
from shackled.ethereum._abi import SOLIDITY_ERRORS, Interface, decode_error, decode_values, encode_values, error_table
from shackled.ethereum._encoding import keccak256, word

# the examples of the specification of the ABI: docs.soliditylang.org/en/latest/abi-spec.html
FOO = Interface(
    [
        {"type": "constructor", "inputs": [{"name": "a", "type": "uint256"}]},
        {
            "type": "function",
            "name": "baz",
            "inputs": [{"name": "x", "type": "uint32"}, {"name": "y", "type": "bool"}],
            "outputs": [{"name": "r", "type": "bool"}],
        },
        {
            "type": "function",
            "name": "sam",
            "inputs": [{"type": "bytes"}, {"type": "bool"}, {"type": "uint256[]"}],
            "outputs": [{"type": "uint256"}, {"type": "uint256"}],
        },
        {
            "type": "function",
            "name": "say",
            "inputs": [{"name": "it", "type": "string"}],
            "outputs": [{"type": "string"}],
        },
    ]
)


def test_the_examples_of_the_specification() -> None:
    assert FOO.encode("baz", 69, True) == bytes.fromhex("cdcd77c0") + word(69) + word(1)
    assert FOO.encode("sam(bytes,bool,uint256[])", b"dave", True, [1, 2, 3])[:4] == bytes.fromhex("a5643bf2")
    assert FOO.construct(7) == word(7)
    # one value is itself, several are a tuple
    assert FOO.decode("baz", word(0)) is False
    assert FOO.decode("sam", word(5) + word(6)) == (5, 6)


@pytest.mark.parametrize(
    ("function", "answer"),
    [("baz", b""), ("sam", word(5)), ("baz", word(2)), ("say", word(32) + word(1) + b"\xff" + bytes(31))],
)
def test_an_answer_of_another_kind_is_refused(function: str, answer: bytes) -> None:
    with pytest.raises(ValueError, match=rf"^{len(answer)} bytes are not an output of {function}: "):
        FOO.decode(function, answer)


def test_values_that_do_not_fit_are_named() -> None:
    for encode, values, words in (
        (FOO.encode, ("baz", 2**32, True), "x of baz must be a uint32, not 4294967296"),
        (FOO.encode, ("baz", 1, "yes"), "y of baz must be a bool, not 'yes'"),
        (FOO.encode, ("say", "\ud800"), r"it of say must be a string, not '\\ud800'"),
        (FOO.construct, (-1,), "a of the constructor must be a uint256, not -1"),
    ):
        with pytest.raises(InputError, match=f"^{words}$"):
            encode(*values)


def test_errors_of_solidity_itself() -> None:
    text = bytes.fromhex("08c379a0") + word(32) + word(5) + b"wrong" + bytes(27)
    assert decode_error(text, SOLIDITY_ERRORS) == ("Error", {"message": "wrong"})
    assert describe_revert(text[:68] + b"\xff" + bytes(31)) == "\ufffd" + "\0" * 4
    assert decode_error(bytes.fromhex("4e487b71") + word(0x11), SOLIDITY_ERRORS) == ("Panic", {"code": 0x11})
    # cut, or unknown
    for data in (b"", b"\x08\xc3", bytes.fromhex("4e487b71") + bytes(31), b"\1\2\3\4" + word(1)):
        assert decode_error(data, known_errors()) is None


def test_errors_with_structs_and_values_without_names() -> None:
    inner = {"name": "", "type": "tuple", "components": [{"name": "", "type": "bytes2"}]}
    those = {"name": "those", "type": "tuple[]", "components": [{"name": "", "type": "uint8"}, inner]}
    table = error_table([{"type": "error", "name": "Odd", "inputs": [{"name": "", "type": "address"}, those]}])
    assert list(table) == [keccak256(b"Odd(address,(uint8,(bytes2))[])")[:4]]
    data = word(b"\x77" * 20) + word(64) + word(1) + word(7) + b"ab".ljust(32, b"\0")
    assert describe_revert(next(iter(table)) + data, table) == f"Odd(address=0x{20 * '77'}, those=((7, (0x6162))))"


def kinds(depth: int = 2) -> st.SearchStrategy[tuple[str, st.SearchStrategy[Any]]]:
    """Types, each with its values."""
    sizes = st.integers(1, 32)
    plain = st.one_of(
        sizes.map(lambda n: (f"uint{8 * n}", st.integers(0, 2 ** (8 * n) - 1))),
        sizes.map(lambda n: (f"int{8 * n}", st.integers(-(2 ** (8 * n - 1)), 2 ** (8 * n - 1) - 1))),
        sizes.map(lambda n: (f"bytes{n}", st.binary(min_size=n, max_size=n))),
        st.sampled_from(
            [
                ("bool", st.booleans()),
                ("bytes", st.binary(max_size=70)),
                ("string", st.text(max_size=40)),
                ("address", st.binary(min_size=20, max_size=20).map(lambda each: f"0x{each.hex()}")),
            ]
        ),
    )
    if not depth:
        return plain
    below = kinds(depth - 1)
    return st.one_of(
        plain,
        below.map(lambda each: (f"{each[0]}[]", st.lists(each[1], max_size=3).map(tuple))),
        st.tuples(below, st.integers(1, 3)).map(
            lambda each: (f"{each[0][0]}[{each[1]}]", st.tuples(*[each[0][1]] * each[1]))
        ),
        st.lists(below, min_size=1, max_size=3).map(
            lambda each: (f"({','.join(kind for kind, _ in each)})", st.tuples(*(values for _, values in each)))
        ),
    )


@given(st.lists(kinds(), max_size=4), st.data())
def test_values_are_those_of_eth_abi(chosen: list[tuple[str, st.SearchStrategy[Any]]], draw: st.DataObject) -> None:
    types = [kind for kind, _ in chosen]
    values = tuple(draw.draw(each) for _, each in chosen)
    data = abi.encode(types, values)
    assert encode_values(types, values) == data
    assert decode_values(types, data) == values
    if data:
        with pytest.raises(ValueError, match=r"bytes end before byte|do not hold"):
            decode_values(types, data[: draw.draw(st.integers(0, len(data) - 1))])


@given(kinds(), st.data())
def test_damaged_data_are_read_as_eth_abi_reads_them(
    chosen: tuple[str, st.SearchStrategy[Any]], draw: st.DataObject
) -> None:
    kind, values = chosen
    data = bytearray(abi.encode([kind], [draw.draw(values)]))
    at = draw.draw(st.integers(0, len(data) - 1))
    data[at] ^= draw.draw(st.integers(1, 255))
    try:
        expected = abi.decode([kind], bytes(data))
    except (DecodingError, OverflowError, UnicodeDecodeError):
        with pytest.raises(ValueError, match=r"not|end"):
            decode_values([kind], bytes(data))
    else:
        assert decode_values([kind], bytes(data)) == expected
