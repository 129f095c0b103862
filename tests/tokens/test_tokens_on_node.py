"""A real node: headers as it makes them, and hashes of blocks that are less than 256 blocks old."""

from __future__ import annotations

from typing import Any

import pytest
from eth_abi.abi import encode
from web3 import Web3

from nodes import Node
from shackled.artifacts import artifact
from shackled.ethereum import encode_header
from token_checks import document, traits

PRICE = 10**17


@pytest.fixture(scope="module")
def w3(running_node: Node) -> Web3:
    return running_node.web3


def deploy(w3: Web3, name: str, *arguments: Any) -> Any:
    contract = w3.eth.contract(abi=artifact(name).abi, bytecode=artifact(name).creation)
    receipt = w3.eth.wait_for_transaction_receipt(
        contract.constructor(*arguments).transact({"from": w3.eth.accounts[0]})
    )
    return w3.eth.contract(receipt["contractAddress"], abi=artifact(name).abi)


@pytest.fixture(scope="module")
def metadata(w3: Web3) -> str:
    renderer = deploy(w3, "Renderer", *(deploy(w3, part).address for part in artifact("Renderer").parts))
    parts = deploy(w3, "Genesis", renderer.address).address, deploy(w3, "PngEncoder").address
    return str(deploy(w3, "GenesisMetadata", *parts).address)


@pytest.mark.parametrize("delay", [1, 2, 255, 256, 257, 400])
def test_reveal_on_a_node(w3: Web3, metadata: str, delay: int) -> None:
    owner, alice, bob = (w3.eth.accounts[number] for number in range(3))
    genesis = deploy(w3, "GenesisCollection", metadata, PRICE, 10, (owner, 5, owner, 500))
    call = genesis.functions
    w3.eth.wait_for_transaction_receipt(call.setPhase(2).transact({"from": owner}))
    w3.eth.wait_for_transaction_receipt(call.mint(2).transact({"from": alice, "value": 2 * PRICE}))
    block = call.blockOf(call.roundOf(1).call()).call()
    assert traits(document(call.tokenURI(1).call())) == {"Revealed": "No"}
    # the transaction is in the next block; nodes estimate its gas as if it were in the last one
    w3.provider.make_request("anvil_mine", [hex(block + delay - 1 - w3.eth.block_number)])  # type: ignore[arg-type]
    header = encode_header(w3.eth.get_block(block))
    receipt = w3.eth.wait_for_transaction_receipt(call.reveal([0], [header]).transact({"from": bob, "gas": 500_000}))
    assert receipt["blockNumber"] == block + delay
    randomness = bytes(w3.eth.get_block(block)["mixHash"])
    assert call.randomnessOf(0).call() == randomness
    drawn = Web3.keccak(randomness + encode(["address", "uint256"], [genesis.address, 1]))
    assert call.seedOf(1).call() == bytes(drawn)
    # at the node's own limit on gas
    assert f"Seed 0x{bytes(drawn).hex()}." in document(call.tokenURI(1).call())["description"]
