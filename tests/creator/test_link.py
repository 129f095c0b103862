"""Links: any state there and back, and nothing of strangers that does harm."""

from __future__ import annotations

import base64
import json
import re
import zlib
from contextlib import suppress

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shackled import InputError
from shackled.creator import LINK_DICTIONARY, MAX_LINK, Orbit, Source, State, from_link, to_link
from states import states


@settings(deadline=None)
@given(states())
def test_a_link_restores_the_state(state: State) -> None:
    text = to_link(state)
    assert from_link(text) == state
    assert re.fullmatch("[0-9A-Za-z_-]+", text)
    assert len(text) < MAX_LINK


def test_links_are_short() -> None:
    assert len(to_link(State(Source("piece", "teapot")))) < 12
    turned = State(Source("piece", "icons/coin"), camera=Orbit((0.1, 0.2, 0.0), 5.3, 33.5, 12.25, fov=22.6199))
    assert len(to_link(turned)) < 110


def packed(document: object) -> str:
    squeezer = zlib.compressobj(9, zlib.DEFLATED, -15, zdict=LINK_DICTIONARY)
    data = squeezer.compress(json.dumps(document).encode()) + squeezer.flush()
    return "1" + base64.urlsafe_b64encode(data).decode().rstrip("=")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the link has characters that are not allowed"),
        ("1", "the link is damaged"),
        ("1A", "the link is damaged"),
        ("<script>", "the link has characters that are not"),
        ("1\N{ARABIC-INDIC DIGIT ONE}", "the link has characters that are not"),
        (
            "9" + to_link(State(Source("piece", "teapot")))[1:],
            "the link is damaged or of another version: it begins with '9'",
        ),
        (to_link(State(Source("piece", "teapot")))[:-2], "the link is damaged"),
        (to_link(State(Source("piece", "teapot"))) + "AAAA", "the link is damaged"),
        ("1" + "A" * 5000, "the link is too long: 5,001 characters, at most 4,096 are read"),
        (packed([1]), "the link does not describe a picture: the state must be a table, not [1]"),
        (
            packed({"source": {"kind": "piece", "name": "<b>"}}),
            "the link does not describe a picture: the name of a source must",
        ),
        (packed("[" * 3000), "the link does not describe a picture: the state must be a table"),
        (packed({"source": "A" * 1_000_000}), "the link holds more than 8,192 bytes"),
        (
            packed({"source": {"kind": "piece", "name": "teapot"}, "camera": {"fov": 1e999}}),
            "to 179.8, not inf",
        ),
    ],
)
def test_hostile_links_are_refused(text: str, message: str) -> None:
    with pytest.raises(InputError) as error:
        from_link(text)
    assert message in str(error.value)
    assert len(str(error.value)) < 400


@given(
    st.text(alphabet="ABCDEFabcdef0123456789_-", max_size=200) | st.binary(max_size=200).map(lambda b: packed(str(b)))
)
def test_no_text_is_too_strange(text: str) -> None:
    with suppress(InputError):
        assert isinstance(from_link("1" + text), State)


def test_brackets_without_end_are_no_crash() -> None:
    squeezer = zlib.compressobj(9, zlib.DEFLATED, -15, zdict=LINK_DICTIONARY)
    data = squeezer.compress(b"[" * 8000) + squeezer.flush()
    with pytest.raises(InputError, match="damaged"):
        from_link("1" + base64.urlsafe_b64encode(data).decode().rstrip("="))
