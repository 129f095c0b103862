"""Run the contracts on anvil, Foundry's development node."""

from __future__ import annotations

import os
import shutil
import socket
import subprocess
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any, Self

from shackled.artifacts import artifact
from shackled.chain import Connection, open_chain
from shackled.chain._chain import CallResult, ContractChain
from shackled.chain._embedded import EmbeddedChain
from shackled.errors import NodeUnreachableError, RenderError
from shackled.ethereum._encoding import PROXY, SALT, checksum_address, intrinsic_gas
from tools.children import child

#: Where `npm ci` installs it in a checkout.
BINARIES = Path(__file__).resolve().parents[1] / "contracts" / "node_modules" / ".bin"
GAS_LIMIT = 1_000_000_000
PATIENCE = 60


def find_anvil() -> str | None:
    """Return the binary in the PATH or in a checkout, or None."""
    return shutil.which("anvil", path=f"{os.environ.get('PATH', '')}{os.pathsep}{BINARIES}")


class Anvil:
    """A node that runs while the context is open, on a free port."""

    def __init__(self, binary: str, *options: str) -> None:
        """Start the node. binary: its path. options: of its command line."""
        self.binary, self.options = binary, options

    def __enter__(self) -> Self:
        with socket.socket() as found:
            found.bind(("127.0.0.1", 0))
            port = found.getsockname()[1]
        self.url = f"http://127.0.0.1:{port}"
        self.connection = Connection(self.url, PATIENCE)
        with ExitStack() as stack:
            # old states, which anvil would leave in the user's folder
            states = stack.enter_context(tempfile.TemporaryDirectory(prefix="anvil-"))
            options = ("--host", "127.0.0.1", "--port", str(port), "--silent", "--cache-path", states, *self.options)
            silent = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
            self.process = stack.enter_context(child(self.binary, *options, **silent))
            self._wait()
            self._running = stack.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def rpc(self, method: str, *parameters: Any) -> Any:
        """Return the answer to a request."""
        return self.connection.request(method, *parameters)

    def stop(self) -> None:
        """End the process, if it still runs."""
        self._running.close()

    def _wait(self) -> None:
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end and self.process.poll() is None:
            try:
                self.rpc("eth_chainId")
                return
            except NodeUnreachableError:
                time.sleep(0.05)
        raise RenderError(f"{self.binary} does not answer")


class AnvilChain(ContractChain):
    """A node with the contracts, which runs while the context is open; with the rules of the embedded EVMs."""

    name = "node (anvil)"

    def __init__(self, binary: str) -> None:
        """Start a node and deploy the contracts. binary: its path."""
        rules = ["--hardfork", "cancun", "--gas-limit", str(GAS_LIMIT), "--base-fee", "0", "--no-request-size-limit"]
        self.node = Anvil(binary, *rules)
        self._addresses: dict[str, str] = {}

    def __enter__(self) -> AnvilChain:
        self.node.__enter__()
        self.rpc = self.node.rpc
        self.sender = self.rpc("eth_accounts")[0]
        return self

    def __exit__(self, *_: object) -> None:
        self.node.stop()

    def call(self, contract: str, data: bytes, gas_limit: int | None = None) -> CallResult:
        """Make a read call, which reports no gas, and the same call as a transaction, which does."""
        return CallResult(self.read(contract, data, gas_limit), self.transact(contract, data))

    def transact(self, contract: str, data: bytes) -> int:
        """Return the execution gas of the same call as a transaction."""
        receipt = self._send({"to": self.address(contract), "data": "0x" + data.hex()})
        return int(receipt["gasUsed"], 16) - intrinsic_gas(data)

    def address(self, contract: str) -> str:
        """Return the address of a contract, which is deployed on first use."""
        if contract not in self._addresses:
            for part in artifact(contract).parts:
                self.address(part)
            local = open_chain()
            assert isinstance(local, EmbeddedChain)
            # anvil starts with the proxy for deterministic addresses
            self._send({"to": checksum_address(PROXY), "data": "0x" + (SALT + local.creation(contract)).hex()})
            self._addresses[contract] = checksum_address(local.address(contract))
        return self._addresses[contract]

    def read(self, contract: str, data: bytes, gas_limit: int | None = None) -> bytes:
        """Return the answer to a read call."""
        gas = hex((gas_limit or GAS_LIMIT // 2) + intrinsic_gas(data))
        call = {"from": self.sender, "to": self.address(contract), "data": "0x" + data.hex(), "gas": gas}
        return self.node.connection.data("eth_call", call, "latest")

    def _send(self, transaction: dict[str, str]) -> Any:
        sender = {"from": self.sender, "gas": hex(GAS_LIMIT), "gasPrice": "0x0"}
        sent = self.rpc("eth_sendTransaction", sender | transaction)
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            receipt = self.rpc("eth_getTransactionReceipt", sent)
            if receipt is not None:
                if int(receipt["status"], 16) != 1:
                    raise RenderError("anvil: the transaction failed")
                return receipt
            time.sleep(0.02)
        raise RenderError(f"anvil: no receipt after {PATIENCE} s")
