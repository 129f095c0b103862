"""A wallet that a test plays, with a chain behind it on which a Genesis collection waits for its seeds."""

from __future__ import annotations

from typing import Any

import rlp
from tools.tokens.stage import Stage, stage
from tools.tokens.world import ETHER, GAS, HISTORY, HISTORY_LENGTH, Refused, keccak

ACCOUNT = "0x" + "a1" * 20
#: Fields of the headers of the world, in order.
FIELDS = [
    *("parentHash", "sha3Uncles", "miner", "stateRoot", "transactionsRoot", "receiptsRoot", "logsBloom", "difficulty"),
    *("number", "gasLimit", "gasUsed", "timestamp", "extraData", "mixHash", "nonce", "baseFeePerGas"),
    *("withdrawalsRoot", "blobGasUsed", "excessBlobGas", "parentBeaconBlockRoot", "requestsHash"),
]
#: As early as the world's hashes of blocks can be read.
READABLE = 257


class RevealChain:
    """Answers of a wallet. sent: the transactions. refused: the method that the owner of the wallet refuses."""

    def __init__(self) -> None:
        """Begin with a token of round 0, whose block is to come."""
        self.stage: Stage = stage()
        self.stage.mint()
        self.genesis = self.stage.genesis
        self.chain_id = 31337
        self.refused = ""
        self.asked: list[str] = []
        self.sent: list[dict[str, str]] = []
        #: Headers that differ from those of the world, by number.
        self.headers: dict[int, bytes] = {}
        #: What nodes report as the latest block is this much behind.
        self.behind = READABLE - 2
        self.stage.world.fund(ACCOUNT, ETHER)

    @property
    def block(self) -> int:
        """The block that determines the seed."""
        return int(self.genesis.call("blockOf", 0))

    def mine(self, missing: int) -> None:
        """Makes blocks until so many are missing."""
        self.stage.world.mine_to(self.block + READABLE - missing)

    def change_header(self, **values: bytes) -> None:
        """Give the block that determines the seed other fields."""
        world, number = self.stage.world, self.block
        fields = dict(zip(FIELDS, rlp.decode(world.header(number)), strict=True)) | values
        self.headers[number] = rlp.encode(list(fields.values()))
        slot = number % HISTORY_LENGTH
        world.of(HISTORY).storage[slot] = int.from_bytes(keccak(self.headers[number]), "big")

    def answer(self, method: str, parameters: list[Any]) -> dict[str, Any]:
        """The answer to a request."""
        self.asked.append(method)
        if method == self.refused:
            return {"error": "User rejected the request.", "code": 4001}
        try:
            return {"result": getattr(self, method)(*parameters)}
        except Refused as refusal:
            return {"error": f"execution reverted: {refusal.name}", "code": 3}

    def eth_requestAccounts(self) -> Any:
        return [ACCOUNT]

    def eth_chainId(self) -> Any:
        return hex(self.chain_id)

    def eth_blockNumber(self) -> Any:
        return hex(self.stage.world.number - 1 - self.behind)

    def eth_getBlockByNumber(self, number: str, whole: bool) -> Any:
        assert not whole
        header = self.headers.get(int(number, 16)) or self.stage.world.header(int(number, 16))
        block = {name: "0x" + value.hex() for name, value in zip(FIELDS, rlp.decode(header), strict=True)}
        # more than fits in a message to the server
        return block | {"hash": "0x" + keccak(header).hex(), "transactions": ["0x" + "ab" * 32] * 2000}

    def eth_call(self, call: dict[str, str], _: str) -> Any:
        if call["to"].lower() != self.genesis.address:
            return "0x"
        return "0x" + self._run(call, keep=False).output.hex()

    def eth_sendTransaction(self, transaction: dict[str, str]) -> Any:
        self.sent.append(transaction)
        return "0x" + keccak(str(len(self.sent)).encode()).hex()

    def eth_getTransactionReceipt(self, _: str) -> Any:
        self._run(self.sent[-1], keep=True)
        return {"status": "0x1", "logs": []}

    def _run(self, call: dict[str, str], keep: bool) -> Any:
        data = bytes.fromhex(call["data"][2:])
        return self.stage.world.run(call.get("from", ACCOUNT), call["to"], data, 0, GAS, keep, self.genesis.abi)
