"""Tokens by the visitor's wallet: one that the test plays, with a development node behind it, honest or not."""

from __future__ import annotations

import base64
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tools.anvil import Anvil

from creator_page import OBJ, Creator, Visit, scene
from forged_blocks import forged
from nodes import KEY, PUBLIC, anvil, needs_anvil
from open_sales import open_sale
from shackled.artifacts import artifact
from shackled.chain._address_book import VARIABLE
from shackled.cli.app import run
from shackled.deploy import Transactor
from shackled.deploy._contract import local_chain
from shackled.errors import NodeError
from shackled.tokens._collection import Collection
from shackled.tokens._contract import perform
from shackled.tokens._icons import ALLOWED_LICENCES
from shackled.tokens._launch import address_of
from shackled.tokens._metadata import read_token_uri

pytestmark = needs_anvil

CHAIN = 31337
HASH = "0x" + "7a" * 32
#: A wallet that announces itself as EIP-6963 has it, and has each request answered by the test. Its owner thinks before
#: a transaction is sent while `thinking` is set. `changed` tells what wallets tell.
WALLET = """
const heard = {};
const provider = {
    request: async ({ method, params }) => {
        while (window.thinking && method === 'eth_sendTransaction') await new Promise(done => setTimeout(done, 20));
        const { result, error, code } = await window.answer(method, params ?? []);
        if (error) throw Object.assign(new Error(error), { code });
        return result;
    },
    on: (event, listener) => { (heard[event] ??= []).push(listener); },
};
window.changed = event => heard[event]?.forEach(listener => listener());
const detail = Object.freeze({ info: { uuid: '1', name: '<b>Toy</b> wallet', rdns: 'test.toy', icon: '' }, provider });
const announce = () => dispatchEvent(new CustomEvent('eip6963:announceProvider', { detail }));
addEventListener('eip6963:requestProvider', announce);
announce();
"""
BOLT = scene({"mesh": {"piece": "icons/lightning", "object": 0}, "color": "#e0b030"}, size=[24, 16])
Visitor = Callable[..., Creator]
#: What is made of the result of a request with these parameters; last comes the node.
Lie = Callable[[Any, list[Any], "Node"], Any]


class Node:
    """A node, and a wallet before it. sent: the transactions. lies: what is made of the answer to a method.

    declined: methods that the owner of the wallet refuses. is_down: whether the wallet does not reach the node.
    """

    def __init__(self, node: Anvil, owner: Transactor, genesis: Collection) -> None:
        self.node, self.owner, self.genesis = node, owner, genesis
        self.book = {str(CHAIN): {"GenesisCollection": genesis.address}}
        self.reset()

    def reset(self) -> None:
        self.chain, self.account = CHAIN, 0
        self.declined: set[str] = set()
        self.lies: dict[str, Lie] = {}
        self.asked: list[str] = []
        self.sent: list[dict[str, str]] = []
        self.known = {CHAIN, 1}
        self.is_down = False

    @property
    def address(self) -> str:
        return str(self.node.rpc("eth_accounts")[self.account])

    def answer(self, method: str, parameters: list[Any]) -> dict[str, Any]:
        """The answer to a request of the page."""
        self.asked.append(method)
        if method in self.declined:
            return {"error": "User denied transaction signature.", "code": 4001}
        if self.is_down and method not in ("eth_accounts", "eth_chainId"):
            return {"error": "Failed to fetch", "code": -32603}
        result: Any = None
        match method:
            case "eth_accounts" | "eth_requestAccounts":
                result = [self.address]
            case "eth_chainId":
                result = hex(self.chain)
            case "wallet_switchEthereumChain" if int(parameters[0]["chainId"], 16) not in self.known:
                return {"error": "Unrecognized chain ID. Try adding the chain first.", "code": 4902}
            case "wallet_switchEthereumChain":
                self.chain = int(parameters[0]["chainId"], 16)
            case "wallet_addEthereumChain":
                self.known.add(int(parameters[0]["chainId"], 16))
            case "eth_getCode" if self.chain != CHAIN:
                result = "0x"
            case _:
                self.sent += parameters[:1] if method == "eth_sendTransaction" else []
                try:
                    result = self.node.rpc(method, *parameters)
                except NodeError as error:
                    return {"error": str(error), "code": -32603}
        return {"result": self.lies[method](result, parameters, self) if method in self.lies else result}

    def read(self, function: str, *arguments: Any) -> Any:
        """What the collection of editions answers."""
        interface = artifact("Editions").interface
        call = {"to": address_of("Editions"), "data": "0x" + interface.encode(function, *arguments).hex()}
        return interface.decode(function, self.node.connection.data("eth_call", call, "latest"))


