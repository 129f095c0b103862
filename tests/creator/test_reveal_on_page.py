"""Tokens revealed from the page, by a wallet in the browser."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from tools.page_server import Started, browser_path, creator

pytest.importorskip("playwright.sync_api", reason="the tests of the page need playwright")
pytest.importorskip("pyrevm", reason="a chain with state needs it")
pytest.importorskip("starlette", reason="the page needs starlette")
if browser_path() is None:
    pytest.skip("the tests of the page need chromium: apt-get install chromium", allow_module_level=True)

from creator.reveal_chain import ACCOUNT, RevealChain
from creator.test_mint_on_page import WALLET
from shackled.artifacts import artifact
from shackled.ethereum import checksum_address, encode_header


@pytest.fixture(scope="module")
def server() -> Iterator[Started]:
    with creator("icons/diamond") as started:
        yield started


def open_page(browser: Any, address: str, chain: RevealChain | None) -> Any:
    context = browser.new_context()
    context.grant_permissions(["clipboard-read", "clipboard-write"])
    page = context.new_page()
    if chain is not None:
        page.expose_function("answer", chain.answer)
        page.add_init_script(WALLET)
    page.goto(address)
    page.wait_for_selector("#picture[data-number][data-draft=false]")
    return page


def words_of(page: Any, begin: str) -> str:
    page.wait_for_function(
        "begin => document.querySelector('[data-text=reveal-words]')?.textContent.startsWith(begin)", arg=begin
    )
    return str(page.inner_text("[data-text=reveal-words]"))


def test_anybody_reveals_in_the_browser(browser: Any, server: Started) -> None:
    chain = RevealChain()
    chain.mine(missing=3)
    page = open_page(browser, server.address, chain)
    page.wait_for_selector("#picture[data-draft=false]")
    page.click("text=Download")
    page.click("text=Reveal tokens …")
    page.wait_for_selector("#reveal[open]")
    assert page.locator("#takeaway[open]").count() == 0
    assert page.locator("#reveal b").count() == 0  # the name of a wallet is text
    find = "text=Find tokens with <b>Toy</b> wallet"

    # what is wrong is told, and nothing is asked
    page.click(find)
    page.wait_for_selector(".toast.alert >> text=the collection must be an address")
    assert chain.asked == []
    page.fill("#reveal input[name=collection]", "0x" + "11" * 20)
    page.click(find)
    assert "there is no Shackled Genesis collection at 0x1111" in words_of(page, "Not revealed")

    # messages are over what is clicked next
    for _ in range(2):
        page.click(".toast [aria-label=Dismiss]")

    # the block is to come: the page waits for it
    page.fill("#reveal input[name=collection]", chain.genesis.address)
    page.click(find)
    assert f"from block {chain.block:,}; the round can be revealed in 3 blocks" in words_of(page, "The seeds come")
    assert page.locator("#reveal-data").count() == 0
    chain.mine(missing=0)
    page.wait_for_selector("#reveal-data")
    assert "1 round of Shackled Genesis" in words_of(page, "Ready")

    # what is to be pasted elsewhere
    block = chain.eth_getBlockByNumber(hex(chain.block), False)
    data = "0x" + artifact("GenesisCollection").interface.encode("reveal", [0], [encode_header(block)]).hex()
    assert page.inner_text("#reveal-to") == checksum_address(bytes.fromhex(chain.genesis.address[2:]))
    page.click("[data-copy-of=reveal-data]")
    page.wait_for_selector(".toast >> text=Copied")
    assert page.evaluate("navigator.clipboard.readText()") == page.inner_text("#reveal-data") == data

    # refused in the wallet, then not
    chain.refused = "eth_sendTransaction"
    page.click("text=Send with <b>Toy</b> wallet")
    assert words_of(page, "Cancelled") == "Cancelled"
    chain.refused = ""
    page.click("text=Send with <b>Toy</b> wallet")
    assert "1 round of Shackled Genesis" in words_of(page, "Revealed")
    (sent,) = chain.sent
    assert (sent["from"], sent["to"].lower(), sent["value"]) == (ACCOUNT, chain.genesis.address, "0x0")
    assert sent["data"] == data
    assert chain.genesis.call("randomnessOf", 0) == bytes.fromhex(block["mixHash"][2:])
    assert page.locator("#reveal-data").count() == 0
    page.click(find)
    words_of(page, "There is nothing to reveal")


def test_the_dialog_has_an_address_and_says_that_there_is_no_wallet(browser: Any, server: Started) -> None:
    page = open_page(browser, f"{server.address.rstrip('/')}/reveal", None)
    page.wait_for_selector("#reveal[open] >> text=There is no wallet in this browser.")
    assert "shackled token reveal --calldata FILE" in page.inner_text("#reveal")
