"""What an error for too little gas says would be enough."""

from __future__ import annotations

import re
from typing import Any

import pytest

from shackled import load, render
from shackled.chain._embedded import RevmChain
from shackled.errors import OutOfGasError
from shackled.gas import measure

LOOK: dict[str, Any] = {"size": 96, "antialias": True, "shading": "smooth"}


@pytest.fixture
def said() -> Any:
    """Returns the settings that an error names as enough, with their gas."""

    def told(**where: Any) -> dict[str, dict[str, Any]]:
        with pytest.raises(OutOfGasError) as caught:
            render("teapot", **LOOK, **where)
        named = re.findall(r"`(\w+)=(\w+)` \(([\d,]+)\)", str(caught.value))
        return {name: {"value": value, "gas": int(gas.replace(",", ""))} for name, value, gas in named}

    return told


def test_what_is_enough_for_a_call(said: Any) -> None:
    limit = measure(load("teapot", **LOOK)).gas - 100_000
    found = said(on=RevmChain(limit))
    assert list(found) == ["antialias", "shading", "size", "max_triangles"]
    for name, told in found.items():
        value = told["value"]
        look = {**LOOK, name: int(value) if value.isdecimal() else value != "False" and value}
        assert render("teapot", **look, on=RevmChain(limit)).gas == told["gas"] < limit


def test_what_is_enough_for_a_tile(said: Any) -> None:
    """Which depends on no size."""
    found = said(gas_limit=900_000)
    assert "max_triangles" in found
    assert "size" not in found
    assert all(told["gas"] < 900_000 for told in found.values())
    assert said(gas_limit=60_000) == {}
