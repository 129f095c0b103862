"""Measure the collections: exact gas of every action, in git, so that the cost of every change is visible.

    python -m benchmarks.tokens

measures everything, rewrites tokens.json and the table of docs/tokens.md, and prints it.
"""

from __future__ import annotations

import statistics
from functools import partial
from pathlib import Path

from tools.pages import ROOT
from tools.tokens.launched import ALLOW_LIST, ICONS, LIMIT, PRICE, Launched, icon_scene, launched, store_scene
from tools.tokens.merkle import proof_of, root_of
from tools.tokens.world import GAS, ZERO, account, keccak

from shackled.datasets.genesis import seed_of

from . import publish, read_figures, run_main

FILE = Path(__file__).with_name("tokens.json")
recorded = partial(read_figures, FILE)
PAGE = ROOT / "docs" / "tokens.md"

#: Gas of the contracts of 2021, as measured on them.
ORIGINAL = {"mint 1": 124_000, "mint 5": 712_000}
#: Seeds of the collection over which the statistics of tokenURI are.
SEEDS = 256

Figures = dict[str, int]


def take(seeds: int = SEEDS) -> Figures:
    """Measure all figures: gas of transactions with intrinsic gas, that of calls without."""
    s = launched()
    contracts = {"GenesisCollection": s.genesis, "GenesisMetadata": s.metadata, "IconsCollection": s.icons}
    figures = {f"deploy {name}": contract.gas for name, contract in contracts.items()}
    with s.world.attempt():
        fresh = s.world.deploy("IconsCollection", s.studio, (s.owner, LIMIT, s.owner, 500), sender=s.owner)
        for name in ("lightning", "crown"):
            pointer = store_scene(s.studio, icon_scene(f"icons/{name}"))
            receipt = fresh.send("add", name, pointer, 4, PRICE, 100, 0, sender=s.owner)
            figures[f"add an icon, the {name}"] = receipt.gas
        figures["seal the icons"] = fresh.send("seal", sender=s.owner).gas
    # the very first mint pays for new storage slots
    s.mint(1, s.bob)
    for quantity in (1, 2, 5, 10):
        with s.world.attempt():
            receipt = s.genesis.send("mint", quantity, sender=s.alice, value=quantity * PRICE)
            figures[f"mint {quantity}"] = receipt.gas
    with s.world.attempt():
        s.mint(1)
        figures["mint 1, by an owner of some"] = s.genesis.send("mint", 1, sender=s.alice, value=PRICE).gas
    with s.world.attempt():
        listed = {s.alice: 2} | {account(f"listed {number}"): 2 for number in range(999)}
        s.genesis.send("setAllowList", root_of(listed), ZERO, sender=s.owner)
        s.genesis.send("setPhase", ALLOW_LIST, sender=s.owner)
        proof = proof_of(listed, s.alice)
        receipt = s.genesis.send("mintWithProof", 1, 2, proof, sender=s.alice, value=PRICE)
        figures["mint 1, by a list of 1,000"] = receipt.gas
    with s.world.attempt():
        price = list(ICONS.values())[1][3]
        s.icons.send("mint", 1, 1, sender=s.bob, value=price)
        figures["mint 1 icon"] = s.icons.send("mint", 1, 1, sender=s.alice, value=price).gas
    with s.world.attempt():
        figures |= editions(s)
    s.mint(5)
    with s.world.attempt():
        figures["transfer, the first of 5"] = s.genesis.send("transferFrom", s.alice, s.bob, 1, sender=s.alice).gas
        figures["transfer, the last of 5"] = s.genesis.send("transferFrom", s.alice, s.bob, 5, sender=s.alice).gas
        figures["transfer, again"] = s.genesis.send("transferFrom", s.bob, s.alice, 5, sender=s.bob).gas
    with s.world.attempt():
        figures["withdraw"] = s.genesis.send("withdraw", s.owner, sender=s.owner).gas
    figures |= reveals(s)
    figures["tokenURI before the reveal"] = s.genesis.gas_of("tokenURI", 1)
    s.reveal(0)
    figures["tokenURI, what the collection adds"] = added(s)
    figures |= token_uris(s, seeds)
    return figures