@pytest.fixture(scope="module")
def started() -> Iterator[Node]:
    """A node with the contracts, and with a Genesis collection of which a token waits for its seed."""
    with anvil(*PUBLIC) as node:
        local = local_chain()
        local.address("Editions")
        for address, code in local.codes().items():
            node.rpc("anvil_setCode", "0x" + address.hex(), "0x" + code.hex())
        yield Node(node, *open_sale(node.connection))


@pytest.fixture
def node(started: Node) -> Iterator[Node]:
    """As it was before each test."""
    before = started.node.rpc("evm_snapshot")
    started.reset()
    yield started
    started.node.rpc("evm_revert", before)


@pytest.fixture
def visitor(visit: Visit, node: Node) -> Visitor:
    """Opens the page in a browser with the wallet."""

    def open_page(place: dict[str, Any] = BOLT, book: Any = None) -> Creator:
        return visit(place, script=WALLET, answer=node.answer, book=book or {})

    return open_page


def connected(page: Creator, name: str) -> Any:
    """A dialog with the wallet."""
    dialog = page.dialog(name)
    dialog.get_by_role("button", name="Connect <b>Toy</b> wallet").click()
    dialog.locator("[data-name=chain]").wait_for()
    return dialog


def added(page: Creator) -> Any:
    """The dialog in which the picture was added as an edition."""
    dialog = connected(page, "edition")
    press(dialog, "add")
    dialog.locator("[data-name=token]").wait_for()
    return dialog


def press(dialog: Any, name: str) -> None:
    dialog.locator(f"[data-name={name}]:enabled").click()


def trouble(dialog: Any, words: str) -> None:
    dialog.locator(".trouble", has_text=words).wait_for()


# ---- editions ----


def test_the_picture_becomes_an_edition(visitor: Visitor, node: Node) -> None:
    page = visitor()
    shown = page.pixels()
    dialog = connected(page, "edition")
    assert page.page.locator("dialog b", has_text="Toy").count() == 0  # the name of a wallet is text
    for name, value in (("name", 'A "bolt"'), ("supply", "3"), ("royalty", "2.5")):
        dialog.locator(f"[name={name}]").fill(value)
    # what it costs is told first, and is a ceiling
    cost = dialog.locator("[data-name=cost]").inner_text()
    assert cost.startswith("3 signatures: the last adds the edition, those before store its scene.")
    told = float(cost.partition("at most ")[2].partition(" ether")[0])
    press(dialog, "add")
    dialog.get_by_text("is the same as here").wait_for()
    signed = sum(int(each["gas"], 16) * int(each["maxFeePerGas"], 16) for each in node.sent)
    assert 0.99 * told * 10**18 < signed <= told * 10**18
    assert [(each["chainId"], each["value"]) for each in node.sent] == [(hex(CHAIN), "0x0")] * 3
    artist, price, supply, minted, _, closed, royalty, scale, model, _, name = node.read("editionAt", 0)
    assert (artist, price, supply, minted, closed) == (node.address.lower(), 10**16, 3, 1, False)
    assert (royalty, model, name) == (250, False, 'A "bolt"')
    token = read_token_uri(node.read("tokenURI", 0)).pixels
    assert token[::scale, ::scale].tobytes() == shown
    # the same is not added again by one more click, nor when the page is opened anew; nothing is stored twice
    assert dialog.locator("[data-name=add]").count() == 0
    press(dialog, "again")
    dialog.get_by_text("1 signature adds the edition").wait_for()
    again = connected(visitor(), "edition")
    again.get_by_text("This account has added this very scene already").wait_for()
    assert again.locator("[data-name=add]").count() == 0
    press(again, "again")
    press(again, "add")
    again.get_by_text("edition 1 of Shackled Editions").wait_for()
    assert len(node.sent) == 4


