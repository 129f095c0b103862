"""Who may mint when, and where the ether goes."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import nullcontext, suppress
from types import SimpleNamespace
from typing import Any

import pytest
from eth_account import Account

pytest.importorskip("pyrevm", reason="a chain with state needs it")

from tools.tokens.launched import ALLOW_LIST, CLOSED, LIMIT, PRICE, PUBLIC, RESERVE, Launched, launched
from tools.tokens.merkle import leaf, pair, proof_of, root_of
from tools.tokens.world import ETHER, ZERO, Contract, Refused, account, keccak

from adversaries import adversary
from shackled.tokens._collection import KINDS
from shackled.tokens._minting import sign_allowance
from token_checks import execute, refused

KEY = keccak(b"who signs")
SIGNER = Account.from_key(KEY).address


# ---- the public sale ----


def test_other_payments_and_quantities_are_refused(s: Launched) -> None:
    for sent in (0, PRICE - 1, PRICE + 1, 2 * PRICE, 100 * ETHER):
        with refused("Payment", sent, PRICE):
            s.genesis.send("mint", 1, sender=s.alice, value=sent)
    for quantity in (0, LIMIT + 1, 2**255, 2**256 - 1, (2**256) // PRICE + 1):
        for sent in (0, PRICE, quantity * PRICE % 2**256 % (1000 * ETHER)):
            with refused("Quantity", quantity, LIMIT):
                s.genesis.send("mint", quantity, sender=s.alice, value=sent)
        with refused("Quantity", quantity, LIMIT):
            s.genesis.send("mintReserve", s.alice, quantity, sender=s.owner)
    assert s.world.balance(s.alice) == 1000 * ETHER


@pytest.mark.parametrize("phase", [CLOSED, ALLOW_LIST, PUBLIC])
def test_each_way_of_minting_has_its_phase(s: Launched, phase: int) -> None:
    permission = (s.alice, 3, 2**40)
    s.genesis.send("setAllowList", root_of({s.alice: 3}), SIGNER, sender=s.owner)
    s.genesis.send("setPhase", phase, sender=s.owner)
    ways: list[tuple[int, Callable[[], Any]]] = [
        (PUBLIC, s.mint),
        (ALLOW_LIST, lambda: s.genesis.send("mintWithProof", 1, 3, [], sender=s.alice, value=PRICE)),
        (ALLOW_LIST, lambda: mint_signed(s, permission, sign(s.genesis, permission))),
    ]
    for needed, mint in ways:
        with nullcontext() if phase == needed else refused("WrongPhase", phase, needed):
            mint()


def test_the_last_token_is_sold_and_no_further(s: Launched) -> None:
    def keep(quantity: int) -> None:
        s.genesis.send("mintReserve", s.bob, quantity, sender=s.owner)

    for _ in range((1024 - RESERVE) // LIMIT):
        s.mint(LIMIT)
    assert s.genesis.call("left") == 0
    with refused("NothingLeft", 1, 0):
        s.mint()
    keep(LIMIT)
    keep(LIMIT)
    with refused("NothingLeft", 5, 4):
        keep(5)
    keep(4)
    assert s.genesis.call("totalSupply") == 1024
    assert s.genesis.call("ownerOf", 1023) == s.bob
    for last in (s.mint, lambda: s.mint(sender=s.owner), lambda: keep(1)):
        with refused("NothingLeft", 1, 0):
            last()


# ---- the allow-list: by proof ----


def test_a_proof_lets_mint_as_many_as_it_says(s: Launched) -> None:
    entries = {s.alice: 3, s.bob: 1, account("carol"): 12, account("dave"): 2, account("erin"): 1}
    s.genesis.send("setPhase", ALLOW_LIST, sender=s.owner)
    s.genesis.send("setAllowList", root_of(entries), ZERO, sender=s.owner)
    proof = proof_of(entries, s.alice)
    s.genesis.send("mintWithProof", 1, 3, proof, sender=s.alice, value=PRICE)
    s.genesis.send("mintWithProof", 2, 3, proof, sender=s.alice, value=2 * PRICE)
    assert s.genesis.call("mintedFromAllowList", s.alice) == 3
    # the same proof again
    with refused("AllowanceExceeded", 3, 1, 3):
        s.genesis.send("mintWithProof", 1, 3, proof, sender=s.alice, value=PRICE)
    # tokens that were sent away still count
    s.genesis.send("transferFrom", s.alice, s.bob, 0, sender=s.alice)
    with refused("AllowanceExceeded", 3, 1, 3):
        s.genesis.send("mintWithProof", 1, 3, proof, sender=s.alice, value=PRICE)
    # that of another, or another quantity
    for sender, allowed in ((s.bob, 3), (s.alice, 4)):
        with refused("NotOnAllowList", sender, allowed):
            s.genesis.send("mintWithProof", 1, allowed, proof, sender=sender, value=PRICE)
    # the limit of a call holds here too
    carol = s.world.fund(account("carol"))
    with refused("Quantity", 12, LIMIT):
        s.genesis.send("mintWithProof", 12, 12, proof_of(entries, carol), sender=carol, value=12 * PRICE)
    with refused("Quantity", 0, LIMIT):
        s.genesis.send("mintWithProof", 0, 12, proof_of(entries, carol), sender=carol)


def test_an_inner_node_is_no_leaf(s: Launched) -> None:
    """A second preimage: what is hashed to an inner node is shown as an account with a quantity."""
    entries = {s.alice: 1, s.bob: 1, account("carol"): 1, account("dave"): 1}
    leaves = sorted(leaf(*entry) for entry in entries.items())
    s.genesis.send("setPhase", ALLOW_LIST, sender=s.owner)
    s.genesis.send("setAllowList", root_of(entries), ZERO, sender=s.owner)
    inner, other = pair(*leaves[:2]), pair(*leaves[2:])
    assert pair(inner, other) == root_of(entries)
    # the 64 bytes below the inner node, read as an address and a number
    left, right = sorted(leaves[:2])
    mallory = s.world.fund("0x" + left[12:].hex())
    with refused("NotOnAllowList"):
        s.genesis.send("mintWithProof", 1, int.from_bytes(right, "big"), [other], sender=mallory, value=PRICE)
    with refused("NotOnAllowList"):
        s.genesis.send("mintWithProof", 1, 1, [], sender=mallory, value=PRICE)


def test_without_a_list_there_is_no_proof(s: Launched) -> None:
    s.genesis.send("setPhase", ALLOW_LIST, sender=s.owner)
    with refused("NotOnAllowList", s.alice, 1):
        s.genesis.send("mintWithProof", 1, 1, [], sender=s.alice, value=PRICE)
    with refused("AllowanceNotSigned", ZERO):
        permission = (s.alice, 1, 2**40)
        mint_signed(s, permission, bytes(65))


# ---- the allow-list: by signature ----


def sign(contract: Contract, permission: tuple[str, int, int], key: bytes = KEY, **domain: Any) -> bytes:
    """A permission, signed; parts of the domain as they should not be."""
    fields = {"account": "address", "quantity": "uint256", "deadline": "uint256"}
    types = {"Allowance": [{"name": name, "type": kind} for name, kind in fields.items()]}
    right = {"name": contract.call("name"), "version": "1", "chainId": contract.world.chain_id}
    right["verifyingContract"] = contract.address
    message = dict(zip(fields, permission, strict=True))
    return bytes(Account.sign_typed_data(key, right | domain, types, message).signature)


def mint_signed(
    s: Launched, permission: tuple[str, int, int], signature: bytes, quantity: int = 1, sender: str | None = None
) -> None:
    sender, value = sender or s.alice, quantity * PRICE
    s.genesis.send("mintWithSignature", quantity, permission, signature, sender=sender, value=value)


@pytest.fixture
def signing(s: Launched) -> Launched:
    s.genesis.send("setPhase", ALLOW_LIST, sender=s.owner)
    s.genesis.send("setAllowList", bytes(32), SIGNER, sender=s.owner)
    return s


def test_a_signature_lets_mint_as_many_as_it_says(signing: Launched) -> None:
    s = signing
    permission = (s.alice, 3, s.world.time)
    signature = sign(s.genesis, permission)
    # the package signs the same
    connection = SimpleNamespace(chain_id=s.world.chain_id)
    collection: Any = SimpleNamespace(kind=KINDS["genesis"], connection=connection, address=s.genesis.address)
    assert sign_allowance(collection, Account.from_key(KEY), *permission).signature == signature
    mint_signed(s, permission, signature, 2)
    with refused("AllowanceExceeded", 2, 2, 3):
        mint_signed(s, permission, signature, 2)
    mint_signed(s, permission, signature)
    # a replay by the same, and by another
    with refused("AllowanceExceeded", 3, 1, 3):
        mint_signed(s, permission, signature)
    with refused("AllowanceOfAnother"):
        mint_signed(s, permission, signature, sender=s.bob)
    with refused("AllowanceNotSigned"):
        mint_signed(s, (s.bob, *permission[1:]), signature, sender=s.bob)
    # both lists together do not allow more
    s.genesis.send("setAllowList", root_of({s.alice: 3}), SIGNER, sender=s.owner)
    with refused("AllowanceExceeded", 3, 1, 3):
        s.genesis.send("mintWithProof", 1, 3, [], sender=s.alice, value=PRICE)
    s.world.mine()
    with refused("AllowanceExpired", permission[2], s.world.time):
        mint_signed(s, permission, signature)


def test_a_signature_for_elsewhere_is_worth_nothing(signing: Launched) -> None:
    s = signing
    permission = (s.alice, 3, 2**40)
    right = sign(s.genesis, permission)
    other = s.world.deploy("GenesisCollection", s.metadata, PRICE, RESERVE, (s.owner, LIMIT, s.owner, 500))
    # ECDSA has two signatures of each message by the same key: (r, s) and (r, n - s)
    order = 0xFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFEBAAEDCE6AF48A03BBFD25E8CD0364141
    mirrored = (order - int.from_bytes(right[32:64], "big")).to_bytes(32, "big")
    wrong = [
        sign(s.genesis, permission, chainId=5),
        sign(s.genesis, permission, verifyingContract=other.address),
        sign(s.genesis, permission, name="Shackled Icons"),
        sign(s.genesis, permission, version="2"),
        sign(s.genesis, permission, key=keccak(b"another")),
        sign(s.genesis, (s.alice, 4, 2**40)),
        sign(s.genesis, (s.alice, 3, 2**41)),
        *(b"", bytes(64), bytes(65), right[:32] + mirrored + bytes([55 - right[64]])),
    ]
    for signature in wrong:
        with refused("AllowanceNotSigned"):
            mint_signed(s, permission, signature)
    # that of this chain and this contract, on another chain
    elsewhere = launched(chain_id=5)
    assert elsewhere.genesis.address == s.genesis.address
    elsewhere.genesis.send("setPhase", ALLOW_LIST, sender=s.owner)
    elsewhere.genesis.send("setAllowList", bytes(32), SIGNER, sender=s.owner)
    with refused("AllowanceNotSigned"):
        mint_signed(elsewhere, permission, right)
    # a signer that was withdrawn signs no more
    s.genesis.send("setAllowList", bytes(32), ZERO, sender=s.owner)
    with refused("AllowanceNotSigned", ZERO):
        mint_signed(s, permission, right)


def test_a_contract_may_sign(signing: Launched) -> None:
    s = signing
    signer = s.world.deploy(adversary("Signer"))
    s.genesis.send("setAllowList", bytes(32), signer.address, sender=s.owner)
    permission = (s.alice, 3, 2**40)
    with refused("AllowanceNotSigned"):
        mint_signed(s, permission, b"anything")
    signer.send("sign", s.genesis.call("allowanceHash", permission))
    mint_signed(s, permission, b"anything")
    assert s.genesis.call("balanceOf", s.alice) == 1


# ---- the owner ----


def test_only_the_owner_may(s: Launched) -> None:
    calls: dict[str, tuple[Any, ...]] = {"setPhase": (1,), "setAllowList": (bytes(32), ZERO), "setRoyalty": (ZERO, 1)}
    calls |= {"mintReserve": (ZERO, 1), "withdraw": (ZERO,), "transferOwnership": (ZERO,)}
    for function, arguments in calls.items():
        for sender in (s.alice, s.bob, ZERO):
            with refused("OwnableUnauthorizedAccount", sender):
                s.genesis.send(function, *arguments, sender=sender)


def test_ownership_changes_in_two_steps_and_is_never_given_up(s: Launched) -> None:
    def cannot(function: str, *arguments: Any, sender: str) -> None:
        with refused("OwnableUnauthorizedAccount", sender):
            s.genesis.send(function, *arguments, sender=sender)

    s.genesis.send("transferOwnership", s.bob, sender=s.owner)
    assert (s.genesis.call("owner"), s.genesis.call("pendingOwner")) == (s.owner, s.bob)
    cannot("setPhase", 1, sender=s.bob)
    cannot("acceptOwnership", sender=s.alice)
    s.genesis.send("transferOwnership", ZERO, sender=s.owner)
    cannot("acceptOwnership", sender=s.bob)
    s.genesis.send("transferOwnership", s.bob, sender=s.owner)
    s.genesis.send("acceptOwnership", sender=s.bob)
    assert (s.genesis.call("owner"), s.genesis.call("pendingOwner")) == (s.bob, ZERO)
    cannot("setPhase", 1, sender=s.owner)
    with refused("OwnerNeeded"):
        s.genesis.send("renounceOwnership", sender=s.bob)


# ---- the ether ----


def test_the_owner_fetches_all_of_it(s: Launched) -> None:
    s.mint(4)
    treasury = account("treasury")
    receipt = s.genesis.send("withdraw", treasury, sender=s.owner)
    assert receipt.events == [("Withdrawn", {"to": treasury, "amount": 4 * PRICE})]
    assert (s.world.balance(s.genesis.address), s.world.balance(treasury)) == (0, 4 * PRICE)
    s.genesis.send("withdraw", treasury, sender=s.owner)
    assert s.world.balance(treasury) == 4 * PRICE


def test_who_refuses_ether_blocks_nothing(s: Launched) -> None:
    s.mint(4)
    refuser = s.world.deploy(adversary("Refuser"))
    for to in (refuser.address, s.genesis.address, ZERO):
        with refused("WithdrawalRefused", to, 4 * PRICE):
            s.genesis.send("withdraw", to, sender=s.owner)
    # an owner who takes none sends it elsewhere
    s.genesis.send("transferOwnership", refuser.address, sender=s.owner)
    execute(refuser, s.genesis, "acceptOwnership", sender=s.bob)
    with refused("WithdrawalRefused"):
        execute(refuser, s.genesis, "withdraw", refuser, sender=s.bob)
    execute(refuser, s.genesis, "withdraw", s.bob, sender=s.bob)
    assert s.world.balance(s.bob) == 1000 * ETHER + 4 * PRICE


def test_long_answers_do_not_make_a_withdrawal_dear(s: Launched) -> None:
    s.mint(4)
    bomb = s.world.deploy(adversary("Bomb"))
    # the receiver's own memory costs what it costs; copying it would cost as much again
    gas = s.genesis.send("withdraw", bomb, sender=s.owner).gas
    alone = s.world.run(s.bob, bomb.address, b"", 0, 10**8, False, []).gas
    assert gas < alone + 50_000


def test_ether_comes_in_by_minting_only(s: Launched) -> None:
    s.mint()
    for data in (b"", b"\x12\x34\x56\x78", s.genesis.encode("totalSupply", ())[1]):
        with pytest.raises(Refused):
            s.world.run(s.alice, s.genesis.address, data, 1, 10**6, True, s.genesis.abi)
    transfer: tuple[Any, ...] = (s.alice, s.bob, 0)
    calls = [("transferFrom", transfer), ("safeTransferFrom", transfer), ("safeTransferFrom", (*transfer, b"x"))]
    for function, arguments in (*calls, ("approve", (s.bob, 0))):
        with refused("PaymentForNothing", 1):
            s.genesis.send(function, *arguments, sender=s.alice, value=1)
    for function, arguments in (("setPhase", (1,)), ("mintReserve", (s.bob, 1)), ("withdraw", (s.bob,))):
        with refused("0x"):
            s.genesis.send(function, *arguments, sender=s.owner, value=1)
    assert s.world.balance(s.genesis.address) == PRICE


def test_ether_that_is_forced_in_comes_out_again(s: Launched) -> None:
    s.world.of(s.genesis.address).balance += 7
    s.mint()
    s.genesis.send("withdraw", s.owner, sender=s.owner)
    assert s.world.balance(s.genesis.address) == 0
    assert s.world.balance(s.owner) == 1000 * ETHER + PRICE + 7


# ---- contracts that mint ----


def test_tokens_do_not_go_where_nobody_takes_them(s: Launched) -> None:
    deaf = s.world.deploy(adversary("Deaf"))
    with refused("TransferToNonERC721ReceiverImplementer"):
        execute(deaf, s.genesis, "mint", 1, sender=s.alice, value=PRICE)
    with refused("TransferToNonERC721ReceiverImplementer"):
        s.genesis.send("mintReserve", deaf, 1, sender=s.owner)


@pytest.mark.parametrize("swallow", [False, True])
@pytest.mark.parametrize("function", ["mint", "mintWithProof", "mintReserve", "withdraw", "transferFrom"])
def test_calls_from_a_token_that_arrives(s: Launched, function: str, swallow: bool) -> None:
    """A receiver calls back while it gets two tokens. It never gets a token that is not paid, nor ether."""
    receiver = s.world.deploy(adversary("Receiver"))
    s.world.fund(receiver.address, ETHER)
    if function in ("mintReserve", "withdraw"):
        s.genesis.send("transferOwnership", receiver, sender=s.owner)
        receiver.send("execute", s.genesis, s.genesis.encode("acceptOwnership", ())[1], 0)
    if function == "mintWithProof":
        s.genesis.send("setAllowList", leaf(receiver.address, 2), ZERO, sender=s.owner)
    arguments: dict[str, tuple[tuple[Any, ...], int]] = {
        "mint": ((1,), PRICE),
        "mintWithProof": ((1, 2, []), PRICE),
        "mintReserve": ((receiver, 1), 0),
        "withdraw": ((receiver,), 0),
        "transferFrom": ((receiver, s.bob, 1), 0),
    }
    inner, value = arguments[function]
    receiver.send("prepare", s.genesis, s.genesis.encode(function, inner)[1], value, swallow)
    before = s.world.balance(receiver.address) + s.world.balance(s.genesis.address)
    with suppress(Refused):
        receiver.send("execute", s.genesis, s.genesis.encode("mint", (2,))[1], 2 * PRICE)
    supply = s.genesis.call("totalSupply")
    assert s.world.balance(receiver.address) + s.world.balance(s.genesis.address) == before
    if function == "withdraw":
        # the owner's own ether comes back to it: nothing else is there
        assert (supply, s.world.balance(receiver.address)) == (2, ETHER)
    elif function == "transferFrom":
        # token 1 goes on while token 0 arrives
        assert (supply, s.genesis.call("balanceOf", s.bob)) == (2, 1)
    elif function == "mintWithProof":
        # it is not the phase of the list
        assert supply == (2 if swallow else 0)
    else:
        # more tokens while tokens arrive: ERC-721A undoes all of it
        assert supply == 0
        assert s.world.balance(s.genesis.address) == 0
    assert s.genesis.call("reserveMinted") == 0


def test_constructors_refuse_what_makes_no_sense(s: Launched) -> None:
    terms = (s.owner, LIMIT, s.owner, 500)
    wrong: list[tuple[tuple[Any, ...], str, tuple[Any, ...]]] = [
        ((s.alice, PRICE, RESERVE, terms), "NoMetadata", (s.alice,)),
        ((s.metadata, PRICE, 1025, terms), "Reserve", (1025, 1024)),
        ((s.metadata, PRICE, RESERVE, (ZERO, LIMIT, s.owner, 500)), "OwnableInvalidOwner", (ZERO,)),
        ((s.metadata, PRICE, RESERVE, (s.owner, 0, s.owner, 500)), "PerTransaction", (0,)),
        ((s.metadata, PRICE, RESERVE, (s.owner, 101, s.owner, 500)), "PerTransaction", (101,)),
        ((s.metadata, PRICE, RESERVE, (s.owner, LIMIT, s.owner, 1001)), "Royalty", (1001, 1000)),
        ((s.metadata, PRICE, RESERVE, (s.owner, LIMIT, ZERO, 500)), "ERC2981InvalidDefaultRoyaltyReceiver", (ZERO,)),
    ]
    for arguments, name, values in wrong:
        with refused(name, *values):
            s.world.deploy("GenesisCollection", *arguments)
    for parts, name in (((s.alice, s.studio), "NoGenesis"), ((s.generator, s.alice), "NoEncoder")):
        with refused(name, s.alice):
            s.world.deploy("GenesisMetadata", *parts)
    free = s.world.deploy("GenesisCollection", s.metadata, 0, 1024, terms)
    free.send("setPhase", PUBLIC, sender=s.owner)
    with refused("NothingLeft", 1, 0):
        free.send("mint", 1, sender=s.alice)