def editions(s: Launched) -> Figures:
    """Measure the collection to which anyone can add scenes."""
    contract = s.world.deploy("Editions", s.studio)
    figures = {"deploy Editions": contract.gas}
    for number, name in enumerate(("lightning", "crown")):
        pointer = store_scene(s.studio, icon_scene(f"icons/{name}"))
        receipt = contract.send("add", name, pointer, 4, False, PRICE, 100, 500, 1, sender=s.owner)
        figures[f"add an edition and mint 1, the {name}"] = receipt.gas
        figures[f"tokenURI of an edition, the {name}"] = contract.gas_of("tokenURI", number)
    for quantity in (1, 5):
        with s.world.attempt():
            receipt = contract.send("mint", 0, quantity, sender=s.alice, value=quantity * PRICE)
            figures[f"mint {quantity} of an edition"] = receipt.gas
            figures["withdraw of an edition"] = contract.send("withdraw", [0], s.owner, sender=s.owner).gas
    figures["close an edition"] = contract.send("close", 0, sender=s.owner).gas
    return figures


def reveals(s: Launched) -> Figures:
    """Measure the reveals of rounds."""
    figures = {}
    for count in (1, 5, 20):
        with s.world.attempt():
            rounds = list(range(count))
            blocks = [s.genesis.call("blockOf", each) for each in rounds]
            s.world.mine_to(blocks[-1] + 300)
            headers = [s.world.header(block) for block in blocks]
            figures[f"reveal {count} round{'s' if count > 1 else ''}"] = s.genesis.send("reveal", rounds, headers).gas
    with s.world.attempt():
        block = s.genesis.call("blockOf", 0)
        s.world.mine_to(block + 400)
        headers = [s.world.header(number) for number in range(block + 100, block, -1)]
        figures["a late reveal, for each block"] = s.genesis.send("keepHash", block + 100, headers).gas // 100
    return figures


def added(s: Launched) -> int:
    """Return the gas that the collection adds to `tokenURI`."""
    address = bytes.fromhex(s.genesis.address[2:]).rjust(32, b"\0")
    drawn = keccak(s.genesis.call("randomnessOf", 0) + address + (1).to_bytes(32, "big"))
    assert s.metadata.call("tokenURI", 1, drawn) == s.genesis.call("tokenURI", 1)
    return s.genesis.gas_of("tokenURI", 1) - s.metadata.gas_of("tokenURI", 1, drawn)


def token_uris(s: Launched, seeds: int) -> Figures:
    """Measure gas and length over seeds, without what the collection adds."""
    gas, lengths = [], []
    for number in range(seeds):
        _, data = s.metadata.encode("tokenURI", (number, seed_of(number)))
        receipt = s.world.run(s.bob, s.metadata.address, data, 0, GAS, False, [])
        gas.append(receipt.execution)
        lengths.append(int.from_bytes(receipt.output[32:64], "big"))
    figures = {}
    for name, values in (("tokenURI", gas), ("tokenURI, bytes", lengths)):
        figures[f"{name}, mean of {seeds}"] = round(statistics.mean(values))
        figures[f"{name}, median of {seeds}"] = round(statistics.median(values))
        figures[f"{name}, most of {seeds}"] = max(values)
    figures[f"tokenURI, above 10 million, of {seeds}"] = sum(value > 10_000_000 for value in gas)
    return figures


def table(figures: Figures) -> str:
    """Return the figures as a table in Markdown."""
    lines = ["| what | gas | original |", "|---|---:|---:|"]
    for name, value in figures.items():
        lines.append(f"| {name} | {value:,} | {f'{ORIGINAL[name]:,}' if name in ORIGINAL else ''} |")
    return "\n".join(lines)


def main() -> int:
    """Measure, print and write the figures."""
    figures = take()
    return publish("tokens", figures, table(figures), PAGE, "gas")


if __name__ == "__main__":
    run_main(main)
