"""Files that contracts make of a scene in one call: animated PNG files and models."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..animation import DURATION, check_duration
from ..artifacts import artifact
from ..base.checks import vector, whole
from ..chain._chain import ContractChain, returned_bytes
from ..chain._node import NodeChain
from ..chain._opening import open_chain, open_node
from ..contract_file import ContractFile
from ..errors import InputError, VerificationError
from ..ethereum._encoding import intrinsic_gas
from ..parallel.places import Nodes, On
from ..scene._codec import encode
from ..scene._scene import Scene

#: The most frames of an animated PNG file that a contract makes.
MOST_FRAMES = 360
#: The largest square that a pixel can become.
MOST_SCALE = 8
ONE = 1 << 32


def make_apng(
    scene: Scene,
    frames: int = 12,
    duration: int = DURATION,
    scale: int = 1,
    axis: ArrayLike = (0, 1, 0),
    hold: bool = True,
    on: On | None = None,
    gas_limit: int | None = None,
) -> ContractFile:
    """Have the contract Turntable make an animated PNG file of a full turn, in one call.

    frames: 2..360. duration: of a frame in milliseconds, 20..10,000. scale: side of the square that each pixel becomes,
    1..8. axis: (x, y, z), from whose end the turn is counter-clockwise. hold: whether the camera is moved back until
    nothing leaves the picture. on: the name of an EVM, or Nodes, of which the first is called and its answer compared
    with that of the embedded EVM, unless `verify` is "none".
    """
    around = vector(axis, "the axis of a turn")
    if not around.any():
        raise InputError("the axis of a turn must not be (0, 0, 0)")
    words = (
        whole(frames, "the number of frames of a turntable", 2, MOST_FRAMES),
        check_duration(duration),
        whole(scale, "the scale of a picture", 1, MOST_SCALE),
        *(round(part * ONE) for part in (around / np.abs(around).max()).tolist()),
        int(hold),
    )
    data = encode(artifact("Turntable").selectors["animate"], scene, None, *words)
    return _made("Turntable", data, "image/png", on, gas_limit)


def make_glb(scene: Scene, on: On | None = None, gas_limit: int | None = None) -> ContractFile:
    """Have the contract GlbEncoder make a binary glTF file of the objects of a scene, in one call.

    on: as in `make_apng`.
    """
    data = encode(artifact("GlbEncoder").selectors["encode"], scene)
    return _made("GlbEncoder", data, "model/gltf-binary", on, gas_limit)


def _made(contract: str, data: bytes, media_type: str, on: On | None, gas_limit: int | None) -> ContractFile:
    chain = _chain(on)
    result = chain.call(contract, data, gas_limit)
    is_checked = isinstance(on, Nodes) and on.verify != "none"
    if is_checked and result.output != _chain(None).call(contract, data).output:
        raise VerificationError(f"the {chain.name} returned another file than the embedded EVM: use another node")
    content = returned_bytes(result.output)
    return ContractFile(content, media_type, result.gas, intrinsic_gas(data), chain.name)


def _chain(on: On | None) -> ContractChain | NodeChain:
    if isinstance(on, Nodes):
        return open_node(on.urls[0], on.address, on.timeout)
    chain = open_chain(on) if on is None or isinstance(on, str) else on
    if not isinstance(chain, ContractChain | NodeChain):
        raise InputError("a file of one call needs an EVM that runs the contracts, or a node; not several processes")
    return chain
