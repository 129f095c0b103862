from ._fitting import fit_scene
from ._limits import known_chains, limits, measure, render_call
from ._profile import profile
from ._quick_path import missed_quick_path
from ._search import search, suffices

__all__ = [
    "fit_scene",
    "known_chains",
    "limits",
    "measure",
    "missed_quick_path",
    "profile",
    "render_call",
    "search",
    "suffices",
]