def test_what_is_too_dear_is_told_before_and_made_to_fit(visitor: Visitor) -> None:
    page = visitor(scene("torus-knot", size=256, antialias=True))
    dialog = page.dialog("edition")
    fit = dialog.locator("[data-name=fit]")
    trouble(dialog, "It does not fit a token: ")
    assert "too much; about" in fit.locator(".trouble").inner_text()
    dialog.get_by_role("button", name="Connect").click()
    page.after(lambda: press(fit, "fit"))
    fit.get_by_text("It fits a token.").wait_for()
    fit.get_by_text("Undo brings the former picture back").wait_for()
    dialog.locator("[data-name=add]:enabled").wait_for()


def test_licences(visitor: Visitor) -> None:
    source = Path(__file__).parents[2] / "web" / "src" / "creator" / "wallet" / "licence.ts"
    assert f"/^(?:{ALLOWED_LICENCES.pattern})$/" in source.read_text()
    page = visitor()
    # files need one that the artist states
    page.after(lambda: page.drop(**{"mine.obj": OBJ.encode()}))
    dialog = connected(page, "edition")
    trouble(dialog, "State the licence of the files")
    dialog.locator("[data-name=cost]").wait_for()
    assert dialog.locator("[data-name=add]").is_disabled()
    dialog.locator("[name=licence]").fill("my own work")
    dialog.locator("[data-name=add]:enabled").wait_for()
    # a piece has one
    page.run(
        """void (() => {
            const all = app.assets.pieces();
            app.assets.pieces = async () => (await all).map(each => ({ ...each, commercial: each.title !== 'Heart' }));
        })()"""
    )
    page.run("app.closeDialog()")
    page.after(lambda: page.run("app.openPiece('icons/heart')"))
    trouble(page.dialog("edition"), "“icons/heart” must not be minted")


def test_wrong_fields(visitor: Visitor, node: Node) -> None:
    dialog = connected(visitor(), "edition")
    for name, value, words in (
        ("name", " ", "An edition needs a name"),
        ("name", "é" * 33, "The name is too long"),
        ("price", "-1", "The price is an amount of ether"),
        ("supply", "1.5", "The number of tokens is a whole number"),
        ("supply", "0", "The number of tokens must be a whole number from 1"),
        ("royalty", "10.5", "The royalty is 0 to 10 percent"),
    ):
        dialog.locator("[data-name=add]:enabled").wait_for()
        field = dialog.locator(f"[name={name}]")
        right = field.input_value()
        field.fill(value)
        trouble(dialog, words)
        assert dialog.locator("[data-name=add]:enabled").count() == 0
        field.fill(right)
    assert node.sent == []


def test_who_says_no_is_not_shouted_at(visitor: Visitor, node: Node) -> None:
    """And may think again."""
    page = visitor()
    dialog = page.dialog("edition")
    for method, button in (("eth_requestAccounts", "connect"), ("eth_sendTransaction", "add")):
        node.declined = {method}
        press(dialog, button)
        page.wait("document.querySelector('[data-name=said]')?.textContent === 'Cancelled'")
        assert dialog.locator(".trouble").count() == 0
        node.declined = set()
        press(dialog, button)
    dialog.locator("[data-name=token]").wait_for()
    assert len(node.sent) == 3


