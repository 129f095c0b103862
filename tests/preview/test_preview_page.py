"""The page of the preview in a real browser, through saves and errors of the compiler, until Ctrl-C."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tools.children import child

from preview.small_contracts import answering, contract, function, output

PATIENCE = 60_000
COUNT = 60
NAME = "A name that is too long for one line of a card #0"
#: Stands for the compiler: it knows two sources.
SOLC = """#!/bin/sh
cat > asked
if grep -q second asked; then cat second.json; elif grep -q broken asked; then cat broken.json; else cat first.json; fi
"""


def token(name: str, color: str) -> bytes:
    """Return the output of tokenURI."""
    image = "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 1 1'%3E%3Crect width='1' "
    document = {
        "name": name,
        "image": f"{image}height='1' fill='{color}'/%3E%3C/svg%3E",
        "attributes": [{"trait_type": "hash", "value": "0x" + "ab" * 64}],
    }
    return output("data:application/json," + json.dumps(document).replace("%", "%25"))


def compiled(color: str) -> dict[str, Any]:
    """Return what the compiler says of a contract."""
    made = contract(answering(token(NAME, color), token("Other", color)), function("tokenURI", "uint256"))
    built = {"abi": made.abi, "evm": {"bytecode": {"object": made.creation.hex()}}}
    return {"contracts": {"Small.sol": {"Small": built}}}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    broken = {"errors": [{"severity": "error", "formattedMessage": "ParserError: here"}]}
    for name, said in (("first", compiled("red")), ("second", compiled("blue")), ("broken", broken)):
        (tmp_path / f"{name}.json").write_text(json.dumps(said))
    (tmp_path / "solc").write_text(SOLC)
    (tmp_path / "solc").chmod(0o755)
    (tmp_path / "Small.sol").write_text("contract Small {} // first")
    return tmp_path


@pytest.fixture
def server(folder: Path) -> Iterator[subprocess.Popen[str]]:
    command = ["preview", "Small.sol", "--tokens", str(COUNT), "--no-browser", "--port", "0"]
    environment = os.environ | {"PATH": f"{folder}{os.pathsep}{os.environ['PATH']}"}
    with child(sys.executable, "-m", "shackled", *command, cwd=folder, env=environment) as process:
        yield process


def address(server: subprocess.Popen[str]) -> str:
    assert server.stdout is not None
    return next(filter(None, (re.search(r"http://\S+", line) for line in server.stdout)))[0]


def pictures_are_there(page: Any) -> None:
    """Have all pictures loaded: what a save replaces while it is on its way is rightly not found."""
    page.evaluate("for (const each of document.images) each.loading = 'eager'")
    page.wait_for_function("() => [...document.images].every((each) => each.complete && each.naturalWidth)")


def test_the_page_through_saves_until_the_end(folder: Path, server: subprocess.Popen[str], browser: Any) -> None:
    faults: list[str] = []
    page = browser.new_page(viewport={"width": 700, "height": 500})
    page.set_default_timeout(PATIENCE)
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.on("response", lambda response: faults.append(response.url) if response.status >= 400 else None)
    page.goto(address(server))
    done = page.get_by_text(f"{COUNT} tokens in")
    done.wait_for()

    # names in full, with the number unless it is part of the name
    cards = page.locator(".token")
    assert cards.nth(0).locator("strong").inner_text() == NAME
    assert cards.nth(5).locator("strong").inner_text() == "Other #5"

    # long values stay in the dialog
    cards.nth(40).click()
    page.locator("#details[open]").wait_for()
    assert page.evaluate(
        "document.getElementById('details').scrollWidth <= document.getElementById('details').clientWidth"
    )

    # a save keeps the place, the cards, and the dialog, which shows the new picture
    scrolled = page.evaluate("scrollY")
    assert scrolled > 0
    page.evaluate(
        """() => {
            window.least = Infinity;
            const count = () => { window.least = Math.min(window.least, document.querySelectorAll('.token').length); };
            new MutationObserver(count).observe(document.getElementById('tokens'), { childList: true });
        }"""
    )
    first = page.locator("#media img").get_attribute("src")
    pictures_are_there(page)
    (folder / "Small.sol").write_text("contract Small {} // second")
    page.wait_for_function("before => document.querySelector('#media img').getAttribute('src') !== before", arg=first)
    done.wait_for()
    assert page.evaluate("[scrollY, window.least]") == [scrolled, COUNT]
    assert page.locator("#details[open]").count() == 1
    page.keyboard.press("Escape")

    # an error of the compiler dims the tokens; their details can still be read
    (folder / "Small.sol").write_text("contract Small {} // broken")
    page.get_by_text("ParserError: here").wait_for()
    assert page.locator("#tokens.old .token").count() == COUNT
    cards.nth(3).click()
    page.locator("#details[open]").wait_for()
    pictures_are_there(page)
    (folder / "Small.sol").write_text("contract Small {}   // first")
    done.wait_for()
    assert page.locator("#tokens.old").count() == 0

    # Ctrl-C while the page is open
    server.send_signal(signal.SIGINT)
    _, said = server.communicate(timeout=20)
    assert said == ""
    assert server.returncode == 0
    assert faults == []
