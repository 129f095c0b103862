"""What a token shows, read as a marketplace does; and transactions that a contract refuses."""

from __future__ import annotations

import base64
import io
import json
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image as PillowImage
from tools.tokens.world import GAS, Contract, Receipt, Refused

#: How descriptions end.
INDEPENDENT = "Not by the authors of the Shackled contracts of 2021, nor endorsed by them."


def document(uri: str) -> dict[str, Any]:
    """The JSON of a `data:` URI."""
    head, _, text = uri.partition(",")
    assert head == "data:application/json;base64"
    found = json.loads(base64.b64decode(text, validate=True).decode("utf-8"))
    assert isinstance(found, dict)
    return found


def pixels(uri: str) -> NDArray[np.uint8]:
    """The pixels of the PNG of a `data:` URI."""
    head, _, text = uri.partition(",")
    assert head == "data:image/png;base64"
    with PillowImage.open(io.BytesIO(base64.b64decode(text, validate=True))) as picture:
        picture.load()
        assert picture.format == "PNG"
        return np.asarray(picture.convert("RGB"))


def traits(found: dict[str, Any]) -> dict[str, Any]:
    """The attributes by their names; each is a name with a value."""
    assert all(set(each) - {"display_type"} == {"trait_type", "value"} for each in found["attributes"])
    return {each["trait_type"]: each["value"] for each in found["attributes"]}


@contextmanager
def refused(name: str, *values: Any) -> Iterator[None]:
    """Expect an error of a contract by its name, with these values if any are given."""
    with pytest.raises(Refused) as caught:
        yield
    assert caught.value.name == name, caught.value
    if values:
        assert caught.value.values == values


def execute(by: Contract, to: Contract, function: str, *arguments: Any, sender: str, value: int = 0) -> Receipt:
    """Have a contract call another one, whose errors it passes on."""
    data = by.encode("execute", (to, to.encode(function, arguments)[1]))[1]
    return by.world.run(sender, by.address, data, value, GAS, True, to.abi)


def succeeds(possible: bool, contract: Contract, function: str, *arguments: Any, sender: str, value: int = 0) -> bool:
    """Send a transaction, and return whether it succeeded; that must be whether it is possible."""
    try:
        contract.send(function, *arguments, sender=sender, value=value)
    except Refused:
        assert not possible, function
        return False
    assert possible, function
    return True
