"""What the contracts return for small scenes of every kind: digests of pixels and files, and gas.

    python tests/support/golden.py            tells what differs from golden.json
    python tests/support/golden.py --write    and writes it there

A change of pixels shows in the diff of golden.json as a change of gas does; a refactoring leaves the file alone.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

if __name__ == "__main__":
    root = Path(__file__).parents[2]
    sys.path[:0] = map(str, (root / "tests", root / "contracts", root))

from original_scenes import call_data, document, genesis_document, object_keys
from pictures import chain
from random_scenes import KINDS, random_case
from shackled import Scene
from shackled.artifacts import artifact
from shackled.chain._embedded import EmbeddedChain
from shackled.datasets._pieces import require
from shackled.datasets.genesis import seed_of
from shackled.errors import ChainError
from shackled.image import encode_bmp
from shackled.scene import encode
from shackled.scene._codec import Rectangle
from shackled.scene._look import resize
from shackled.studio import store_scene
from shackled.studio._storage import ANIMATE

FILE = Path(__file__).with_name("golden.json")

#: By name: 16 hexadecimal digits of the SHA-256 of what is returned, and the execution gas.
Golden = dict[str, tuple[str, int]]

#: The seeds of random scenes of each kind, and the gas of a call.
SEEDS, GAS = range(1, 31), 1 << 28
PIECES = (
    *("teapot", "cornell-box", "cylinder", "dodecahedron", "icons/ethereum", "icons/diamond", "icons/crown"),
    *(f"genesis/{number}" for number in range(4)),
)
#: Where the Studio of the stored scenes is: their pointers follow from it, and are to stay when contracts change.
STUDIO = bytes(range(1, 21))
NO_CHANGES = (0, (0, 0, 0, 0), 0, (0, 0), 0, (0, 0))


@dataclass(frozen=True)
class Call:
    """A call of the code at an address. codes: what is stored for it, by address."""

    address: bytes
    data: bytes
    codes: Mapping[bytes, bytes]

    def run(self) -> tuple[str, int]:
        """The digest and the gas; the name of the error of a call that fails, and no gas."""
        for address, code in self.codes.items():
            evm().put(address, code)
        try:
            result = evm().run(self.address, self.data, GAS)
        except ChainError as error:
            return type(error).__name__, 0
        return sha256(result.output).hexdigest()[:16], result.gas


def evm() -> EmbeddedChain:
    found = chain()
    assert isinstance(found, EmbeddedChain)
    return found


@cache
def scenes() -> dict[str, Scene]:
    """Random scenes of every kind, then built-in pieces, by name."""
    found = {f"{kind} {seed}": random_case(seed, kind).scene for kind in KINDS for seed in SEEDS if kind != "models"}
    for piece in PIECES:
        found[f"piece {piece}"] = resize(require(piece).make(), (32, 24))
    for size in ((1, 1), (1, 40), (40, 1)):
        found[f"piece cube {size[0]} x {size[1]}"] = resize(require("cube").make(), size)
    return found


# ---- calls ----


def calls() -> dict[str, Call]:
    """What is called, by name."""
    found = {name: call_of("Renderer", "render", scene) for name, scene in scenes().items()}
    return found | dict(functions()) | dict(files()) | dict(stored()) | dict(of_genesis()) | dict(of_the_original())


def call_of(contract: str, function: str, scene: Scene, tile: Rectangle | None = None, *words: int) -> Call:
    return called(contract, encode(artifact(contract).selectors[function], scene, tile, *words))


def called(contract: str, data: bytes) -> Call:
    return Call(evm().address(contract), data, {})


def functions() -> Iterator[tuple[str, Call]]:
    """The other functions of the Renderer."""
    names = ("renderTile", "renderCounted", "renderTileCounted", "renderDataURI", "renderSVG")
    for function, kind, seed in product(names, ("plain", "antialiased"), SEEDS[:2]):
        case = random_case(seed, kind)
        tile = case.tile if "Tile" in function else None
        yield f"{function} {kind} {seed}", call_of("Renderer", function, case.scene, tile)


def files() -> Iterator[tuple[str, Call]]:
    """Files that contracts make: PNG, animated PNG, GLB."""
    random = np.random.default_rng(1)
    areas = np.add.outer(np.arange(21) // 5, np.arange(30) // 7)[..., None] * [20, 10, 5]
    noise = random.integers(0, 256, (21, 30, 3))
    for (name, pixels), scale in product({"areas": areas, "noise": noise}.items(), (1, 3)):
        pictures = [encode_bmp(each.astype(np.uint8)) for each in (pixels // 2, pixels // 2 + 100)]
        for title, signature, given in (
            ("", "encode(bytes,uint256)", pictures[:1]),
            (" transparent", "encodeTransparent(bytes,bytes,uint256)", pictures),
        ):
            data = artifact("PngEncoder").interface.encode(signature, *given, scale)
            yield f"PNG{title} {name} x {scale}", called("PngEncoder", data)
    for kind in ("plain", "antialiased", "wires", "effects"):
        scene = resize(random_case(2, kind).scene, (20, 16))
        yield f"animated PNG {kind}", call_of("Turntable", "animate", scene, None, 3, 80, 2, 0, 1 << 32, 0, 1)
    for kind, seed in product(("plain", "wires", "glass", "textures", "shadows", "contacts"), SEEDS[:2]):
        yield f"GLB {kind} {seed}", call_of("GlbEncoder", "encode", random_case(seed, kind).scene)


def stored() -> Iterator[tuple[str, Call]]:
    """What the Studio makes of scenes that it stores."""
    interface = artifact("Studio").interface
    functions: dict[str, tuple[Any, ...]] = {
        "render(address)": (),
        "renderPNG(address,uint256)": (2,),
        "renderTransparentPNG(address,uint256)": (1,),
        "renderSVG(address,uint256)": (1,),
        "glb(address)": (),
        ANIMATE: ((2, 80, 1, (0, 1 << 32, 0), True), NO_CHANGES),
    }
    for kind, (signature, given) in product(("plain", "antialiased"), functions.items()):
        name = f"stored {kind} {signature.partition('(')[0]}"
        transactions = store_scene(random_case(3, kind).scene, STUDIO)
        pointer = "0x" + transactions[-1].pointer.hex()
        codes = {STUDIO: evm().code("Studio")} | {each.pointer: each.code for each in transactions}
        yield name, Call(STUDIO, interface.encode(signature, pointer, *given), codes)


def of_genesis() -> Iterator[tuple[str, Call]]:
    """The collection Genesis from seeds, and what its tokens say."""
    for number, function in (*product(range(3), ("generate", "render")), (3, "renderSVG"), (4, "renderDataURI")):
        data = artifact("Genesis").interface.encode(function, seed_of(number))
        yield f"Genesis {number} {function}", called("Genesis", data)
    for number in range(2):
        data = artifact("GenesisMetadata").interface.encode("tokenURI", number, seed_of(number))
        yield f"Genesis {number} tokenURI", called("GenesisMetadata", data)


def of_the_original() -> Iterator[tuple[str, Call]]:
    """The interface of the original contracts."""
    solid, light = object_keys("dodecahedron"), {"lightPos": [-20, 20, 30]}
    orthographic = {"perspCamera": False, "objScale": 20, "objPosition": [0, 0, -90000]}
    for name, given in {
        "unlit": document(32, **solid),
        "lit": document(32, light, **solid),
        "lit orthographic": document(24, light, **solid, **orthographic),
        "wireframe": document(24, **solid, wireframe=True, backfaceCulling=False),
        "inverted": document(24, light, **solid, invert=True),
        "genesis": genesis_document(2, 32),
    }.items():
        for svg in (False, True)[: 1 + (name == "lit")]:
            yield f"Original {name}{' SVG' * svg}", called("Original", call_data(given, svg))


# ---- the file ----


def take() -> Golden:
    """Makes all calls."""
    return {name: each.run() for name, each in calls().items()}


def recorded() -> Golden:
    """What golden.json says."""
    return {name: (digest, gas) for name, (digest, gas) in json.loads(FILE.read_text("utf-8")).items()}


def write(golden: Golden) -> None:
    """Writes golden.json, a line for each name, sorted."""
    lines = [f"{json.dumps(name)}: {json.dumps(golden[name])}" for name in sorted(golden)]
    FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n", "utf-8", newline="\n")


def differences(old: Golden, new: Golden) -> list[str]:
    """What changed, a line for each name; pixels first."""
    pixels: list[str] = []
    gas: list[str] = []
    for name in sorted(old.keys() | new.keys()):
        if name not in old or name not in new:
            pixels.append(f"{name}: {'is not recorded yet' if name in new else 'is not made any more'}")
            continue
        (was, gas_was), (now, gas_now) = old[name], new[name]
        parts = [f"pixels {was} -> {now}"] if was != now else []
        if gas_was != gas_now:
            change = f", {(gas_now - gas_was) / gas_was:+.2%}" if gas_was else ""
            parts.append(f"gas {gas_was:,} -> {gas_now:,} ({gas_now - gas_was:+,}{change})")
        if parts:
            (pixels if was != now else gas).append(f"{name}: {', '.join(parts)}")
    return pixels + gas


def main() -> int:
    """Runs the command."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--write", action="store_true", help="write golden.json")
    is_written = parser.parse_args().write
    new = take()
    changed = differences(recorded() if FILE.exists() else {}, new)
    print("\n".join(changed) or f"none of {len(new)} scenes has changed")
    if is_written:
        write(new)
    return int(bool(changed) and not is_written)


if __name__ == "__main__":
    sys.exit(main())
