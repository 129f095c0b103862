"""What can be deployed: creation code, and with it everything that can be known before: address, code, gas."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ..artifacts import artifact
from ..chain import EmbeddedChain, open_chain
from ..errors import ChainError, InputError
from ..ethereum import PROXY, SALT, create2_address, intrinsic_gas

#: The contracts that `shackled deploy` puts on a chain if none are named; those that they call come first.
STANDARD = ("Engine", "FragmentEngine", "Renderer", "Original", "Genesis")
#: All that can be named.
CONTRACTS = (*STANDARD, "PngEncoder", "Studio", "GenesisMetadata")

#: The code of the proxy: it creates (CREATE2) what follows the first word of the data, with this word as salt.
PROXY_CODE = bytes.fromhex(
    "7fffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffe03601600081602082378035828234f5801515603957"
    "8182fd5b8082525050506014600cf3"
)


@dataclass(frozen=True)
class Deployment:
    """A contract as the proxy deploys it.

    creation: with the arguments of the constructor. code: what stands there then. gas: of the whole transaction.
    """

    name: str
    creation: bytes
    code: bytes
    gas: int

    @property
    def address(self) -> bytes:
        """The same on every chain."""
        return create2_address(self.creation)

    @property
    def data(self) -> bytes:
        """Of the transaction to the proxy."""
        return SALT + self.creation


def deployments(names: Iterable[str] = STANDARD) -> list[Deployment]:
    """Return the contracts of these names, each after those that it calls, which are added.

    Raises InputError for a name that is not in `CONTRACTS`.
    """
    chosen = list(names)
    for name in chosen:
        if name not in CONTRACTS:
            raise InputError(f"there is no contract {name!r} to deploy; the contracts are {', '.join(CONTRACTS)}")
    return in_order(chosen)


def in_order(names: Iterable[str]) -> list[Deployment]:
    """Return any contracts whose constructors take nothing but other contracts, each after those that it calls."""
    chosen: list[str] = []

    def add(name: str) -> None:
        for part in artifact(name).parts:
            add(part)
        if name not in chosen:
            chosen.append(name)

    for name in names:
        add(name)
    local = local_chain()
    return [deployment(name, local.creation(name), chosen[:number], local) for number, name in enumerate(chosen)]


def deployment(name: str, creation: bytes, parts: Sequence[str] = (), local: EmbeddedChain | None = None) -> Deployment:
    """Return a contract of any creation code. The constructor is run here, where it finds the contracts `parts`.

    name: for people, and the address book. ChainError if the constructor refuses.
    """
    local = local_chain() if local is None else local
    for part in parts:
        local.address(part)
    local.put(PROXY, PROXY_CODE)
    data = SALT + creation
    result = local.run(PROXY, data)
    if result.output != create2_address(creation):
        raise ChainError(
            f"the contract {name} could not be deployed: the proxy gave {result.output.hex() or 'nothing'}"
        )
    return Deployment(name, creation, local.create(name, creation), result.gas + intrinsic_gas(data))


def local_chain() -> EmbeddedChain:
    """Return an EVM of its own in which contracts are tried."""
    kind = type(open_chain(None))
    assert issubclass(kind, EmbeddedChain)
    return kind()
