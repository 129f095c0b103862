"""The picture of the page as an edition: the transactions, run on a chain, and wallets that lie."""

from __future__ import annotations

import asyncio
from typing import Any

import numpy as np
import pytest

pytest.importorskip("pyrevm", reason="a chain with state needs it")
pytest.importorskip("starlette", reason="the page needs starlette")

from creator.edition_chain import ACCOUNT, EditionChain
from shackled import render
from shackled.creator import (
    EditionCalls,
    Limits,
    Size,
    Source,
    State,
    Tasks,
    Waiting,
    Wallet,
    WalletError,
    mint_edition,
    parse_terms,
)
from shackled.errors import InputError, VerificationError
from shackled.tokens import OPEN, read_token_uri

PIECE = Source("piece", "icons/lightning")
STATE = State(PIECE, size=Size(24, 16))
FIELDS = {"name": "Mine", "price": "0.01", "supply": "7", "royalty": "2.5"}


@pytest.fixture(scope="module")
def calls() -> EditionCalls:
    return Tasks(Limits(), lambda done, total: None).edition(STATE, parse_terms(FIELDS, PIECE))


def run(calls: EditionCalls, chain: EditionChain) -> str:
    """Make the edition; return what is said at the end."""
    waiting = Waiting()

    async def send(message: dict[str, Any]) -> None:
        asked = message["wallet"]
        told = chain.answer(asked["method"], asked["params"])
        waiting.answer(asked["id"], told.get("result"), told.get("error"))

    async def tell(words: str) -> None:
        pass

    return asyncio.run(mint_edition(calls, Wallet(waiting, send, 0), tell))


def test_the_picture_becomes_a_token_of_the_visitor(calls: EditionCalls) -> None:
    chain = EditionChain()
    words = run(calls, chain)
    assert words.startswith("Added: edition 0 of Shackled Editions, token 0 is yours, at 0x")
    assert [each["to"] for each in chain.sent] == [calls.studio] * len(calls.storing) + [calls.collection]
    assert all(each["value"] == "0x0" for each in chain.sent)
    artist, price, supply, minted, _, closed, royalty, scale, model, _, name = chain.collection("editionAt", 0)
    assert (artist, price, supply, minted, closed) == (ACCOUNT, 10**16, 7, 1, False)
    assert (royalty, model, name) == (250, False, "Mine")
    token = read_token_uri(chain.collection("tokenURI", 0))
    drawn = render(Tasks(Limits(), lambda done, total: None).scene(STATE)).pixels
    np.testing.assert_array_equal(token.pixels, drawn.repeat(scale, 0).repeat(scale, 1))
    assert all(each["chainId"] == "0x7a69" for each in chain.sent)
    # what is stored already is not stored again
    before = len(chain.sent)
    assert "edition 1" in run(calls, chain)
    assert len(chain.sent) == before + 1


def lying(method: str, lie: Any) -> EditionChain:
    """A wallet that changes the answer to a method."""
    chain = EditionChain()
    honest = getattr(chain, method)
    setattr(chain, method, lambda *parameters: lie(honest(*parameters), parameters))
    return chain


def idle() -> EditionChain:
    """A wallet that sends nothing, and says that it did."""
    chain = EditionChain()
    setattr(chain, "eth_getTransactionReceipt", lambda _: {"status": "0x1", "logs": []})  # noqa: B010
    return chain


def switched() -> EditionChain:
    """A wallet that is switched to another chain after the first transaction."""
    chain = EditionChain()
    setattr(chain, "eth_chainId", lambda: "0x1" if chain.sent else "0x7a69")  # noqa: B010
    return chain


def changed(receipt: dict[str, Any], place: int, value: str) -> dict[str, Any]:
    for log in receipt["logs"]:
        log["topics"][place] = value
    return receipt


