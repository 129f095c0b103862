"""The standards that the collections claim."""

from __future__ import annotations

from typing import Any

import pytest

pytest.importorskip("pyrevm", reason="a chain with state needs it")

from tools.tokens.launched import Launched, launched
from tools.tokens.world import ETHER, ZERO, Contract, account, keccak

from token_checks import refused

#: The xor of the selectors of each standard's functions.
STANDARDS = {
    "ERC-165": ["supportsInterface(bytes4)"],
    "ERC-721": [
        "balanceOf(address)",
        "ownerOf(uint256)",
        "safeTransferFrom(address,address,uint256,bytes)",
        "safeTransferFrom(address,address,uint256)",
        "transferFrom(address,address,uint256)",
        "approve(address,uint256)",
        "setApprovalForAll(address,bool)",
        "getApproved(uint256)",
        "isApprovedForAll(address,address)",
    ],
    "ERC-721 metadata": ["name()", "symbol()", "tokenURI(uint256)"],
    "ERC-2981": ["royaltyInfo(uint256,uint256)"],
    "ERC-173": ["owner()", "transferOwnership(address)"],
}


def interface(signatures: list[str]) -> bytes:
    value = 0
    for signature in signatures:
        value ^= int.from_bytes(keccak(signature.encode())[:4], "big")
    return value.to_bytes(4, "big")


@pytest.fixture(scope="module")
def s() -> Launched:
    return launched()


@pytest.fixture(params=["genesis", "icons"])
def contract(s: Launched, request: pytest.FixtureRequest) -> Contract:
    return s.genesis if request.param == "genesis" else s.icons


def test_interfaces(contract: Contract) -> None:
    def supported(interface: bytes) -> Any:
        return contract.call("supportsInterface", interface)

    assert all(supported(interface(signatures)) is True for signatures in STANDARDS.values())
    # ERC-4906 has no functions: its number is that of the proposal
    assert supported(bytes.fromhex("49064906")) is True
    others = ("ffffffff", "00000000", "d9b67a26", "780e9d63", "12345678")
    assert not any(supported(bytes.fromhex(other)) for other in others)
    # ERC-165: less than 30,000 gas
    assert contract.gas_of("supportsInterface", bytes.fromhex("49064906")) < 30_000


def test_functions_and_events_of_the_standards_are_there(s: Launched, contract: Contract) -> None:
    wanted = [each for signatures in STANDARDS.values() for each in signatures]
    code = s.world.of(contract.address).code
    for each in (*wanted, "contractURI()", "totalSupply()", "eip712Domain()"):
        assert keccak(each.encode())[:4] in code, each
    entries = (entry for entry in contract.abi if entry["type"] == "event")
    events = {entry["name"]: [each["type"] for each in entry["inputs"]] for entry in entries}
    assert events["BatchMetadataUpdate"] == ["uint256", "uint256"]
    assert events["ContractURIUpdated"] == []
    assert events["OwnershipTransferred"] == ["address", "address"]
    fields, name, version, chain, verifier, salt, more = contract.call("eip712Domain")
    assert (fields, version, chain, verifier, salt, more) == (b"\x0f", "1", 1, contract.address, bytes(32), ())
    assert name == contract.call("name")


def test_royalties(s: Launched, contract: Contract) -> None:
    with s.world.attempt():
        assert contract.call("royaltyInfo", 0, ETHER) == (s.owner, ETHER // 20)
        contract.send("setRoyalty", s.bob, 1000, sender=s.owner)
        assert contract.call("royaltyInfo", 7, 12_345) == (s.bob, 1234)
        contract.send("setRoyalty", s.bob, 0, sender=s.owner)
        assert contract.call("royaltyInfo", 7, 12_345)[1] == 0
        with refused("Royalty", 1001, 1000):
            contract.send("setRoyalty", s.bob, 1001, sender=s.owner)
        with refused("ERC2981InvalidDefaultRoyaltyReceiver"):
            contract.send("setRoyalty", ZERO, 100, sender=s.owner)


def test_a_reveal_tells_marketplaces(s: Launched) -> None:
    with s.world.attempt():
        s.mint(7)
        block = s.genesis.call("blockOf", 0)
        s.world.mine_to(block + 300)
        events = s.genesis.send("reveal", [0], [s.world.header(block)]).events
    assert events == [
        ("Revealed", {"round": 0, "blockNumber": block, "randomness": s.world.randomness(block)}),
        ("BatchMetadataUpdate", {"_fromTokenId": 0, "_toTokenId": 6}),
    ]


def test_tokens_change_hands_as_approved(s: Launched) -> None:
    with s.world.attempt():
        carol = account("carol")
        s.mint(3)
        with refused("TransferCallerNotOwnerNorApproved"):
            s.genesis.send("transferFrom", s.alice, s.bob, 1, sender=s.bob)
        s.genesis.send("approve", s.bob, 1, sender=s.alice)
        s.genesis.send("transferFrom", s.alice, carol, 1, sender=s.bob)
        assert s.genesis.call("getApproved", 1) == ZERO
        s.genesis.send("setApprovalForAll", s.bob, True, sender=s.alice)
        s.genesis.send("safeTransferFrom", s.alice, carol, 2, sender=s.bob)
        assert [s.genesis.call("ownerOf", token) for token in range(3)] == [s.alice, carol, carol]
        with refused("TransferFromIncorrectOwner"):
            s.genesis.send("transferFrom", s.alice, s.bob, 1, sender=carol)
        with refused("TransferToZeroAddress"):
            s.genesis.send("transferFrom", carol, ZERO, 1, sender=carol)
