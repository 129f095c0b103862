"""Simulate a chain with state in this process: accounts, blocks with headers, contracts by name, exact gas.

pyrevm keeps addresses and slots warm from call to call. Each transaction therefore runs in a new EVM, set up from the
state that is stored here, with all addresses cold: its gas is that of a real chain, and an earlier state is restored by
a copy. The rules are those of Cancun, with two of Prague: hashes of older blocks (EIP-2935), and the price of data
(EIP-7623).
"""

from __future__ import annotations

import copy
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import rlp
from Crypto.Hash import keccak as _keccak
from eth_abi.abi import decode, encode
from eth_abi.exceptions import DecodingError
from eth_utils.abi import collapse_if_tuple

from shackled.artifacts import artifact
from shackled.ethereum._encoding import intrinsic_gas

#: EIP-2935: the contract that knows the hashes of blocks, and its code.
HISTORY = "0x0000f90827f1c53a10cb7a02335b175320002935"
HISTORY_CODE = bytes.fromhex(
    "3373fffffffffffffffffffffffffffffffffffffffe14604657602036036042575f35600143038111604257611fff"
    "81430311604257611fff9006545f5260205ff35b5f5ffd5b5f35611fff60014303065500"
)
HISTORY_LENGTH = 8191
GAS = 30_000_000_000
ETHER = 10**18
ZERO = "0x" + "00" * 20


def keccak(data: bytes) -> bytes:
    """Hash as Ethereum does."""
    return _keccak.new(digest_bits=256, data=data).digest()


def least_gas(data: bytes) -> int:
    """Return the least gas of a transaction with this data, whatever it executes: EIP-7623."""
    return 21_000 + 10 * data.count(0) + 40 * (len(data) - data.count(0))


def account(name: str) -> str:
    """Return the address of an account by its name."""
    return "0x" + keccak(name.encode())[12:].hex()


class Refused(Exception):
    """A call that was reverted: the name of the error and its values."""

    def __init__(self, name: str, values: tuple[Any, ...] = ()) -> None:
        """Store the error. name: of the error. values: of its parameters."""
        super().__init__(f"{name}{values}")
        self.name, self.values = name, values


@dataclass
class Account:
    """The state of an address."""

    balance: int = 0
    nonce: int = 0
    code: bytes = b""
    storage: dict[int, int] = field(default_factory=dict)


@dataclass(frozen=True)
class Receipt:
    """The result of a transaction.

    gas: of the whole transaction. execution: the gas without intrinsic gas. events: names and values. logs: the same
    as JSON-RPC returns them.
    """

    gas: int
    execution: int
    output: bytes
    events: list[tuple[str, dict[str, Any]]]
    logs: list[dict[str, Any]]


@dataclass(frozen=True)
class Built:
    """A compiled contract: ABI and creation code."""

    abi: list[dict[str, Any]]
    creation: bytes


