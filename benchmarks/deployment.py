"""Measure what it costs to deploy the contracts and to store the library: now, and after the repricing of state.

    python -m benchmarks.deployment

rewrites the tables of docs/studio.md, and prints them.

Gas now is exact: transactions are run in the embedded EVM. Gas after EIP-8037, "State Creation Gas Cost Increase"
(https://eips.ethereum.org/EIPS/eip-8037), is computed from it. For a transaction without value that creates `accounts`
contracts of `code` bytes together, and writes to `slots` new storage slots, these charges

    21,000 + 32,000 accounts + 200 code + 20,000 slots

are replaced by

    15,000 + 12,000 accounts + 6 words + 10,000 slots + 1,530 (code + 120 accounts + 64 slots)

where `words` is that of the code, in words of 32 bytes. 1,530 is the cost of a byte of state (CPSB), 120 and 64 are
the bytes of an account and of a slot, and 6 a word is for hashing the code, all by EIP-8037. The other charges that
come with them are 12,000 for a creation and 10,000 for writing to a slot (CREATE_ACCESS, STORAGE_WRITE: EIP-8038),
and 12,000 + 3,000 for a transaction (EIP-2780). Everything else is as it is now. What is left out, a few hundred gas,
is that other contracts are accessed for 3,000 instead of 2,600.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from tools.pages import ROOT, update

from shackled import load
from shackled.chain import open_chain
from shackled.deploy import deployments
from shackled.deploy._contract import PROXY_CODE, Deployment
from shackled.errors import ChainError
from shackled.ethereum._encoding import PROXY
from shackled.evm._instance import Instance, Status
from shackled.library import items
from shackled.scene._in_range import in_range
from shackled.scene._packed import pack
from shackled.studio._compact_mesh import compact
from shackled.studio._storage import STUDIO, StoreTransaction, quantize, store_mesh

from . import run_main

PAGE = ROOT / "docs" / "studio.md"

#: EIP-8037: gas of a byte of state; bytes of an account and of a storage slot; gas of hashing a word of code.
STATE_BYTE = 1_530
ACCOUNT_BYTES, SLOT_BYTES = 120, 64
HASH_WORD = 6
#: EIP-8038: gas of creating a contract, of writing to a slot; EIP-2780: of a transaction without value.
CREATION, WRITE, TRANSACTION = 12_000, 10_000, 15_000
#: What they replace, and the gas of a byte of code.
OLD_CREATION, OLD_SLOT, OLD_TRANSACTION, OLD_BYTE = 32_000, 20_000, 21_000, 200

#: Returns the storage slot that the data of a call name: PUSH0 CALLDATALOAD SLOAD PUSH0 MSTORE, then RETURN of a word.
READ_SLOT = bytes.fromhex("5f35545f5260205ff3")
#: How many slots, from the first, are looked at: those of all variables, mappings and arrays being empty.
SLOTS = 64
GAS = 1 << 40


@dataclass(frozen=True)
class Cost:
    """What transactions cost. size: bytes of code that they create. gas: now. repriced: after EIP-8037."""

    size: int
    gas: int
    repriced: int

    def __add__(self, other: Cost) -> Cost:
        """Return what both cost together."""
        return Cost(self.size + other.size, self.gas + other.gas, self.repriced + other.repriced)

    def row(self, name: str) -> str:
        """Return the row of a table."""
        return f"| {name} | {self.size:,} | {self.gas:,} | {self.repriced:,} | {self.repriced / self.gas:.1f} |"


def transaction_cost(gas: int, size: int, slots: int = 0) -> Cost:
    """Return the cost of a transaction of so much gas now, which creates a contract and storage slots."""
    old = OLD_TRANSACTION + OLD_CREATION + OLD_BYTE * size + OLD_SLOT * slots
    new = TRANSACTION + CREATION + HASH_WORD * -(-size // 32) + WRITE * slots
    return Cost(size, gas, gas - old + new + STATE_BYTE * (size + ACCOUNT_BYTES + SLOT_BYTES * slots))


def storing_cost(transactions: Iterable[StoreTransaction]) -> Cost:
    """Return the cost of transactions to the Studio, each of which creates a contract that holds bytes."""
    return total(transaction_cost(each.gas, len(each.code)) for each in transactions)


def total(costs: Iterable[Cost]) -> Cost:
    """Return the sum of costs."""
    return sum(costs, Cost(0, 0, 0))


def new_slots(deployed: Sequence[Deployment]) -> dict[str, int]:
    """Deploy contracts, and count the storage slots to which the constructor of each writes."""
    evm = Instance()
    evm.put(PROXY, PROXY_CODE)
    for each in deployed:
        answer = evm.send(PROXY, each.data, GAS)
        if answer.status != Status.SUCCESS:
            raise ChainError(f"the contract {each.name} could not be deployed")
    count = {}
    for each in deployed:
        # other code at the same storage
        evm.put(each.address, READ_SLOT)
        words = [evm.call(each.address, slot.to_bytes(32, "big"), GAS).output for slot in range(SLOTS)]
        count[each.name] = sum(any(word) for word in words)
    return count


def deployment_costs() -> dict[str, Cost]:
    """Return the costs of the contracts that `shackled deploy` deploys by default, by their names."""
    found = deployments()
    slots = new_slots(found)
    return {each.name: transaction_cost(each.gas, len(each.code), slots[each.name]) for each in found}


def library_costs() -> dict[str, Cost]:
    """Return the costs of storing the items of the library, by their names."""
    return {each.name: storing_cost(each.transactions) for each in items()}


def deployment_table(costs: dict[str, Cost]) -> str:
    """Return the costs of contracts as a table in Markdown."""
    rows = {f"`{name}`": cost for name, cost in costs.items()}
    return _table("contract", {**rows, f"**all {len(costs)}**": total(costs.values())})


def storing_table(costs: dict[str, Cost]) -> str:
    """Return the costs of storing the library, and meshes of one's own, as a table in Markdown."""
    ordered = sorted(costs, key=lambda name: costs[name].gas)
    icons = [each.name for each in items() if each.is_icon]
    others = [each.name for each in items() if not each.is_icon]
    rows = {
        f"the cheapest item, `{ordered[0]}`": costs[ordered[0]],
        f"the most expensive item, `{ordered[-1]}`": costs[ordered[-1]],
        f"the {len(icons)} icons": total(costs[name] for name in icons),
        f"the {len(others)} common objects": total(costs[name] for name in others),
        f"**all {len(costs)} items**": total(costs.values()),
        **mesh_costs(),
    }
    return _table("stored", rows)


