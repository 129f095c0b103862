from ._fitting import fit_scene
from ._flame_graph import flame_graph
from ._limits import Fit, fits_as_json, fits_of, headline, known_chains, limits, measure, render_call
from ._profile import KINDS, STACK, Profile, profile
from ._quick_path import missed_quick_path, quick_path_note
from ._report import GasReport, make_report
from ._savings import savings
from ._search import SearchStep, search, suffices
from ._stages import STAGES

__all__ = [
    "KINDS",
    "STACK",
    "STAGES",
    "Fit",
    "GasReport",
    "Profile",
    "SearchStep",
    "fit_scene",
    "fits_as_json",
    "fits_of",
    "flame_graph",
    "headline",
    "known_chains",
    "limits",
    "make_report",
    "measure",
    "missed_quick_path",
    "profile",
    "quick_path_note",
    "render_call",
    "savings",
    "search",
    "suffices",
]