def test_two_clicks_add_once(visitor: Visitor, node: Node) -> None:
    page = visitor()
    dialog = connected(page, "edition")
    page.run("window.thinking = true")
    button = dialog.locator("[data-name=add]:enabled")
    button.dblclick()
    dialog.get_by_text("Storing the scene (1 of 3)").wait_for()
    # the second click, where what the first one hides leaves it beside the dialog
    page.page.locator("dialog[open]").dispatch_event("mousedown", {"detail": 2})
    dead = dialog.locator("[data-name=add]")
    assert dead.is_disabled()
    # whatever the button lets through, there is one thing at a time; a dialog that is opened anew knows it
    dead.evaluate("e => { e.disabled = false; e.click(); }")
    page.run("app.closeDialog()")
    dialog = page.dialog("edition")
    dialog.get_by_text("Storing the scene (1 of 3)").wait_for()
    assert dialog.locator("[data-name=add]:enabled").count() == 0
    page.run("window.thinking = false")
    dialog.locator("[data-name=token]").wait_for()
    assert [len(node.sent), node.asked.count("eth_sendTransaction"), node.read("editionCount")] == [3, 3, 1]


def test_a_transaction_of_which_nothing_is_heard_is_not_sent_again(visitor: Visitor, node: Node) -> None:
    page = visitor()
    dialog = connected(page, "edition")
    node.lies["eth_getTransactionReceipt"] = lambda *_: None
    node.lies["eth_getTransactionByHash"] = lambda found, *_: found and found | {"blockNumber": None, "blockHash": None}
    page.page.clock.install()
    press(dialog, "add")
    dialog.get_by_text("Sent: 0x").wait_for()
    page.page.clock.fast_forward(300_000)
    trouble(dialog, "is in a block is not known")
    assert len(node.sent) == 1
    node.lies = {}
    press(dialog, "add")
    page.page.clock.resume()
    dialog.locator("[data-name=token]").wait_for()
    assert (len(node.sent), node.read("editionCount")) == (3, 1)


def test_the_chain_is_offered(visitor: Visitor, node: Node) -> None:
    node.chain = 1
    page = visitor(book={chain: {"Editions": address_of("Editions")} for chain in (str(CHAIN), "4242")})
    dialog = connected(page, "edition")
    press(dialog, "switch-4242")
    trouble(dialog, "The wallet does not know chain 4242: add it there")
    for known in (True, False):
        trouble(dialog, "Ethereum has no collection of editions at 0x")
        assert dialog.locator("[data-name=add]").count() == 0
        node.known = {1, CHAIN} if known else {1}
        press(dialog, f"switch-{CHAIN}")
        dialog.locator("[data-name=add]:enabled").wait_for()
        assert ("wallet_addEthereumChain" in node.asked) == (not known)
        # and what the wallet changes by itself is followed
        node.account += 1
        page.run("window.changed('accountsChanged')")
        dialog.get_by_text(node.address[-4:]).wait_for()
        node.chain = 1
        page.run("window.changed('chainChanged')")


def in_logs(receipt: Any, topic: str) -> Any:
    for log in (receipt or {}).get("logs", ()):
        log["topics"][1] = topic
    return receipt


def meanwhile(**changes: Any) -> Callable[[Any, list[Any], Node], Any]:
    """The wallet is changed when the first transaction is sent."""

    def lie(result: Any, _: list[Any], node: Node) -> Any:
        vars(node).update(changes)
        return result

    return lie