class World:
    """The chain. Its first block has a large number, so that there are older blocks."""

    def __init__(self, chain_id: int = 1, salt: str = "") -> None:
        """Create the contract of EIP-2935. chain_id: of the chain. salt: changes the hashes of all blocks."""
        self.chain_id, self.salt = chain_id, salt
        self.accounts: dict[str, Account] = {HISTORY: Account(nonce=1, code=HISTORY_CODE)}
        self.number, self.time = 20_000_000, 1_800_000_000
        self._headers: dict[int, bytes] = {}
        #: The EVM that was set up last, and the state that is in it.
        self._ready: tuple[Any, Any] = (None, None)
        self.mine(1)

    # ---- blocks ----

    def mine(self, count: int = 1) -> None:
        """Make blocks. Transactions are part of the block after the last one."""
        for _ in range(count):
            header = self._header(self.number)
            self._headers[self.number] = header
            self.accounts[HISTORY].storage[self.number % HISTORY_LENGTH] = int.from_bytes(keccak(header), "big")
            self.number += 1
            self.time += 12

    def mine_to(self, number: int) -> None:
        """Make blocks until transactions are part of block `number`."""
        self.mine(number - self.number)

    def header(self, number: int) -> bytes:
        """Return the header of an existing block."""
        return self._headers[number]

    def randomness(self, number: int) -> bytes:
        """Return PREVRANDAO of a block, also of a future one."""
        return keccak(f"{self.salt} randomness {number}".encode())

    def _header(self, number: int) -> bytes:
        parent = keccak(self._headers[number - 1]) if number - 1 in self._headers else keccak(b"before")
        digest = keccak(f"{self.salt} {number}".encode())
        values: list[bytes | int] = [parent, digest, digest[:20], digest, digest, digest, digest * 8, 0, number]
        values += [
            36_000_000,
            number % 36_000_000,
            self.time,
            b"made by a test"[: number % 15],
            self.randomness(number),
        ]
        return bytes(rlp.encode([*values, bytes(8), 7, digest, 0, 0, digest, digest]))

    # ---- accounts ----

    def of(self, address: str) -> Account:
        """Return the account of an address."""
        return self.accounts.setdefault(address.lower(), Account())

    def balance(self, address: str) -> int:
        """Return what an address has, in wei."""
        return self.of(address).balance

    def fund(self, address: str, amount: int = 1000 * ETHER) -> str:
        """Give an address ether; return the address."""
        self.of(address).balance += amount
        return address

    @contextmanager
    def attempt(self) -> Iterator[None]:
        """Restore the state when the context ends."""
        kept = copy.deepcopy((self.accounts, self.number, self.time))
        try:
            yield
        finally:
            self.accounts, self.number, self.time = kept

    # ---- contracts ----

    def deploy(self, contract: str | Built, *arguments: Any, sender: str = ZERO) -> Contract:
        """Deploy a contract of the package by its name, or one that a test has compiled."""
        built = Built(artifact(contract).abi, artifact(contract).creation) if isinstance(contract, str) else contract
        inputs: list[dict[str, Any]] = next(
            (entry["inputs"] for entry in built.abi if entry["type"] == "constructor"), []
        )
        data = built.creation + encode([collapse_if_tuple(each) for each in inputs], _plain(arguments))
        evm = self._evm()
        try:
            address = evm.deploy(sender, data, None, GAS)
        except RuntimeError as error:
            raise _refusal(str(error), built.abi) from None
        self._keep(evm)
        return Contract(self, address.lower(), built.abi, max(evm.result.gas_used, least_gas(data)))

    def run(
        self, sender: str, to: str, data: bytes, value: int, gas: int, keep: bool, abi: list[dict[str, Any]]
    ) -> Receipt:
        """Execute a transaction, or a call if `keep` is false. Refused if it reverts."""
        evm, intrinsic = self._evm() if keep else self._kept_evm(), intrinsic_gas(data)
        before = evm.snapshot()
        try:
            output = bytes(evm.message_call(sender, to, data, value, gas + intrinsic))
            used, logs = evm.result.gas_used, evm.result.logs
        except RuntimeError as error:
            raise _refusal(str(error), abi) from None
        finally:
            if not keep:
                evm.revert(before)
        if keep:
            self._keep(evm)
        return Receipt(max(used, least_gas(data)), used - intrinsic, output, _events(logs, abi), [*map(_log, logs)])

    def _kept_evm(self) -> Any:
        """Return an EVM for a call, which must be reverted: that of the last call if the state is the same."""
        accounts = [
            (address, each.balance, each.nonce, each.code, *each.storage.items())
            for address, each in self.accounts.items()
        ]
        state = (self.number, self.time, accounts)
        if self._ready[1] != state:
            self._ready = (self._evm(), state)
        return self._ready[0]

    def _evm(self) -> Any:
        import pyrevm  # here, so that what only imports this module needs no EVM

        evm = pyrevm.EVM(spec_id="Cancun", env=pyrevm.Env(cfg=pyrevm.CfgEnv(chain_id=self.chain_id)))
        evm.set_block_env(
            pyrevm.BlockEnv(
                number=self.number, timestamp=self.time, prevrandao=self.randomness(self.number), gas_limit=2 * GAS
            )
        )
        for address, each in self.accounts.items():
            info = pyrevm.AccountInfo(balance=each.balance, nonce=each.nonce, code=each.code or None)  # type: ignore[call-arg]
            evm.insert_account_info(address, info)
            for slot, value in each.storage.items():
                # a slot leaves its account warm, and then the slots after it: going back makes it cold, and keeps it
                before = evm.snapshot()
                evm.insert_account_storage(address, slot, value)
                evm.revert(before)
        return evm

    def _keep(self, evm: Any) -> None:
        """Store the state after a transaction. pyrevm gives storage only in the text of its journal."""
        state = evm.journal_str.partition(", transient_storage: {")[0]
        for part in re.split(r"(?=0x[0-9a-f]{40}: Account \{)", state)[1:]:
            here = self.of(part[:42])
            info = evm.basic(part[:42])
            here.balance, here.nonce = info.balance, info.nonce
            code = bytes(evm.get_code(part[:42]) or b"")
            if code.strip(b"\0") and not here.code:
                # pyrevm adds 33 bytes of zeros to what was created
                here.code = code[:-33]
            storage = part.partition("storage: {")[2]
            for slot, value in re.findall(r"(\d+): StorageSlot \{[^}]*present_value: (\d+) \}", storage):
                here.storage[int(slot)] = int(value)


