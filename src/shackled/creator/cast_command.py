"""A picture as a command for cast, the command line tool of Foundry."""

from __future__ import annotations

from ..artifacts import artifact
from ..chain import CallResult, EmbeddedChain
from ..errors import InputError
from ..gas import KEPT, floor_gas, render_call
from .subject import Subject

#: The longest argument of a program on Linux.
MAX_ARGUMENT = 128 * 1024 - 1


def cast_command(subject: Subject, chain: EmbeddedChain, everything: bool) -> str:
    """A shell command that has a node make the picture, and keeps it as a BMP.

    everything: the code of the contracts comes along, so that nothing need be deployed. InputError if the call is too
    long for a command line.
    """
    scene = subject.scene
    address = "0x" + chain.address("Renderer").hex()
    call = render_call(scene)
    data = "0x" + call.hex()
    if len(data) > MAX_ARGUMENT:
        raise InputError(
            f"the call has {len(data) // 2 - 1:,} bytes, too many for a command line, which takes"
            f" {MAX_ARGUMENT // 2 - 1:,}: take the calldata, or fewer triangles"
        )
    gas = _gas_limit(chain.call("Renderer", call), call)
    size = 54 + (3 * scene.width + 3) // 4 * 4 * scene.height
    overrides = ""
    if everything:
        needed = [chain.address(name) for name in ("Renderer", *artifact("Renderer").parts)]
        codes = (f"0x{place.hex()}:0x{chain.codes()[place].hex()}" for place in needed)
        overrides = "".join(f" --override-code {code}" for code in codes)
    # the answer is two words, where the bytes begin and how many they are, and then the bytes
    keep = f"cut -c131- | xxd -r -p | head -c {size} > {subject.stem}.bmp"
    node = '--rpc-url "${ETH_RPC_URL:-http://127.0.0.1:8545}"'
    return f"cast call {address} {data}{overrides} --gas-limit {gas} {node} | {keep}\n"


def _gas_limit(result: CallResult, data: bytes) -> int:
    """What the call needs, which may be more than a node gives a call that names no limit.

    A quarter is added to what it takes here, for nodes that count by the rules of another fork.
    """
    needed = max(result.intrinsic_gas + result.gas + result.gas // (KEPT - 1) + 1, floor_gas(data))
    return needed + needed // 4