def mesh_costs() -> dict[str, Cost]:
    """Return the costs of storing a mesh of about a thousand triangles, as it is and rounded."""
    studio = open_chain().address(STUDIO)
    (exact,) = in_range(load("teapot")).objects
    costs = {}
    for name, o, normal_bits in (
        ("a smooth mesh of {} triangles, exact", exact, 10),
        ("the same on a grid of 2^11, normals of 6 bits", quantize(exact, 11), 6),
    ):
        transactions = store_mesh("mesh", compact(pack(o.mesh, smooth=True), normal_bits), studio)
        costs[name.format(len(o.mesh.faces))] = storing_cost(transactions)
    return costs


def _table(what: str, rows: dict[str, Cost]) -> str:
    head = [f"| {what} | bytes of code | gas now | gas after EIP-8037 | ratio |", "|---|---:|---:|---:|---:|"]
    return "\n".join([*head, *(cost.row(name) for name, cost in rows.items())])


def summary(cost: Cost) -> str:
    """Return in words what everything costs together."""
    return (
        f"The contracts and the library together take {cost.gas / 1e6:.1f} million gas now,\n"
        f"{cost.gas / 1e9:.3f} ether at 1 gwei, and {cost.repriced / 1e6:.1f} million after EIP-8037: "
        f"{cost.repriced / cost.gas:.1f} times as much."
    )


def tables() -> dict[str, str]:
    """Return the tables, and a summary, by the names of their marks in the page."""
    deployed, stored = deployment_costs(), library_costs()
    return {
        "summary": summary(total([*deployed.values(), *stored.values()])),
        "deployment": deployment_table(deployed),
        "storing": storing_table(stored),
    }


def main() -> int:
    """Measure, print, and write the tables."""
    found = tables()
    print("\n\n".join(found.values()))
    return update({PAGE: found.get}, "python -m benchmarks.deployment")


if __name__ == "__main__":
    run_main(main)
