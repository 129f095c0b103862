"""Compares the contracts with the reference renderer, byte for byte, over random scenes.

    python tests/differential.py --count 2000 --seed 1
    python tests/differential.py --count 100000 --processes 2
    python tests/differential.py --count 2000 --broken

Every seed makes one scene, of which the whole and a tile are drawn, or with --broken one call in which some bytes are
wrong. What differs is printed with its seed, and the exit code is 1 then, or if less than 95 % of the scenes that were
drawn show something.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections import Counter
from functools import partial
from multiprocessing import get_context

import numpy as np

from pictures import call_data, dynamic, words
from random_scenes import KINDS, Case, Kind, broken_call, random_case
from shackled import reference
from shackled.chain import ContractChain, open_chain
from shackled.errors import ChainError
from shackled.image import decode_bmp

#: What a function returns, or the message of the error that it reverts with.
Answer = bytes | str


def contract_answer(chain: ContractChain, data: bytes) -> Answer:
    """What a call of the Renderer gives."""
    try:
        return chain.call("Renderer", data).output
    except ChainError as error:
        return str(error)


def reference_answer(data: bytes) -> Answer:
    """What the same call should give."""
    try:
        picture = reference.draw_call(data)
    except ChainError as error:
        return str(error)
    bmp = reference.encode_bmp(picture.pixels)
    counted = data[:4] == reference.selector("renderCounted")
    head = words(0x60, picture.triangles, picture.lit_pixels) if counted else words(0x20)
    return head + words(len(bmp)) + bmp + bytes(-len(bmp) % 32)


def difference(contract: Answer, expected: Answer) -> str | None:
    """How two answers differ; None if they do not."""
    if contract == expected:
        return None
    if isinstance(contract, str) or isinstance(expected, str) or len(contract) != len(expected):
        return f"contract: {_brief(contract)}; reference: {_brief(expected)}"
    bad = np.flatnonzero(np.frombuffer(contract, np.uint8) != np.frombuffer(expected, np.uint8))
    where = ", ".join(f"byte {place}: {contract[place]} for {expected[place]}" for place in bad[:3])
    return f"{len(bad)} of {len(expected)} bytes differ; {where}"


def compare(case: Case, chain: ContractChain) -> tuple[str | None, Answer]:
    """How contract and reference differ over a case, None if they do not; and what the contract counted and drew."""
    data = call_data("renderCounted", case.scene)
    whole = contract_answer(chain, data)
    found = difference(whole, reference_answer(data))
    if found is not None:
        return f"the whole: {found}", whole
    data = call_data("renderTile", case.scene, case.tile)
    part = contract_answer(chain, data)
    found = difference(part, reference_answer(data))
    if found is not None:
        return f"{case.tile}: {found}", whole
    if isinstance(whole, bytes) and isinstance(part, bytes):
        scene, tile = case.scene, case.tile
        pixels = decode_bmp(dynamic(whole), scene.width, scene.height)
        cut = pixels[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width]
        if (cut != decode_bmp(dynamic(part), tile.width, tile.height)).any():
            return f"{case.tile} is not that part of the whole", whole
    return None, whole


def compare_broken(seed: int, chain: ContractChain) -> tuple[str | None, Answer]:
    """The same for one call that is wrong somewhere."""
    data = broken_call(seed, call_data("renderCounted", random_case(seed).scene))
    answer = contract_answer(chain, data)
    return difference(answer, reference_answer(data)), answer


def _brief(answer: Answer) -> str:
    return answer if isinstance(answer, str) else f"{len(answer)} bytes"


def _outcome(answer: Answer) -> str:
    if isinstance(answer, str):
        return "equal, refused by both"
    return "equal" if int.from_bytes(answer[64:96], "big") else "equal, with nothing drawn"


def outcome(seed: int, kinds: tuple[Kind, ...], broken: bool, chain: str | None) -> tuple[int, str, str | None]:
    """The seed, what became of its case in a word or two, and how the answers differ if they do."""
    place = open_chain(chain)
    assert isinstance(place, ContractChain)
    found, answer = compare_broken(seed, place) if broken else compare(random_case(seed, kinds), place)
    return seed, "different" if found else _outcome(answer), found


#: Of the scenes that are drawn so many show something.
LEAST_DRAWN = 0.95
#: Seconds between two lines of progress.
PAUSE = 30


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--count", type=int, default=2000, help="how many scenes")
    parser.add_argument("--seed", type=int, default=1, help="the seed of the first scene")
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS, help="how wild their geometry is")
    parser.add_argument("--broken", action="store_true", help="break the calls")
    parser.add_argument("--chain", choices=["pyrevm", "pyevm"], help="where the contracts run")
    parser.add_argument("--processes", type=int, default=1, help="how many work at once")
    arguments = parser.parse_args()
    # one thread each: the arrays of small pictures are small
    os.environ |= dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1")
    work = partial(outcome, kinds=tuple(arguments.kinds), broken=arguments.broken, chain=arguments.chain)
    seeds = range(arguments.seed, arguments.seed + arguments.count)
    results: Counter[str] = Counter()
    started = told = time.perf_counter()
    with get_context("spawn").Pool(arguments.processes) as pool:
        for seed, result, found in pool.imap_unordered(work, seeds, chunksize=8):
            results[result] += 1
            if found:
                print(f"seed {seed}: {found}", flush=True)
            now = time.perf_counter()
            if now - told > PAUSE:
                told, done = now, results.total()
                left = (now - started) * (arguments.count - done) / done / 60
                print(f"{done:,} of {arguments.count:,}, {left:.0f} min left", file=sys.stderr, flush=True)
    seconds = time.perf_counter() - started
    drawn = results["equal"] / max(1, results["equal"] + results["equal, with nothing drawn"])
    told_results = ", ".join(f"{n} {name}" for name, n in sorted(results.items()))
    print(f"{arguments.count} in {seconds:.0f} s ({arguments.count / seconds:.1f} a second): {told_results}")
    print(f"{drawn:.1%} of what was drawn shows something")
    return 1 if results["different"] or (drawn < LEAST_DRAWN and not arguments.broken) else 0


if __name__ == "__main__":
    sys.exit(main())
