"""Compares the contracts with the reference renderer, byte for byte, over random scenes.

    python tests/differential.py --count 2000 --seed 1

Every seed makes one scene; what differs is printed with its seed, and the exit code is 1 then.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter

import numpy as np

from random_scenes import KINDS, Case, random_case
from shackled import reference
from shackled.artifacts import artifact
from shackled.chain import ContractChain, open_chain
from shackled.errors import RenderError
from shackled.image import decode_bmp
from shackled.scene.codec import Rectangle, encode_scene
from shackled.scene.scene import Scene


def call_data(function: str, scene: Scene, tile: Rectangle | None = None) -> bytes:
    """The call of a function of the Renderer, with the numbers of the scene as they are."""
    words = [0x20] if tile is None else [0xA0, tile.x, tile.y, tile.width, tile.height]
    head = b"".join(word.to_bytes(32, "big") for word in words)
    return artifact("Renderer").selectors[function] + head + encode_scene(scene)


def contract_answer(chain: ContractChain, data: bytes) -> bytes | str:
    """What the contract returns, or the error that it reverts with."""
    try:
        return chain.call("Renderer", data).output
    except RenderError as error:
        return str(error)


def reference_answer(data: bytes, counted: bool) -> bytes | str:
    """The same, by the reference."""
    try:
        picture = reference.draw_call(data)
    except RenderError as error:
        return str(error)
    bmp = reference.encode_bmp(picture.pixels)
    words = [0x60, picture.triangles, picture.lit_pixels, len(bmp)] if counted else [0x20, len(bmp)]
    return b"".join(word.to_bytes(32, "big") for word in words) + bmp + bytes(-len(bmp) % 32)


def difference(chain: ContractChain, data: bytes, counted: bool) -> str | None:
    """How contract and reference differ; None if they do not."""
    contract, expected = contract_answer(chain, data), reference_answer(data, counted)
    if contract == expected:
        return None
    if isinstance(contract, str) or isinstance(expected, str) or len(contract) != len(expected):
        return f"contract {_brief(contract)}, reference {_brief(expected)}"
    bad = np.flatnonzero(np.frombuffer(contract, np.uint8) != np.frombuffer(expected, np.uint8))
    where = ", ".join(f"byte {place}: {contract[place]} for {expected[place]}" for place in bad[:3])
    return f"{len(bad)} of {len(expected)} bytes differ; {where}"


def compare(case: Case, chain: ContractChain) -> str | None:
    """How contract and reference differ over a case, as a whole and in a tile; None if they do not."""
    for name, data in (
        ("renderCounted", call_data("renderCounted", case.scene)),
        ("renderTile", call_data("renderTile", case.scene, case.tile)),
    ):
        found = difference(chain, data, counted=name == "renderCounted")
        if found is not None:
            return f"{name}: {found}"
    # and a part of the picture is that part of the whole
    return _tile_difference(case, chain)


def _tile_difference(case: Case, chain: ContractChain) -> str | None:
    whole, part = (
        contract_answer(chain, call_data(function, case.scene, tile))
        for function, tile in (("render", None), ("renderTile", case.tile))
    )
    if isinstance(whole, str) or isinstance(part, str):
        return None if whole == part else f"whole {_brief(whole)}, tile {_brief(part)}"
    scene, tile = case.scene, case.tile
    pixels = decode_bmp(_file(whole), scene.width, scene.height)
    cut = pixels[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width]
    if (cut != decode_bmp(_file(part), tile.width, tile.height)).any():
        return f"the tile {tile} is not that part of the whole"
    return None


def _file(output: bytes) -> bytes:
    return output[64 : 64 + int.from_bytes(output[32:64], "big")]


def _brief(answer: bytes | str) -> str:
    return answer if isinstance(answer, str) else f"{len(answer)} bytes"


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--count", type=int, default=2000, help="how many scenes")
    parser.add_argument("--seed", type=int, default=1, help="the seed of the first scene")
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS, help="how wild their geometry is")
    parser.add_argument("--chain", default="pyrevm", choices=["pyrevm", "pyevm"], help="where the contracts run")
    arguments = parser.parse_args()
    chain = open_chain(arguments.chain)
    assert isinstance(chain, ContractChain)
    results: Counter[str] = Counter()
    started = time.perf_counter()
    for seed in range(arguments.seed, arguments.seed + arguments.count):
        case = random_case(seed, tuple(arguments.kinds))
        found = compare(case, chain)
        answer = reference_answer(call_data("renderCounted", case.scene), counted=True)
        if found is not None:
            results["different"] += 1
            print(f"seed {seed}: {found}", flush=True)
        elif isinstance(answer, str):
            results[f"equal, refused by both ({answer.partition(': ')[2].partition('(')[0]})"] += 1
        else:
            results["equal" if int.from_bytes(answer[64:96], "big") else "equal, nothing drawn"] += 1
    seconds = time.perf_counter() - started
    print(f"{arguments.count} scenes in {seconds:.0f} s: {', '.join(f'{n} {name}' for name, n in sorted(results.items()))}")
    return 1 if results["different"] else 0


if __name__ == "__main__":
    sys.exit(main())
