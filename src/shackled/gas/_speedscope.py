"""Export a profile to speedscope, a viewer of flame graphs: https://www.speedscope.app."""

from __future__ import annotations

from typing import Any

from .._version import __version__
from ._profile import LineCost, Profile

SCHEMA = "https://www.speedscope.app/file-format-schema.json"


def speedscope(profile: Profile, name: str) -> dict[str, Any]:
    """Return the content of the JSON file: stages hold functions, which hold lines; the weights are gas."""
    frames: dict[tuple[str, str, int], int] = {}
    costs = sorted(profile.costs, key=lambda cost: (cost.stage, cost.calls, cost.file, cost.line))
    samples = [[frames.setdefault(frame, len(frames)) for frame in _frames(cost)] for cost in costs]
    return {
        "$schema": SCHEMA,
        "exporter": f"shackled {__version__}",
        "name": name,
        "activeProfileIndex": 0,
        "shared": {"frames": [_frame(*frame) for frame in frames]},
        "profiles": [
            {
                "type": "sampled",
                "name": f"{name}, gas",
                "unit": "none",
                "startValue": 0,
                "endValue": profile.gas,
                "samples": samples,
                "weights": [cost.gas for cost in costs],
            }
        ],
    }


def _frames(cost: LineCost) -> list[tuple[str, str, int]]:
    return [(cost.stage, "", 0), *((call, "", 0) for call in cost.calls), (cost.place, cost.file, cost.line)]


def _frame(name: str, file: str, line: int) -> dict[str, Any]:
    return {"name": name, "file": file, "line": line} if file else {"name": name}
