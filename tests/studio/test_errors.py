"""Whoever has the ABI of a contract can decode whatever it reverts with."""

from __future__ import annotations

from functools import cache

import pytest
from Crypto.Hash import keccak

from shackled.artifacts import artifact, contracts

#: All custom errors of all contracts, and that of the library that creates what is kept.
KNOWN = {selector: name for contract in contracts() for selector, (name, _) in artifact(contract).errors.items()}

#: Errors that a contract does not pass on to those that call it: a guard of the build, which no scene reaches, and what
#: is wrong with the arguments of `eulerRotation`, which no other contract calls.
KEPT_BACK = ("RegistersOverlap", "AngleOutOfRange")


def odd(number: int) -> int:
    """Without the zeros at its end: the compiler may push a constant without them, and shift it."""
    return number // (number & -number or 1)


def constants(code: bytes) -> set[int]:
    """The odd parts of all that the instructions push."""
    found, at = set(), 0
    while at < len(code):
        size = code[at] - 0x5F if 0x60 <= code[at] <= 0x7F else 0
        found.add(odd(int.from_bytes(code[at + 1 : at + 1 + size], "big")))
        at += 1 + size
    return found


@cache
def raised(contract: str) -> dict[bytes, str]:
    """The errors of a contract and of those that it calls: their selectors stand in the code."""
    pushed = constants(artifact(contract).runtime)
    found = {selector: name for selector, name in KNOWN.items() if odd(int.from_bytes(selector, "big")) in pushed}
    for part in artifact(contract).parts:
        found |= {selector: name for selector, name in raised(part).items() if name not in KEPT_BACK}
    return found


def test_errors_are_found_in_the_code() -> None:
    assert {"IndexOutOfRange"} <= set(raised("Engine").values())
    assert {"CanvasSize", "OutOfGas", "IndexOutOfRange", "NoViewDirection"} <= set(raised("Renderer").values())
    assert {"NothingKept", "PixelScaleOutOfRange", "DeploymentFailed", "CanvasSize"} <= set(raised("Studio").values())
    digest = keccak.new(digest_bits=256, data=b"DeploymentFailed()").digest()
    assert digest[:4] in raised("Studio")


@pytest.mark.parametrize(
    "contract", ["Engine", "Renderer", "Original", "Genesis", "PngEncoder", "Studio", "IconsCollection", "Editions"]
)
def test_every_error_is_in_the_abi(contract: str) -> None:
    """With names for all its values."""
    errors = artifact(contract).errors
    assert raised(contract).items() <= {selector: name for selector, (name, _) in errors.items()}.items()
    assert all(label for _, parameters in errors.values() for label, _ in parameters)
