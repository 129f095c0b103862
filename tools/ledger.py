"""Simulate a chain in this process on which contracts can create others, as the Studio does."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest
from eth_abi.abi import decode, encode
from eth_abi.grammar import parse

from shackled.artifacts import artifact
from shackled.chain import open_chain
from shackled.chain._embedded import EmbeddedChain, pyrevm_error
from shackled.ethereum._encoding import intrinsic_gas, to_hex

GAS = 2_000_000_000
SENDER = b"\x5a" * 20


class World:
    """Contracts by their addresses. Each call finds the same addresses cold."""

    def __init__(self) -> None:
        """Deploy the renderer and the Studio; skip the test if pyrevm is not installed."""
        pytest.importorskip("pyrevm")
        chain = open_chain("pyrevm")
        assert isinstance(chain, EmbeddedChain)
        for name in ("Renderer", "Studio", "PngEncoder"):
            chain.address(name)
        self.chain = chain
        self.codes = dict(chain.codes())
        self.gas = 0

    def address(self, contract: str) -> bytes:
        """Return the address of a contract of the package."""
        return self.chain.address(contract)

    def deploy(self, creation: bytes, arguments: bytes = b"") -> bytes:
        """Deploy a contract; return its address."""
        address = b"\xde" + len(self.codes).to_bytes(19, "big")
        self.codes[address] = self.chain.create("a contract", creation + arguments)
        return address

    def run(self, to: bytes, data: bytes, gas: int = GAS, created: bool = False, before: Sequence[bytes] = ()) -> bytes:
        """Call a contract; `gas` then has the execution gas. With `created`, the answer is the address of a contract
        that is kept. `before`: data of calls of it that come first.
        """
        import pyrevm

        evm: Any = pyrevm.EVM(spec_id="Cancun")
        for address, code in self.codes.items():
            evm.insert_account_info(to_hex(address), pyrevm.AccountInfo(code=code))
        try:
            for earlier in before:
                evm.message_call(to_hex(SENDER), to_hex(to), earlier, None, gas)
            output = bytes(evm.message_call(to_hex(SENDER), to_hex(to), data, None, gas))
        except RuntimeError as error:
            raise pyrevm_error(str(error), gas) from None
        self.gas = evm.result.gas_used - intrinsic_gas(data)
        if created:
            self._keep(evm, output[12:32])
        return output

    def _keep(self, evm: Any, address: bytes) -> None:
        if address not in self.codes:
            # pyrevm appends 33 zero bytes to created code
            code = bytes(evm.get_code(to_hex(address)) or b"")[:-33]
            if not code:  # a list may name an address without code
                return
            self.codes[address] = code
            for at in range(2, len(code), 20) if code[1] == 0x13 else ():
                self._keep(evm, code[at : at + 20])

    def call(self, contract: str, signature: str, *values: Any, gas: int = GAS) -> Any:
        """Return the single value that a function returns."""
        output = self.run(self.address(contract), call_data(signature, *values), gas)
        return decode([returned(contract, signature)], output)[0]

    def store(self, signature: str, *values: Any) -> bytes:
        """Store something in the Studio; return its pointer."""
        return self.run(self.address("Studio"), call_data(signature, *values), created=True)[12:32]


def call_data(signature: str, *values: Any) -> bytes:
    """Encode a call of a function whose parameters have these types."""
    from Crypto.Hash import keccak

    parameters = parse(signature[signature.index("(") :]).components if values else ()
    selector = keccak.new(digest_bits=256, data=signature.encode()).digest()[:4]
    return selector + encode([each.to_type_str() for each in parameters], values)


def returned(contract: str, signature: str) -> str:
    """Return the type of a function's return value."""
    name = signature.partition("(")[0]
    (kind,) = {entry["outputs"][0]["type"] for entry in artifact(contract).abi if entry.get("name") == name}
    return str(kind)
