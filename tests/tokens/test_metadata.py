from __future__ import annotations

import base64
import io
import json
from typing import Any

import numpy as np
import pytest
from PIL import Image as PillowImage

from shackled.errors import VerificationError
from shackled.tokens._metadata import MAX_LENGTH, read_data_uri, read_token_uri

PIXELS = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)


def picture(kind: str = "png", pixels: np.ndarray[Any, Any] = PIXELS) -> bytes:
    stream = io.BytesIO()
    PillowImage.fromarray(pixels).save(stream, kind)
    return stream.getvalue()


def data_uri(media_type: str, content: bytes) -> str:
    return f"data:{media_type};base64,{base64.b64encode(content).decode()}"


def token(**changes: Any) -> str:
    document = {
        "name": "Genesis #7",
        "description": "A picture.",
        "attributes": [
            {"trait_type": "Structure", "value": "Ring"},
            {"display_type": "number", "trait_type": "Prisms", "value": 12},
        ],
        "image": data_uri("image/png", picture()),
    }
    document |= changes
    return data_uri("application/json", json.dumps({k: v for k, v in document.items() if v is not None}).encode())


def test_all_of_a_token_is_read() -> None:
    metadata = read_token_uri(token())
    assert (metadata.name, metadata.description) == ("Genesis #7", "A picture.")
    assert metadata.traits == {"Structure": "Ring", "Prisms": 12}
    assert metadata.picture == picture()
    np.testing.assert_array_equal(metadata.pixels, PIXELS)
    assert metadata.length == len(token())


def test_json_without_base64_is_read() -> None:
    document = json.dumps({"name": "a % b", "description": "é", "image": data_uri("image/png", picture())})
    uri = "data:application/json;utf8," + document.replace("%", "%25")
    metadata = read_token_uri(uri)
    assert (metadata.name, metadata.description, metadata.traits) == ("a % b", "é", {})
    assert metadata.length == len(uri.encode())


TWICE = b'{"name": "a", "name": "b"}'
BROKEN = data_uri("image/png", picture()[:-20])
CLEAR = picture("png", np.zeros((2, 2, 4), np.uint8))


@pytest.mark.parametrize(
    ("uri", "said"),
    [
        ("https://example.org/7", "not on the chain"),
        ("ipfs://abc", "not on the chain"),
        ("data:application/json;base64,e30", "is not valid Base64"),
        (data_uri("text/plain", b"{}"), "text/plain, not application/json"),
        (data_uri("application/json", b"{"), "not valid JSON"),
        (data_uri("application/json", b"\xff"), "not valid JSON"),
        (data_uri("application/json", b"[" * 60_000), "not valid JSON"),
        (data_uri("application/json", b'{"a": NaN}'), "not JSON compliant"),
        (data_uri("application/json", b'{"name": 1e999}'), "not JSON compliant"),
        (data_uri("application/json", b'{"name": "\\ud800"}'), "surrogates not allowed"),
        (data_uri("application/json", TWICE), "'name' occurs twice"),
        (data_uri("application/json", b"[]"), "not an object"),
        (token(name=None), "has no name"),
        (token(name=7), "has no name"),
        (token(image=None), "has no image"),
        (token(image="https://example.org/7.png"), "not on the chain"),
        (token(image=data_uri("image/svg+xml", b"<svg/>")), "image/svg+xml, not image/png"),
        (token(image=data_uri("image/png", picture("bmp"))), "not a complete PNG file"),
        (token(image=BROKEN), "not a complete PNG file"),
        (token(image=data_uri("image/png", picture("png", np.zeros((1, 4097, 3), np.uint8)))), "4097 x 1 pixels"),
        (token(image=data_uri("image/png", CLEAR)), "transparent"),
        (token(name="\x1b[2J\r\nGenesis", attributes={"Structure": "Ring"}), "of ?[2J??Genesis are not a list"),
        (token(attributes=["Ring"]), "no trait_type and value: Ring"),
        (token(attributes=[{"trait_type": "Structure"}]), "no trait_type and value"),
        (token(attributes=[{"trait_type": "A", "value": 1}] * 2), "the attribute A twice"),
        (token(description="x" * MAX_LENGTH), f"no more than {MAX_LENGTH:,}"),
    ],
)
def test_what_marketplaces_do_not_understand_is_refused_in_one_line(uri: str, said: str) -> None:
    with pytest.raises(VerificationError, match=r"^[^\n]*$") as caught:
        read_token_uri(uri)
    assert said in str(caught.value)


def test_parameters_of_a_data_uri_are_passed_over() -> None:
    assert read_data_uri("data:text/plain;charset=utf-8;base64,YWI=", "it") == ("text/plain", b"ab")
