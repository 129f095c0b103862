"""A real node: headers as it makes them, and hashes of blocks that are less than 256 blocks old."""

from __future__ import annotations

import pytest
from eth_abi.abi import encode
from web3 import Web3

from nodes import Node
from open_sales import open_sale
from shackled.ethereum import encode_header
from token_checks import document, traits


@pytest.mark.parametrize("delay", [1, 2, 255, 256, 257, 400])
def test_reveal_on_a_node(node: Node, users: list[str], delay: int) -> None:
    genesis = node.contract("GenesisCollection", open_sale(node.connection)[1].address)
    call = genesis.functions
    block = call.blockOf(call.roundOf(0).call()).call()
    assert traits(document(call.tokenURI(0).call())) == {"Revealed": "No"}
    # the transaction is in the next block; nodes estimate its gas as if it were in the last one
    node.mine(block + delay - 1 - node.web3.eth.block_number)
    header = encode_header(node.connection.block(block))
    sent = call.reveal([0], [header]).transact({"from": node.accounts[2], "gas": 500_000})
    assert node.web3.eth.wait_for_transaction_receipt(sent)["blockNumber"] == block + delay
    randomness = bytes(node.web3.eth.get_block(block)["mixHash"])
    assert call.randomnessOf(0).call() == randomness
    drawn = bytes(Web3.keccak(randomness + encode(["address", "uint256"], [genesis.address, 0])))
    assert call.seedOf(0).call() == drawn
    # at the node's own limit on gas
    assert f"Seed 0x{drawn.hex()}." in document(call.tokenURI(0).call())["description"]