class Contract:
    """A contract at an address."""

    def __init__(self, world: World, address: str, abi: list[dict[str, Any]], gas: int = 0) -> None:
        """Refer to a contract on a chain. gas: of its deployment."""
        self.world, self.address, self.abi, self.gas = world, address, abi, gas
        self._functions: dict[tuple[str, int], tuple[dict[str, Any], list[str], bytes]] = {}

    def call(self, function: str, *arguments: Any, sender: str = ZERO, value: int = 0, gas: int = GAS) -> Any:
        """Call a function without a transaction; return its result."""
        entry, data = self.encode(function, arguments)
        output = self.world.run(sender, self.address, data, value, gas, False, self.abi).output
        values = decode([collapse_if_tuple(each) for each in entry["outputs"]], output)
        return values[0] if len(values) == 1 else values

    def gas_of(self, function: str, *arguments: Any, sender: str = ZERO, value: int = 0) -> int:
        """Return the execution gas of a call, without intrinsic gas."""
        _, data = self.encode(function, arguments)
        return self.world.run(sender, self.address, data, value, GAS, False, self.abi).execution

    def send(self, function: str, *arguments: Any, sender: str = ZERO, value: int = 0, gas: int = GAS) -> Receipt:
        """Send a transaction; return its receipt."""
        _, data = self.encode(function, arguments)
        return self.world.run(sender, self.address, data, value, gas, True, self.abi)

    def encode(self, function: str, arguments: tuple[Any, ...]) -> tuple[dict[str, Any], bytes]:
        """Return the ABI entry of a function and the data of a call.

        function: its name, or its signature if several functions have that name.
        """
        found = self._functions.get((function, len(arguments)))
        if found is None:
            found = self._functions[function, len(arguments)] = self._find(function, len(arguments))
        entry, kinds, selector = found
        return entry, selector + encode(kinds, _plain(arguments))

    def _find(self, function: str, count: int) -> tuple[dict[str, Any], list[str], bytes]:
        for entry in self.abi:
            if entry["type"] == "function":
                kinds = [collapse_if_tuple(each) for each in entry["inputs"]]
                signature = f"{entry['name']}({','.join(kinds)})"
                if function in (entry["name"], signature) and len(kinds) == count:
                    return entry, kinds, keccak(signature.encode())[:4]
        raise AssertionError(f"there is no {function} of {count} arguments")


def _plain(value: Any) -> Any:
    """Replace contracts by their addresses."""
    if isinstance(value, Contract):
        return value.address
    return type(value)(map(_plain, value)) if isinstance(value, list | tuple) else value


#: By the number of an ABI and the kind, with the ABI, so that its number stays its own.
_KNOWN: dict[tuple[int, str], tuple[list[dict[str, Any]], dict[bytes, dict[str, Any]]]] = {}


def _entries(abi: list[dict[str, Any]], kind: str) -> dict[bytes, dict[str, Any]]:
    """Return the events or errors of an ABI, by the hash of their signature."""
    if (id(abi), kind) in _KNOWN:
        return _KNOWN[id(abi), kind][1]
    found = {}
    for entry in abi:
        if entry["type"] == kind:
            signature = f"{entry['name']}({','.join(collapse_if_tuple(each) for each in entry['inputs'])})"
            found[keccak(signature.encode())] = entry
    _KNOWN[id(abi), kind] = (abi, found)
    return found


def _refusal(message: str, abi: list[dict[str, Any]]) -> Refused:
    if not message.startswith("Revert"):
        return Refused(re.search(r"reason: (\w+)", message)[1] if "reason" in message else message)  # type: ignore[index]
    output = bytes.fromhex(message.partition("output: 0x")[2].rstrip(" }"))
    if output[:4] == keccak(b"Panic(uint256)")[:4]:
        return Refused("Panic", (output[-1],))
    if output[:4] == keccak(b"Error(string)")[:4]:
        return Refused("Error", tuple(decode(["string"], output[4:])))
    for selector, entry in _entries(abi, "error").items():
        if selector[:4] == output[:4]:
            try:
                return Refused(
                    entry["name"], tuple(decode([collapse_if_tuple(each) for each in entry["inputs"]], output[4:]))
                )
            except DecodingError:
                break
    return Refused("0x" + output.hex())


def _log(log: Any) -> dict[str, Any]:
    topics, data = log.data
    hexadecimal = ["0x" + bytes(each).hex() for each in (*topics, data)]
    return {"address": log.address, "topics": hexadecimal[:-1], "data": hexadecimal[-1]}


def _events(logs: Any, abi: list[dict[str, Any]]) -> list[tuple[str, dict[str, Any]]]:
    known = _entries(abi, "event")
    found = []
    for log in logs:
        topics, data = log.data
        if topics and bytes(topics[0]) in known:
            entry = known[bytes(topics[0])]
            values = {}
            indexed = [each for each in entry["inputs"] if each["indexed"]]
            for each, topic in zip(indexed, topics[1:], strict=True):
                values[each["name"]] = decode([each["type"]], bytes(topic))[0]
            others = [each for each in entry["inputs"] if not each["indexed"]]
            plain = decode([collapse_if_tuple(each) for each in others], bytes(data))
            values |= dict(zip((each["name"] for each in others), plain, strict=True))
            found.append((entry["name"], values))
    return found