@pytest.mark.parametrize(
    ("method", "lie", "words", "sent"),
    [
        ("eth_getCode", lambda code, *_: code[:-2] + "00", "has no collection of editions", 0),
        ("eth_requestAccounts", lambda *_: [7], "The wallet gives no account", 0),
        ("eth_chainId", lambda *_: "many", "which is no number", 0),
        ("eth_estimateGas", lambda *_: hex(10**9), "The wallet expects 1,000,000,000 gas, where", 0),
        ("eth_getBalance", lambda *_: "0x5", "The account has 0.000000000000000005 ether, less than that", 0),
        ("eth_sendTransaction", lambda *_: 7, "The wallet does not say what it sent", 1),
        ("eth_sendTransaction", meanwhile(chain=1), "The wallet is on Ethereum now: nothing more was sent", 1),
        ("eth_sendTransaction", meanwhile(account=1), "The wallet has another account now", 1),
        ("eth_sendTransaction", meanwhile(lies={"eth_getCode": lambda *_: "0x"}), "but the scene is not at 0x", 1),
        ("eth_getTransactionReceipt", lambda found, *_: found and found | {"status": "0x0"}, "contract refused", 1),
        ("eth_getTransactionReceipt", lambda found, *_: found and found | {"logs": []}, "names no new edition", 3),
        ("eth_getTransactionReceipt", lambda found, *_: in_logs(found, "zz"), "names no new edition", 3),
        ("eth_getTransactionReceipt", lambda found, *_: found and found | {"logs": [{}]}, "events that are none", 3),
        ("eth_call", lambda data, *_: data.replace(f"{10**16:064x}", f"{10**15:064x}"), "is not the one that was", 3),
        ("eth_call", lambda *_: "0x12", "", 3),
    ],
)
def test_wallets_that_lie_or_change(visitor: Visitor, node: Node, method: str, lie: Lie, words: str, sent: int) -> None:
    node.lies[method] = lie
    dialog = visitor().dialog("edition")
    press(dialog, "connect")
    if sent:
        press(dialog, "add")
    trouble(dialog, words)
    assert len(node.sent) == sent
    # what was added is not to be added by one more click, whatever is said of it
    if sent == 3:
        dialog.locator("[data-name=again]:enabled").wait_for()
        assert dialog.locator("[data-name=add]").count() == 0


def test_a_node_that_fails_takes_no_button_away(visitor: Visitor, node: Node) -> None:
    page = visitor()
    dialog = connected(page, "edition")
    told = dialog.locator("[data-name=cost]").inner_text()
    for name in ("add", "retry"):
        node.is_down = True
        press(dialog, name)
        dialog.locator("[data-name=retry]:enabled").wait_for()
        words = dialog.locator(".trouble").all_inner_texts()
        assert words == ["The node of the wallet does not answer (Failed to fetch)"]
        assert dialog.locator("[data-name=add]").is_disabled()
        assert dialog.locator("[data-name=cost]").inner_text() == told
    node.is_down = False
    press(dialog, "retry")
    dialog.locator("[data-name=add]:enabled").wait_for()
    assert dialog.locator(".trouble").count() == 0
    press(dialog, "add")
    dialog.locator("[data-name=token]").wait_for()
    assert len(node.sent) == 3
    # so it is where a token is minted
    page.close()
    node.is_down = True
    dialog = page.dialog("mint")
    trouble(dialog, "The node of the wallet does not answer")
    node.is_down = False
    press(dialog, "retry")
    press(dialog, "mint")
    dialog.get_by_text("Minted: token 1").wait_for()


BASE = {"baseFeePerGas": hex(2**255)}
TIP = "eth_maxPriorityFeePerGas"
#: What a node says of prices, and what the page then says.
PRICES: tuple[tuple[str, Lie, str], ...] = (
    (TIP, lambda *_: hex(3 * 10**9 + 1), "a tip of 3.000000001 gwei per unit of gas, more than 3"),
    (TIP, lambda *_: hex(10**13), "a tip of 10000 gwei per unit of gas, more than 3"),
    ("eth_estimateGas", lambda *_: hex(10**12), "The wallet expects 1,000,000,000,000 gas, where"),
    ("eth_getBlockByNumber", lambda block, asked, _: block | BASE if asked[0] == "latest" else block, "less than that"),
)


@pytest.mark.parametrize(("name", "button"), [("edition", "add"), ("mint", "mint"), ("reveal", "send")])
def test_prices_that_are_not_plausible(visitor: Visitor, node: Node, name: str, button: str) -> None:
    mine(node, missing=0)
    page = visitor(book=node.book)
    connected(page, name)
    for method, lie, words in (*PRICES, (TIP, lambda *_: hex(3 * 10**9), "")):
        page.close()
        node.lies = {method: lie}
        dialog = page.dialog(name)
        if name == "mint":
            dialog.get_by_role("radio", name="Genesis").check(force=True)
        elif name == "reveal":
            press(dialog, "find")
        if words:
            trouble(dialog, words)
        dialog.locator(f"[data-name={button}]:enabled").wait_for(state="detached" if words else "visible")
    assert node.sent == []


