"""A wallet that a test plays, with a chain behind it that runs what it is sent."""

from __future__ import annotations

from typing import Any

from tools.tokens.world import GAS, Account, Refused, World, keccak

from shackled.artifacts import artifact
from shackled.deploy import local_chain
from shackled.tokens import editions_address

ACCOUNT = "0x" + "a1" * 20


class EditionChain:
    """Answers of a wallet. sent: the transactions. deployed: whether the chain has the collection."""

    def __init__(self, deployed: bool = True) -> None:
        self.sent: list[dict[str, str]] = []
        self.world = World(31337)
        self.world.fund(ACCOUNT)
        if deployed:
            self.deploy()

    def deploy(self) -> None:
        """Put the collection, and what it calls, where it is on every chain."""
        local = local_chain()
        local.address("Editions")
        for address, code in local.codes().items():
            self.world.accounts["0x" + address.hex()] = Account(nonce=1, code=code)

    def answer(self, method: str, parameters: list[Any]) -> dict[str, Any]:
        """The answer to a request."""
        return {"result": getattr(self, method)(*parameters)}

    def eth_requestAccounts(self) -> Any:
        return [ACCOUNT]

    def eth_chainId(self) -> Any:
        return hex(self.world.chain_id)

    def eth_getCode(self, address: str, _: str) -> Any:
        return "0x" + self.world.of(address).code.hex()

    def eth_call(self, call: dict[str, str], _: str) -> Any:
        return "0x" + self._run(call, keep=False).output.hex()

    def eth_sendTransaction(self, transaction: dict[str, str]) -> Any:
        self.sent.append(transaction)
        return "0x" + keccak(str(len(self.sent)).encode()).hex()

    def eth_getTransactionReceipt(self, _: str) -> Any:
        try:
            receipt = self._run(self.sent[-1], keep=True)
        except Refused:
            return {"status": "0x0", "logs": []}
        return {"status": "0x1", "logs": receipt.logs}

    def _run(self, call: dict[str, str], keep: bool) -> Any:
        sender, data = call.get("from", ACCOUNT), bytes.fromhex(call["data"][2:])
        abi = artifact("Editions").abi
        return self.world.run(sender, call["to"], data, int(call.get("value", "0x0"), 16), GAS, keep, abi)

    def collection(self, function: str, *arguments: Any) -> Any:
        """What the collection answers."""
        interface = artifact("Editions").interface
        data = "0x" + interface.encode(function, *arguments).hex()
        answer = self.eth_call({"to": editions_address(), "data": data}, "latest")
        return interface.decode(function, bytes.fromhex(answer[2:]))
