"""Minting by a wallet in the browser: one that the test plays, which stands for a chain as well."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from tools.page_server import Started, browser_path, creator

from shackled.artifacts import artifact

pytest.importorskip("playwright.sync_api", reason="the tests of the page need playwright")
pytest.importorskip("starlette", reason="the page needs starlette")
if browser_path() is None:
    pytest.skip("the tests of the page need chromium: apt-get install chromium", allow_module_level=True)

ACCOUNT, COLLECTION, HASH = "0x" + "a1" * 20, "0x" + "c0" * 20, "0x" + "7a" * 32
CHAIN, PRICE, ICON, TOKEN = 31337, 15 * 10**15, 3, 41
TRANSFER = "0xddf252ad1be2c89b69c2b068fc378daa952ba7f163c4a11628f55a4df523b3ef"

#: A wallet that announces itself as EIP-6963 has it, and has each request answered by the test. Where `thinking` is set
#: its owner thinks before a transaction is sent. `breakWire` closes the connection to the server, and new ones go to a
#: path that does not exist until `mendWire`; the page's policy forbids other servers.
WALLET = """
const provider = { request: async ({ method, params }) => {
    while (window.thinking && method === 'eth_sendTransaction') await new Promise(done => setTimeout(done, 20));
    const { result, error, code } = await window.answer(method, params ?? []);
    if (error) throw Object.assign(new Error(error), { code });
    return result;
} };
const detail = Object.freeze({ info: { uuid: '1', name: '<b>Toy</b> wallet', rdns: 'test.toy', icon: '' }, provider });
const announce = () => dispatchEvent(new CustomEvent('eip6963:announceProvider', { detail }));
addEventListener('eip6963:requestProvider', announce);
announce();
const wires = [];
let broken = false;
window.WebSocket = class extends WebSocket {
    constructor(url) { super(broken ? url.replace('/live', '/none') : url); wires.push(this); }
};
window.breakWire = () => {
    broken = true;
    wires.filter(({ url }) => url.includes('/live')).forEach(wire => wire.close());
};
window.mendWire = () => { broken = false; };
"""


class Chain:
    """What the wallet answers. asked: the methods, in their order. sent: the transactions."""

    def __init__(self, phase: int = 2, chain: int = CHAIN, error: str = "", code: int = -32603, of: str = "") -> None:
        """error, code: the answer to the method `of`."""
        self.phase, self.chain, self.error, self.code, self.of = phase, chain, error, code, of
        self.icons = artifact("IconsCollection").interface
        self.asked: list[str] = []
        self.sent: list[dict[str, str]] = []
        self.looks = 0

    def answer(self, method: str, parameters: list[Any]) -> dict[str, Any]:
        self.asked.append(method)
        if method == self.of:
            return {"error": self.error, "code": self.code}
        if method == "eth_requestAccounts":
            return {"result": [ACCOUNT]}
        if method == "eth_chainId":
            return {"result": hex(self.chain)}
        if method == "wallet_switchEthereumChain":
            self.chain = int(parameters[0]["chainId"], 16)
            return {"result": None}
        if method == "eth_call":
            assert parameters[0]["to"].lower() == COLLECTION
            return {"result": "0x" + self.read(bytes.fromhex(parameters[0]["data"][2:])).hex()}
        if method == "eth_sendTransaction":
            self.sent.append(parameters[0])
            return {"result": HASH}
        assert method == "eth_getTransactionReceipt"
        self.looks += 1
        if self.looks < 2:
            return {"result": None}
        topics = [TRANSFER, "0x" + "0" * 64, "0x" + ACCOUNT[2:].zfill(64), hex(TOKEN)]
        return {"result": {"status": "0x1", "logs": [{"address": COLLECTION, "topics": topics}]}}

    def read(self, data: bytes) -> bytes:
        from eth_abi.abi import encode

        number = int.from_bytes(data[4:36], "big")
        if data == self.icons.encode("phase"):
            return encode(["uint8"], [self.phase])
        if data == self.icons.encode("iconCount"):
            return encode(["uint256"], [5])
        if data == self.icons.encode("left", number):
            return encode(["uint256"], [7])
        assert data == self.icons.encode("iconAt", number)
        icon = ("Diamond" if number == ICON else f"Icon {number}", COLLECTION, 4, PRICE, 10, 0, 3, 0)
        return encode(["(string,address,uint8,uint96,uint32,uint32,uint32,uint32)"], [icon])


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Started]:
    book = tmp_path_factory.mktemp("book") / "addresses.json"
    book.write_text(json.dumps({"chains": {str(CHAIN): {"IconsCollection": COLLECTION}}}))
    with creator("icons/diamond", SHACKLED_ADDRESS_BOOK=str(book)) as started:
        yield started


def open_mint(browser: Any, server: Started, chain: Any) -> Any:
    page = browser.new_context().new_page()
    if chain is not None:
        page.expose_function("answer", chain.answer)
        page.add_init_script(WALLET)
    page.goto(server.address)
    page.wait_for_selector("#picture[data-number][data-draft=false]")
    page.click("text=Download")
    page.wait_for_selector("#takeaway >> text=Shackled Icons")
    return page


def words_of(page: Any, begin: str) -> str:
    page.wait_for_function(
        "begin => document.querySelector('[data-text=mint-words]').textContent.startsWith(begin)", arg=begin
    )
    return str(page.inner_text("[data-text=mint-words]"))


def test_an_icon_is_minted_by_the_wallet(browser: Any, server: Started) -> None:
    chain = Chain()
    page = open_mint(browser, server, chain)
    assert page.locator("#takeaway b").count() == 0  # the name of a wallet is text
    page.click("text=Mint with <b>Toy</b> wallet")
    assert f"token {TOKEN} of Shackled Icons" in words_of(page, "Minted")
    (sent,) = chain.sent
    assert sent["from"] == ACCOUNT
    assert sent["to"].lower() == COLLECTION
    assert int(sent["value"], 16) == PRICE
    assert bytes.fromhex(sent["data"][2:]) == chain.icons.encode("mint", ICON, 1)


def test_the_wallet_is_asked_to_change_the_chain(browser: Any, server: Started) -> None:
    chain = Chain(chain=1)
    page = open_mint(browser, server, chain)
    page.click("text=Mint with")
    words_of(page, "Minted")
    assert chain.asked.count("wallet_switchEthereumChain") == 1


@pytest.mark.parametrize(
    ("chain", "words"),
    [
        (Chain(error="Nonce too low", of="eth_sendTransaction"), "the wallet reports: Nonce too low"),
        (Chain(phase=0), "the sale is closed"),
        (
            Chain(
                chain=1,
                error="Unrecognized chain ID. Try adding the chain using wallet_addEthereumChain first.",
                code=4902,
                of="wallet_switchEthereumChain",
            ),
            "the wallet does not know a development chain (chain ID 31337): add it to the networks of the wallet",
        ),
    ],
    ids=["failed", "closed", "unknown chain"],
)
def test_what_hinders_is_told(browser: Any, server: Started, chain: Chain, words: str) -> None:
    page = open_mint(browser, server, chain)
    page.click("text=Mint with")
    assert words in words_of(page, "Not minted")
    assert chain.sent == []


@pytest.mark.parametrize("method", ["eth_requestAccounts", "wallet_switchEthereumChain", "eth_sendTransaction"])
def test_who_says_no_is_not_shouted_at(browser: Any, server: Started, method: str) -> None:
    words = "MetaMask Tx Signature: User denied transaction signature."
    chain = Chain(chain=1, error=words, code=4001, of=method)
    page = open_mint(browser, server, chain)
    page.click("text=Mint with")
    assert words_of(page, "Cancelled") == "Cancelled"
    assert page.locator(".toast").count() == 0
    assert chain.sent == []
    chain.of = ""  # and may think again
    page.click("text=Mint with")
    words_of(page, "Minted")


def test_two_clicks_mint_once(browser: Any, server: Started) -> None:
    chain = Chain()
    page = open_mint(browser, server, chain)
    page.evaluate("window.thinking = true")
    button = page.locator("text=Mint with")
    button.click()
    words_of(page, "The price is")
    button.click(force=True)
    # whatever the button lets through, the server refuses
    button.evaluate("e => e.disabled = false")
    button.click()
    page.wait_for_selector(".toast.alert")
    assert "a token is being minted: answer in your wallet" in page.inner_text(".toast.alert")
    # the dialog, when it is opened anew, knows as well
    page.click("#takeaway header [aria-label=Close]")
    page.click("text=Download")
    page.wait_for_selector("[data-name=mint-start]:disabled")
    assert words_of(page, "The price is")
    page.evaluate("window.thinking = false")
    assert f"token {TOKEN}" in words_of(page, "Minted")
    page.wait_for_selector("[data-name=mint-start]:not(:disabled)")
    assert len(chain.sent) == 1
    assert chain.asked.count("eth_sendTransaction") == 1


def test_icons_are_read_together(browser: Any, server: Started) -> None:
    """All answers are held back until five questions have been asked, which is as many as there are icons."""
    chain = Chain()
    page = open_mint(browser, server, chain)
    page.evaluate(
        """() => {
            const answer = window.answer, icons = [];
            window.answer = async (method, params) => {
                if (method === 'eth_call' && params[0].data.startsWith(window.iconAt)) {
                    await new Promise(done => {
                        icons.push(done);
                        if (icons.length >= 5) icons.forEach(each => each());
                    });
                }
                return answer(method, params);
            };
        }"""
    )
    page.evaluate("data => { window.iconAt = data }", "0x" + chain.icons.encode("iconAt", 0)[:4].hex())
    page.click("text=Mint with")
    words_of(page, "Minted")


def test_the_wire_may_break_while_the_wallet_is_asked(browser: Any, server: Started) -> None:
    chain = Chain()
    page = open_mint(browser, server, chain)
    page.evaluate("window.thinking = true")
    page.click("text=Mint with")
    words_of(page, "The price is")
    page.evaluate("window.breakWire()")
    page.wait_for_selector("body.offline")
    page.evaluate("window.thinking = false")
    page.wait_for_timeout(200)
    page.evaluate("window.mendWire()")
    assert f"token {TOKEN}" in words_of(page, "Minted")
    assert chain.asked.count("eth_sendTransaction") == 1


def test_without_a_wallet(browser: Any, server: Started) -> None:
    page = open_mint(browser, server, None)
    assert "no wallet" in page.inner_text("#takeaway")


def test_what_no_collection_has_becomes_an_edition(browser: Any, server: Started) -> None:
    """On a chain that has the collection to which anybody adds; on another one the page says that it has not."""
    pytest.importorskip("pyrevm", reason="a chain with state needs it")
    from creator.edition_chain import EditionChain

    chain = EditionChain(deployed=False)
    page = open_mint(browser, server, chain)
    page.click("#takeaway [aria-label=Close]")
    page.click("[data-tab=common]")
    page.click("[data-name='piece-teapot']")
    page.wait_for_function("() => document.querySelector('[data-text=title]').textContent.includes('teapot')")
    page.click("text=Download")
    page.wait_for_function("() => !document.querySelector('#takeaway').textContent.includes('Mint with')")
    page.click("text=Make an edition with <b>Toy</b> wallet")
    words = words_of(page, "Not minted")
    assert "a development chain has no collection of editions at 0x" in words
    chain.deploy()
    page.fill("input[name=name]", 'A "pot"')
    page.fill("input[name=price]", "1 ether")
    page.fill("input[name=supply]", "3")
    page.click("text=Make an edition with <b>Toy</b> wallet")
    assert "edition 0 of Shackled Editions, token 0 is yours" in words_of(page, "Added")
    assert chain.collection("editionAt", 0)[1:4] == (10**18, 3, 1)
    assert chain.collection("editionAt", 0)[10] == 'A "pot"'
    # wrong fields are told, and nothing is asked
    before = len(chain.sent)
    page.fill("input[name=royalty]", "90")
    page.click("text=Make an edition with <b>Toy</b> wallet")
    page.wait_for_selector(".toast.alert >> text=the royalty must be 0 to 10 percent")
    assert len(chain.sent) == before
