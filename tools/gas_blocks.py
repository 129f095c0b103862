"""Print where the gas of one function of a contract goes: its basic blocks with counts, gas and instructions.

    python tools/gas_blocks.py teapot                              the functions of the engine, the dearest first
    python tools/gas_blocks.py teapot LinearSpans.plain             the blocks of one of them
    python tools/gas_blocks.py --call Genesis 0x5d6c... Layouts.fits    of a call of another contract, by its data

Of a scene (a file, a name, a piece of a dataset) the call is `Renderer.render`. Look for what repeats: a value that is
taken out of a word again at each use, and long rows of DUP and SWAP, mean that the function has a variable too many.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from shackled import load
from shackled.errors import ShackledError
from shackled.gas import Frame, blocks, functions, render_call, trace


def main(arguments: Sequence[str] | None = None) -> int:
    """The command."""
    text = __doc__ or ""
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input", nargs="?", help="a scene, unless there is --call")
    parser.add_argument("function", nargs="?", help="such as Rasterizer.rows; none: a list of all")
    parser.add_argument("--call", nargs=2, metavar=("CONTRACT", "DATA"), help="call this contract with these bytes")
    parser.add_argument("--contract", help="whose functions; else Engine, or the one that is called")
    options = parser.parse_args(arguments)
    # with --call there is no scene, and what comes first is the function
    function = options.input if options.call else options.function
    if not options.call and options.input is None:
        parser.error("a scene or --call is needed")
    try:
        if options.call:
            called, data = options.call[0], bytes.fromhex(options.call[1].removeprefix("0x"))
        else:
            called, data = "Renderer", render_call(load(options.input))
        root, result = trace(called, data)
    except (ShackledError, ValueError) as error:
        print(error, file=sys.stderr)
        return 1
    contract = options.contract or (called if options.call else "Engine")
    print(f"{result.gas:,} gas in all")
    return _print_functions(root, contract) if function is None else _print_blocks(root, contract, function)


def _print_functions(root: Frame, contract: str) -> int:
    for name, gas in functions(root, contract):
        print(f"{gas:12,} {name}")
    return 0


def _print_blocks(root: Frame, contract: str, function: str) -> int:
    found = blocks(root, contract, function)
    if not found:
        print(f"{function} was not called in {contract}", file=sys.stderr)
        return 1
    for block in found:
        print(f"{block.begin:6} x {block.count:<8,}{block.gas:10,} gas  {' '.join(block.instructions)}")
    print(f"{sum(block.gas for block in found):,} gas in {function}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
