"""The gas that the chain of the tests tells is that of a real node, to the last unit."""

from __future__ import annotations

from typing import Any

import pytest

pytest.importorskip("pyrevm", reason="a chain with state needs it")

from tools.tokens.launched import ALLOW_LIST, PUBLIC
from tools.tokens.merkle import proof_of, root_of
from tools.tokens.world import HISTORY, HISTORY_LENGTH, ZERO, Contract, World, account, keccak
from web3 import Web3

from nodes import Node
from shackled.artifacts import artifact
from shackled.datasets.genesis import seed_of
from shackled.ethereum._encoding import encode_header

PRICE = 10**17


class Both:
    """A node and a world, on which the same is done."""

    def __init__(self, node: Node) -> None:
        self.node, self.world = node, World(node.web3.eth.chain_id)
        for each in node.accounts:
            self.world.fund(each)
            self.world.of(each).nonce = node.web3.eth.get_transaction_count(Web3.to_checksum_address(each))

    def _sent(self, transaction: Any) -> Any:
        """The receipt of a transaction; the world is at its block then."""
        receipt = self.node.web3.eth.wait_for_transaction_receipt(transaction)
        assert receipt["status"] == 1
        self.world.number = receipt["blockNumber"]
        return receipt

    def deploy(self, name: str, *arguments: Any) -> Contract:
        """Deploys a contract at the same address on both, for the same gas."""
        sender, built = Web3.to_checksum_address(self.node.accounts[9]), artifact(name)
        contract = self.node.web3.eth.contract(abi=built.abi, bytecode=built.creation)
        plain = [Web3.to_checksum_address(each.address) if isinstance(each, Contract) else each for each in arguments]
        receipt = self._sent(contract.constructor(*plain).transact({"from": sender}))
        here = self.world.deploy(name, *arguments, sender=self.node.accounts[9])
        assert (here.address, here.gas) == (str(receipt["contractAddress"]).lower(), receipt["gasUsed"]), name
        return here

    def send(self, contract: Contract, function: str, *arguments: Any, sender: str, value: int = 0) -> None:
        """A transaction on both, for the same gas."""
        data, to = contract.encode(function, arguments)[1], Web3.to_checksum_address(contract.address)
        fields: Any = {"from": sender, "to": to, "data": data, "value": value, "gas": 10_000_000}
        receipt = self._sent(self.node.web3.eth.send_transaction(fields))
        assert contract.send(function, *arguments, sender=sender, value=value).gas == receipt["gasUsed"], function

    def header(self, block: int) -> bytes:
        """The node's header of a block, whose hash the world knows then."""
        header = encode_header(self.node.connection.block(block))
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
    both.node.mine(block + 299 - both.node.web3.eth.block_number)
    both.send(genesis, "keepHash", block + 20, [both.header(block + number) for number in range(20, 0, -1)], sender=bob)
    both.send(genesis, "reveal", [0], [both.header(block)], sender=bob)
    both.send(metadata, "tokenURI", 7, seed_of(7), sender=bob)