def test_another_picture_is_told(visitor: Visitor, node: Node) -> None:
    added(visitor())
    asked, other = (artifact("Editions").interface.encode("tokenURI", each) for each in (1, 0))
    first = node.node.rpc("eth_call", {"to": address_of("Editions"), "data": "0x" + other.hex()}, "latest")
    node.lies["eth_call"] = lambda data, call, _: first if call[0]["data"] == "0x" + asked.hex() else data
    dialog = connected(visitor(BOLT | {"size": [16, 16]}), "edition")
    press(dialog, "add")
    trouble(dialog, "is NOT the picture of this page")


def test_without_a_wallet(visit: Visit) -> None:
    dialog = visit(BOLT).dialog("edition")
    dialog.get_by_text("There is no wallet in this browser.").wait_for()
    assert "in the browser in your wallet's app" in dialog.inner_text()
    dialog = visit(BOLT, disk=True).dialog("edition")
    dialog.get_by_text("wallets talk to pages from a server only").wait_for()
    assert "shackled token edition add" in dialog.inner_text()


# ---- collections ----


def test_a_token_of_an_edition_is_minted(visitor: Visitor, node: Node) -> None:
    added(visitor())
    node.account, node.sent = 2, []
    dialog = connected(visitor(), "mint")
    cost = dialog.locator("[data-name=cost]").inner_text()
    assert "Price: 0.01 ether. With gas, at most 0.01" in cost
    assert dialog.locator("img").get_attribute("src") == image(node, 0)
    press(dialog, "mint")
    dialog.get_by_text("Minted: token 1 of Shackled Editions is yours").wait_for()
    assert dialog.locator("img").get_attribute("src") == image(node, 1)
    (sent,) = node.sent
    assert int(sent["value"], 16) == 10**16
    assert node.read("ownerOf", 1) == node.address.lower()
    # another one, by one who says that it is someone else's
    press(dialog, "again")
    node.lies["eth_call"] = lambda data, *_: data.replace(node.address[2:].lower(), "11" * 20)
    press(dialog, "mint")
    trouble(dialog, "Token 2, which the receipt names, is not yours")


def image(node: Node, token: int) -> str:
    """The data URL of the picture that the chain returns."""
    return str(json.loads(base64.b64decode(node.read("tokenURI", token).partition("base64,")[2]))["image"])


