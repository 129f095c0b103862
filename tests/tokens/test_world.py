"""The gas that the chain of the tests tells is that of a real node, to the last unit."""

from __future__ import annotations

from typing import Any

import pytest

pytest.importorskip("pyrevm", reason="a chain with state needs it")

from tools.tokens.merkle import proof_of, root_of
from tools.tokens.stage import ALLOW_LIST, PUBLIC
from tools.tokens.world import HISTORY, HISTORY_LENGTH, ZERO, Contract, World, account, keccak
from web3 import Web3
from web3.types import Wei

from nodes import Node
from shackled.artifacts import artifact
from shackled.datasets.genesis import seed_of
from shackled.ethereum import encode_header

PRICE = 10**17


class Both:
    """A node and a world, on which the same is done."""

    def __init__(self, node: Node) -> None:
        self.node, self.world = node, World(node.web3.eth.chain_id)
        for each in node.accounts:
            self.world.fund(each)
            self.world.of(each).nonce = node.web3.eth.get_transaction_count(Web3.to_checksum_address(each))

    def deploy(self, name: str, *arguments: Any) -> Contract:
        """Deploys a contract at the same address on both, for the same gas. The world is at the node's block then."""
        sender, w3 = self.node.accounts[9], self.node.web3
        self.world.number = w3.eth.block_number + 1
        here = self.world.deploy(name, *arguments, sender=sender)
        built = w3.eth.contract(abi=artifact(name).abi, bytecode=artifact(name).creation)
        plain = [Web3.to_checksum_address(each.address) if isinstance(each, Contract) else each for each in arguments]
        sent = built.constructor(*plain).transact({"from": Web3.to_checksum_address(sender)})
        receipt = w3.eth.wait_for_transaction_receipt(sent)
        assert str(receipt["contractAddress"]).lower() == here.address
        assert receipt["gasUsed"] == here.gas, name
        return here

    def send(self, contract: Contract, function: str, *arguments: Any, sender: str, value: int = 0) -> None:
        """A transaction on both, for the same gas."""
        w3 = self.node.web3
        self.world.number = w3.eth.block_number + 1
        _, data = contract.encode(function, arguments)
        to = Web3.to_checksum_address(contract.address)
        sent = w3.eth.send_transaction({"from": sender, "to": to, "data": data, "value": Wei(value), "gas": 10_000_000})
        receipt = w3.eth.wait_for_transaction_receipt(sent)
        assert receipt["status"] == 1, function
        assert contract.send(function, *arguments, sender=sender, value=value).gas == receipt["gasUsed"], function

    def pass_to(self, block: int) -> None:
        """Makes blocks until the next transaction is in `block`."""
        self.node.mine(block - 1 - self.node.web3.eth.block_number)

    def header(self, block: int) -> bytes:
        """The node's header of a block, whose hash the world knows then."""
        header = encode_header(self.node.web3.eth.get_block(block))
        self.world.accounts[HISTORY].storage[block % HISTORY_LENGTH] = int.from_bytes(keccak(header))
        return header


@pytest.fixture
def both(node: Node) -> Both:
    return Both(node)


def test_transactions_cost_what_a_node_says(both: Both) -> None:
    """Deployments too, and those of which a part is paid back or whose data costs more than what they do."""
    owner, alice, bob, carol = both.node.accounts[:4]
    renderer = both.deploy("Renderer", *map(both.deploy, artifact("Renderer").parts))
    metadata = both.deploy("GenesisMetadata", both.deploy("Genesis", renderer), both.deploy("PngEncoder"))
    genesis = both.deploy("GenesisCollection", metadata, PRICE, 10, (owner, 5, owner, 500))

    listed = {alice: 2} | {account(f"listed {number}"): 2 for number in range(99)}
    both.send(genesis, "setAllowList", root_of(listed), ZERO, sender=owner)
    both.send(genesis, "setPhase", ALLOW_LIST, sender=owner)
    proof = proof_of(listed, alice)
    both.send(genesis, "mintWithProof", 1, 2, proof, sender=alice, value=PRICE)
    both.send(genesis, "setPhase", PUBLIC, sender=owner)
    both.send(genesis, "mint", 1, sender=bob, value=PRICE)
    both.send(genesis, "mint", 5, sender=carol, value=5 * PRICE)
    both.send(genesis, "mint", 2, sender=bob, value=2 * PRICE)
    both.send(genesis, "transferFrom", carol, bob, 2, sender=carol)
    both.send(genesis, "transferFrom", carol, bob, 6, sender=carol)
    both.send(genesis, "approve", carol, 6, sender=bob)
    # the approval is deleted: a refund
    both.send(genesis, "transferFrom", bob, alice, 6, sender=carol)
    both.send(genesis, "withdraw", owner, sender=owner)
    both.send(genesis, "mint", 1, sender=bob, value=PRICE)
    # to an account that is not there yet
    both.send(genesis, "withdraw", account("nobody"), sender=owner)

    block = genesis.call("blockOf", 0)
    both.pass_to(block + 300)
    both.send(genesis, "keepHash", block + 20, [both.header(block + number) for number in range(20, 0, -1)], sender=bob)
    both.send(genesis, "reveal", [0], [both.header(block)], sender=bob)


def test_pictures_cost_what_a_node_says(both: Both) -> None:
    renderer = both.deploy("Renderer", *map(both.deploy, artifact("Renderer").parts))
    metadata = both.deploy("GenesisMetadata", both.deploy("Genesis", renderer), both.deploy("PngEncoder"))
    both.send(metadata, "tokenURI", 7, seed_of(7), sender=both.node.accounts[0])
