"""Animations: the nodes of a glTF document at a time."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ....base.checks import Floats
from ....errors import InputError
from ..table import Table
from .document import Document, numbers

#: What a channel moves, and how many numbers it has; weights have as many as there are morph targets.
_PATHS = {"translation": 3, "rotation": 4, "scale": 3, "weights": 0}
#: Quaternions nearer than this are interpolated in a straight line: the angle between them has no exact sine.
_NEAR = 0.9995


def posed(gltf: Document, nodes: Sequence[Table], animation: str | int, time: float) -> list[Table]:
    """Return the nodes where an animation puts them at a time in seconds, as at its nearest end outside of it."""
    keys = gltf.named(animation, "animations", "animation")
    samplers = keys.tables("samplers")
    moved: list[dict[str, Any]] = [dict(node.values) for node in nodes]
    for channel in keys.tables("channels"):
        target = channel.table("target")
        path = str(target.get("path"))
        if path not in _PATHS or "node" not in target:
            gltf.leave_out("channel", channel.where, "{} of the animation")
            continue
        node = target.index("node", len(nodes), "nodes")
        sampler = samplers[channel.index("sampler", len(samplers), "samplers")]
        moved[node][path] = _sampled(gltf, sampler, path, time).tolist()
        # it would hide what moves
        moved[node].pop("matrix", None)
    return [Table(values, node.where) for values, node in zip(moved, nodes, strict=True)]


def animation_length(path: Path, animation: str | int) -> float:
    """Return the time of the last keyframe of an animation of a file, by its name or number, in seconds."""
    gltf = Document(path)
    return _length(gltf, gltf.named(animation, "animations", "animation"))


def animations_of(path: Path) -> list[tuple[str, float]]:
    """Return the name of each animation of a file, and the time of its last keyframe in seconds."""
    gltf = Document(path)
    return [(str(each.get("name") or ""), _length(gltf, each)) for each in gltf.keys.tables("animations")]


def _length(gltf: Document, animation: Table) -> float:
    times = [numbers(gltf, sampler, "input", "SCALAR") for sampler in animation.tables("samplers")]
    return max((float(each.max()) for each in times if len(each) and np.isfinite(each).all()), default=0.0)


def _sampled(gltf: Document, sampler: Table, path: str, time: float) -> Floats:
    times = numbers(gltf, sampler, "input", "SCALAR")[:, 0].astype(np.float64)
    method = sampler.choice("interpolation", ("LINEAR", "STEP", "CUBICSPLINE"), "LINEAR")
    width, rows = _PATHS[path], 3 if method == "CUBICSPLINE" else 1
    output = numbers(gltf, sampler, "output", f"VEC{width}" if width else "SCALAR").astype(np.float64)
    if not len(times) or len(output) % (rows * len(times)) or (width and len(output) != rows * len(times)):
        raise InputError(f"{sampler.where} has {len(output)} values for {len(times)} keyframes of {method}")
    if not np.isfinite(times).all() or (np.diff(times) < 0).any():
        raise InputError(f"{sampler.place('input')} must be times in ascending order")
    values = output.reshape(len(times), rows, -1)
    if not np.isfinite(values).all():
        raise InputError(f"{sampler.place('output')} must be finite numbers")
    at = int(np.searchsorted(times, time, "right")) - 1
    if at < 0 or at == len(times) - 1 or method == "STEP":
        return np.asarray(values[max(at, 0), rows // 2])
    step = times[at + 1] - times[at]
    share = (time - times[at]) / step
    if method == "CUBICSPLINE":
        return _spline(values[at], values[at + 1], step, share)
    one, other = values[at, 0], values[at + 1, 0]
    return _turned(one, other, share) if path == "rotation" else one + share * (other - one)


def _spline(one: Floats, other: Floats, step: float, s: float) -> Floats:
    """Return what lies between two keyframes, each of an incoming tangent, a value and an outgoing tangent."""
    return np.asarray(
        (2 * s**3 - 3 * s**2 + 1) * one[1]
        + step * (s**3 - 2 * s**2 + s) * one[2]
        + (3 * s**2 - 2 * s**3) * other[1]
        + step * (s**3 - s**2) * other[0]
    )


def _turned(one: Floats, other: Floats, share: float) -> Floats:
    """Return the rotation between two quaternions, on the shorter way."""
    cosine = float(one @ other)
    if cosine < 0:
        other, cosine = -other, -cosine
    if cosine > _NEAR:
        return one + share * (other - one)
    angle = np.arccos(cosine)
    return np.asarray((np.sin((1 - share) * angle) * one + np.sin(share * angle) * other) / np.sin(angle))