def test_tokens_of_the_address_book(
    visitor: Visitor, node: Node, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv(VARIABLE, str(tmp_path / "addresses.json"))
    monkeypatch.setenv("OWNER", KEY)
    for words in ("deploy icons --icons heart,lightning --price 0.02", "seal", "phase public -c icons"):
        command = f"token {words} --rpc {node.node.url} --private-key-env OWNER --yes"
        assert run(command.split()) == 0
    book = json.loads((tmp_path / "addresses.json").read_text())["chains"]
    book[str(CHAIN)]["GenesisCollection"] = node.genesis.address
    node.account = 3
    dialog = connected(visitor(book=book), "mint")
    dialog.get_by_role("radio", name="Icons").check(force=True)
    told = "“Lightning” as the collection has it, without your changes. Price: 0.02 ether, 99 left"
    dialog.get_by_text(told).wait_for()
    press(dialog, "mint")
    dialog.get_by_text("Minted: token 0 of Shackled Icons is yours").wait_for()
    dialog.get_by_role("radio", name="Genesis").check(force=True)
    dialog.get_by_text("The piece is drawn by lot after minting. Price: 0.15 ether, 1003 left").wait_for()
    press(dialog, "mint")
    dialog.get_by_text("Minted: token 1 of Shackled Genesis is yours").wait_for()
    assert node.genesis.owner_of(1).lower() == node.address.lower()
    assert [int(each["value"], 16) for each in node.sent] == [2 * 10**16, 15 * 10**16]
    # elsewhere there is none, and a sale that is closed is told
    node.chain = 1
    dialog = connected(visitor(book=book), "mint")
    dialog.get_by_text("No collection is known on Ethereum").wait_for()
    perform(node.owner, node.genesis.contract.prepare("setPhase", 0))
    press(dialog, f"switch-{CHAIN}")
    dialog.get_by_role("radio", name="Genesis").check(force=True)
    trouble(dialog, "The sale is closed")


# ---- revealing ----


def mine(node: Node, missing: int) -> int:
    """Makes blocks until so many are missing; the block that determines the seed."""
    block = int(node.genesis.contract.call("blockOf", 0))
    node.node.rpc("anvil_mine", hex(block + 1 - missing - int(node.node.rpc("eth_blockNumber"), 16)))
    return block


def test_anybody_reveals(visitor: Visitor, node: Node) -> None:
    block = mine(node, missing=3)
    dialog = connected(visitor(book=node.book), "reveal")
    for address, words in (
        ("0x" + "11" * 20, "There is no Shackled Genesis collection at 0x1111"),
        ("0x12", "An address is 0x and 40 hexadecimal digits"),
        (node.genesis.address, ""),
    ):
        dialog.locator("[name=collection]").fill(address)
        press(dialog, "find")
        if words:
            trouble(dialog, words)
    dialog.get_by_text(f"The seeds come from block {block:,}. Waiting for 3 blocks").wait_for()
    mine(node, missing=0)
    dialog.get_by_text("This transaction reveals 1 round on a development chain").wait_for()
    data = dialog.locator("pre").inner_text()
    press(dialog, "send")
    dialog.get_by_text("Revealed: 1 round.").wait_for()
    (sent,) = node.sent
    assert (sent["to"].lower(), sent["value"]) == (node.genesis.address.lower(), "0x0")
    assert sent["data"].startswith(data[:1500])
    assert node.genesis.metadata(0).traits != {"Revealed": "No"}
    press(dialog, "find")
    dialog.get_by_text("There is nothing to reveal").wait_for()


def test_wallets_that_lie_about_blocks(visitor: Visitor, node: Node) -> None:
    block = mine(node, missing=-300)
    hash_of = "0x" + artifact("GenesisCollection").interface.encode("hashOf", block).hex()
    dialog = connected(visitor(book=node.book), "reveal")
    press(dialog, "find")
    dialog.locator("[data-name=send]:enabled").wait_for()
    node.lies["eth_call"] = lambda *_: HASH
    press(dialog, "send")
    trouble(dialog, "These tokens are revealed already")
    lies: tuple[tuple[str, Lie, str], ...] = (
        ("eth_getBlockByNumber", lambda block, *_: forged(block, mixHash="0x" + "77" * 32), "a wrong header of block"),
        ("eth_getBlockByNumber", lambda block, *_: block | {"mixHash": {}}, "without its mixHash"),
        ("eth_getBlockByNumber", lambda block, *_: block | {"number": None}, "without its number"),
        ("eth_getBlockByNumber", lambda *_: None, "does not have block"),
        ("eth_blockNumber", lambda *_: "many", "which is no number"),
        ("eth_call", lambda *_: "0x12", "There is no Shackled Genesis collection at"),
        ("eth_call", lambda data, *_: f"0x{10**6:064x}" if data == f"0x{1:064x}" else data, "has 1,000,000 tokens"),
        ("eth_call", lambda data, *_: data if len(data) != 66 else "0x", "returned no data"),
        # no lie, but what the chain answers 8,191 blocks later
        ("eth_call", lambda data, call, _: f"0x{0:064x}" if call[0]["data"] == hash_of else data, "keeps no hashes"),
    )
    for method, lie, words in lies:
        node.lies = {method: lie}
        press(dialog, "find")
        trouble(dialog, words)
    assert "of such old blocks: the command shackled token reveal proves them" in dialog.inner_text()
    assert node.sent == []