@pytest.mark.parametrize(
    ("chain", "error", "words", "sent"),
    [
        (lambda: EditionChain(deployed=False), InputError, "a development chain has no collection of editions", 0),
        (lambda: lying("eth_getCode", lambda code, _: code[:-2] + "00"), InputError, "has no collection of", 0),
        (lambda: lying("eth_requestAccounts", lambda *_: [7]), WalletError, "the wallet has no account", 0),
        (switched, InputError, "the wallet is on Ethereum now, not on a development chain: switch it back", 1),
        (idle, WalletError, "succeeded, but the scene is not at", 1),
        (
            lambda: lying("eth_getTransactionReceipt", lambda receipt, _: receipt | {"status": "0x0"}),
            WalletError,
            "the contract refused it",
            1,
        ),
        (
            lambda: lying("eth_getTransactionReceipt", lambda receipt, _: receipt | {"logs": []}),
            VerificationError,
            "its receipt names no new edition",
            -1,
        ),
        (
            lambda: lying("eth_getTransactionReceipt", lambda receipt, _: receipt | {"logs": [7]}),
            VerificationError,
            "its receipt has invalid events",
            -1,
        ),
        *(
            (
                lambda topic=topic: lying("eth_getTransactionReceipt", lambda receipt, _: changed(receipt, 1, topic)),
                VerificationError,
                "its receipt has invalid events",
                -1,
            )
            for topic in ("zz", "-0x1", "0x1" + "00" * 32)
        ),
        (
            lambda: lying("eth_call", lambda data, _: data.replace(f"{10**16:064x}", f"{10**15:064x}")),
            VerificationError,
            "edition 0, which the receipt of the transaction names, does not match the terms",
            -1,
        ),
        (lambda: lying("eth_call", lambda *_: "0x12"), WalletError, "could not be read", -1),
    ],
)
def test_wallets_that_lie(calls: EditionCalls, chain: Any, error: Any, words: str, sent: int) -> None:
    """sent: number of transactions at the end; -1 for all."""
    wallet = chain()
    with pytest.raises(error, match=words):
        run(calls, wallet)
    assert len(wallet.sent) == (len(calls.storing) + 1 if sent < 0 else sent)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"name": " "}, "1 to 64 bytes, not 0"),
        ({"price": "-1"}, "the price must be an amount of ether"),
        ({"price": "1e3"}, "the price must be an amount of ether"),
        ({"supply": "1.5"}, "must be a whole number, or empty"),
        ({"supply": "0"}, "supply must be 1 to"),
        ({"royalty": "nan"}, "0 to 10 percent"),
        ({"royalty": ""}, "0 to 10 percent"),
        ({"royalty": "10.5"}, "0 to 10 percent"),
        ({"name": 7}, "must be short texts"),
        ({"name": "x" * 201}, "must be short texts"),
    ],
)
def test_wrong_fields(change: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words):
        parse_terms(FIELDS | change, PIECE)


def test_licences() -> None:
    assert parse_terms(FIELDS | {"supply": ""}, PIECE).supply == OPEN
    assert [parse_terms(FIELDS | more, PIECE).model for more in ({}, {"model": "on"})] == [False, True]
    with pytest.raises(InputError, match="short texts"):
        parse_terms(None, PIECE)
    upload = Source("upload", "0" * 64)
    for licence in ("", "all rights reserved"):
        with pytest.raises(InputError, match="state the licence of the file"):
            parse_terms(FIELDS | {"licence": licence}, upload)
    assert parse_terms(FIELDS | {"licence": "my own work"}, upload).name == "Mine"
    with pytest.raises(InputError, match="commercial use"):
        parse_terms(FIELDS, Source("piece", "bunny"))


def test_what_takes_too_much_gas_is_told_before_the_wallet_is_asked() -> None:
    large = State(PIECE, size=Size(900, 900))
    with pytest.raises(InputError, match="more than the 16,777,216 gas"):
        Tasks(Limits(), lambda done, total: None).edition(large, parse_terms(FIELDS, PIECE))
