"""What tests of tokens on a node have in common."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from web3 import HTTPProvider, Web3
from web3.types import RPCEndpoint

from shackled.artifacts import artifact


@dataclass(frozen=True)
class Node:
    """A node, with its accounts and the names of environment variables that hold their keys."""

    url: str
    accounts: list[str]
    keys: list[str]

    @property
    def web3(self) -> Web3:
        """web3.py, which knows nothing of ours."""
        return Web3(HTTPProvider(self.url, {"timeout": 60}, exception_retry_configuration=None))

    def contract(self, name: str, address: str) -> Any:
        """A contract of ours as web3.py sees it."""
        return self.web3.eth.contract(address=Web3.to_checksum_address(address), abi=artifact(name).abi)

    def rpc(self, method: str, *parameters: Any) -> Any:
        """What the node answers."""
        answer = self.web3.provider.make_request(RPCEndpoint(method), list(parameters))
        assert not answer.get("error"), answer
        return answer["result"]

    def mine(self, blocks: int) -> None:
        """Makes so many blocks."""
        self.rpc("anvil_mine", hex(blocks))

    def balance(self, account: str) -> int:
        """In wei."""
        return int(self.web3.eth.get_balance(Web3.to_checksum_address(account)))


@dataclass(frozen=True)
class Said:
    """What a command printed. code: with which it ended."""

    code: int
    out: str
    err: str

    @property
    def error(self) -> str:
        """The last line on stderr."""
        return self.err.strip().splitlines()[-1]


Shackled = Callable[..., Said]
