from __future__ import annotations

import io
import json
from html.parser import HTMLParser

import numpy as np
from PIL import Image as PillowImage

from shackled.tokens._metadata import Metadata, Trait
from shackled.tokens._view import TokenView, page, tokens_json


def shown(number: int, **changes: str) -> TokenView:
    stream = io.BytesIO()
    PillowImage.fromarray(np.full((4, 4, 3), number, np.uint8)).save(stream, "png")
    traits: dict[str, Trait] = {"Kind": changes.get("kind", "plain"), "Size": number}
    name = changes.get("name", f"Token #{number}")
    picture = Metadata(name, "<b>", traits, stream.getvalue(), {}, "data:")
    return TokenView(
        changes.get("collection", "Things"), "0x" + "ab" * 20, number, "0x" + "cd" * 20, True, picture, 5_000_000
    )


class Page(HTMLParser):
    """The tags that were opened."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def of(self, tag: str) -> list[dict[str, str | None]]:
        return [attributes for name, attributes in self.tags if name == tag]


def test_each_token_has_a_card_in_its_collection() -> None:
    parsed = Page(page([shown(1), shown(2), shown(3, collection="Others")]))
    assert len(parsed.of("article")) == 3
    assert [link["href"] for link in parsed.of("a")] == ["#c0", "#c1"]
    assert [image["alt"] for image in parsed.of("img")] == ["Token #1", "Token #2", "Token #3", ""]
    assert "token #2" in str(parsed.of("article")[1]["data-words"])
    _, second = json.loads(tokens_json([shown(1), shown(2)]))
    assert (second["token"], second["traits"], second["gas"]) == (2, {"Kind": "plain", "Size": 2}, 5_000_000)


def test_nothing_that_a_token_says_becomes_part_of_the_page() -> None:
    evil = '"><script>alert(1)</script><img src=x onerror="'
    parsed = Page(page([shown(1, name=evil, kind=evil, collection=evil)]))
    assert len(parsed.of("script")) == 1
    assert all("onerror" not in image for image in parsed.of("img"))
    assert all("onerror" not in article for article in parsed.of("article"))
