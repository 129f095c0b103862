"""What the page makes for a wallet that reveals tokens, and wallets that lie."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

pytest.importorskip("pyrevm", reason="a chain with state needs it")
pytest.importorskip("starlette", reason="the page needs starlette")

from tools.tokens.world import HISTORY_LENGTH

from creator.reveal_chain import RevealChain
from forged_blocks import forged
from shackled.artifacts import artifact
from shackled.creator import (
    DeclinedError,
    Reveal,
    Waiting,
    Wallet,
    WalletError,
    find_reveal,
    parse_collection,
    send_reveal,
)
from shackled.errors import InputError, NodeError


def play(work: Any, chain: RevealChain) -> tuple[Any, list[str]]:
    """What it returns, and what it has told."""
    waiting, told = Waiting(), list[str]()

    async def send(message: dict[str, Any]) -> None:
        asked = message["wallet"]
        answer = chain.answer(asked["method"], asked["params"])
        waiting.answer(asked["id"], answer.get("result"), answer.get("error"), answer.get("code"))

    async def tell(words: str) -> None:
        told.append(words)

    return asyncio.run(work(Wallet(waiting, send, 0), tell)), told


def find(chain: RevealChain) -> tuple[Reveal | None, list[str]]:
    return play(lambda wallet, tell: find_reveal(chain.genesis.address, wallet, 0, tell), chain)


def send(reveal: Reveal, chain: RevealChain) -> str:
    words, _ = play(lambda wallet, tell: send_reveal(reveal, wallet, tell), chain)
    assert isinstance(words, str)
    return words


@pytest.fixture
def chain() -> RevealChain:
    """A chain on which the block is mined."""
    made = RevealChain()
    made.mine(missing=0)
    return made


def found(chain: RevealChain) -> Reveal:
    reveal, _ = find(chain)
    assert reveal is not None
    return reveal


def test_the_page_waits_for_the_block(monkeypatch: pytest.MonkeyPatch) -> None:
    chain = RevealChain()
    chain.mine(missing=2)
    pauses: list[float] = []
    honest = chain.eth_blockNumber

    async def one_block(seconds: float) -> None:
        pauses.append(seconds)
        chain.mine(missing=2 - len(pauses) // 2)
        # every other time the wallet fails
        setattr(chain, "eth_blockNumber", honest if len(pauses) % 2 == 0 else lambda: "later")  # noqa: B010

    monkeypatch.setattr("asyncio.sleep", one_block)
    reveal, told = find(chain)
    assert reveal is not None
    assert len(pauses) == 4
    assert any("can be revealed in 1 block." in words for words in told)
    assert reveal.later == ""


def test_the_hash_of_the_block_gives_nothing(chain: RevealChain) -> None:
    """On two chains whose blocks differ in all but the randomness, the same is revealed."""
    outcomes = []
    for other in (False, True):
        with chain.stage.world.attempt():
            if other:
                chain.change_header(extraData=b"another block", gasUsed=b"\x01")
            reveal = found(chain)
            send(reveal, chain)
            block_hash = chain.genesis.call("hashOf", chain.block)
            outcomes.append((block_hash, reveal.randomness, chain.genesis.call("seedOf", 0)))
    (first, *revealed), (second, *same) = outcomes
    assert first != second
    assert revealed == same
    assert reveal.randomness == (chain.stage.world.randomness(chain.block),)


def test_rounds_that_wait_are_told(chain: RevealChain) -> None:
    later = chain.genesis.call("currentRound")
    chain.stage.mint()
    reveal = found(chain)
    assert [each.number for each in reveal.rounds] == [0]
    block = chain.genesis.call("blockOf", later)
    assert reveal.later == f"1 round cannot be revealed yet; the next one needs block {block:,}."
    assert send(reveal, chain).endswith(reveal.later)


def test_older_blocks_are_for_the_command(chain: RevealChain) -> None:
    """The others are revealed nevertheless."""
    chain.behind = 0
    chain.stage.world.mine(HISTORY_LENGTH)
    with pytest.raises(InputError, match="such old blocks: the command `shackled token reveal` proves them"):
        find(chain)
    round_ = chain.genesis.call("currentRound")
    chain.stage.mint()
    chain.stage.world.mine_to(chain.genesis.call("blockOf", round_) + 300)
    reveal = found(chain)
    assert [each.number for each in reveal.rounds] == [round_]
    assert "1 round cannot be revealed from this page" in reveal.later


def test_what_others_have_revealed_is_not_sent(chain: RevealChain) -> None:
    reveal = found(chain)
    chain.stage.reveal(0)
    with pytest.raises(InputError, match="these tokens are revealed already"):
        send(reveal, chain)
    assert chain.sent == []
    assert find(chain)[0] is None


def test_another_chain_gets_nothing(chain: RevealChain) -> None:
    reveal = found(chain)
    chain.chain_id = 1
    with pytest.raises(InputError, match="the wallet is on Ethereum now, and the tokens are on a development chain"):
        send(reveal, chain)
    assert chain.sent == []


@pytest.mark.parametrize("method", ["eth_requestAccounts", "eth_call", "eth_getBlockByNumber"])
def test_who_refuses_is_not_asked_again(chain: RevealChain, method: str) -> None:
    chain.refused = method
    with pytest.raises(DeclinedError):
        find(chain)
    assert chain.asked[-1] == method


def other_block(block: dict[str, Any]) -> dict[str, Any]:
    """A block with another randomness, and the hash that belongs to it."""
    return forged(block, mixHash="0x" + "77" * 32)


@pytest.mark.parametrize(
    ("method", "lie", "error", "words"),
    [
        ("eth_getBlockByNumber", other_block, NodeError, "a wrong header of block 20,000,"),
        ("eth_getBlockByNumber", lambda block: block | {"gasUsed": "0x1"}, InputError, "has the hash"),
        ("eth_getBlockByNumber", lambda block: block | {"mixHash": {}}, NodeError, "invalid fields of block"),
        ("eth_getBlockByNumber", lambda block: block | {"number": [3]}, NodeError, "invalid fields of block"),
        ("eth_getBlockByNumber", lambda block: {}, InputError, "returned no parentHash of block 0"),
        ("eth_getBlockByNumber", lambda block: None, WalletError, "does not have block 20,000,"),
        ("eth_blockNumber", lambda number: "many", WalletError, "is not a number"),
        ("eth_requestAccounts", lambda accounts: [], WalletError, "the wallet has no account"),
        ("eth_call", lambda data: "0x12", InputError, "there is no Shackled Genesis collection at"),
        (
            "eth_call",
            lambda data: f"0x{10**6:064x}" if data == f"0x{1:064x}" else data,
            WalletError,
            "has 1,000,000 tokens",
        ),
        ("eth_call", lambda data: data if len(data) != 66 else "0x", WalletError, "could not be read"),
    ],
)
def test_wallets_that_lie(chain: RevealChain, method: str, lie: Any, error: Any, words: str) -> None:
    honest = getattr(chain, method)
    setattr(chain, method, lambda *parameters: lie(honest(*parameters)))
    with pytest.raises(error, match=words):
        find(chain)
    assert chain.sent == []


def test_a_transaction_that_the_collection_would_refuse_is_not_shown(chain: RevealChain) -> None:
    """The wallet tells another hash as well, so that only the simulation shows it."""
    told = other_block(chain.eth_getBlockByNumber(hex(chain.block), False))
    asked = "0x" + artifact("GenesisCollection").interface.encode("hashOf", chain.block).hex()
    honest = chain.eth_call
    setattr(chain, "eth_getBlockByNumber", lambda *_: told)  # noqa: B010
    setattr(chain, "eth_call", lambda call, _: told["hash"] if call["data"] == asked else honest(call, _))  # noqa: B010
    with pytest.raises(WalletError, match=r"the collection would refuse the transaction: .* WrongHeader"):
        find(chain)


def test_a_wallet_that_sends_nothing_is_found_out(chain: RevealChain) -> None:
    reveal = found(chain)
    setattr(chain, "eth_getTransactionReceipt", lambda _: {"status": "0x1", "logs": []})  # noqa: B010
    with pytest.raises(WalletError, match="does not have the randomness of the blocks"):
        send(reveal, chain)


@pytest.mark.parametrize("fields", [None, {}, {"collection": 7}, {"collection": "0x12"}, {"collection": "1" * 300}])
def test_wrong_addresses(fields: Any) -> None:
    with pytest.raises(InputError, match="the collection must be"):
        parse_collection(fields)
