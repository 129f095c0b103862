from ._fitting import fit_scene
from ._flame_graph import flame_graph
from ._limits import Fit, fits_of, headline, limits, measure, render_call
from ._profile import KINDS, STACK, Profile, profile
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
    "fits_of",
    "flame_graph",
    "headline",
    "limits",
    "make_report",
    "measure",
    "profile",
    "render_call",
    "savings",
    "search",
    "suffices",
]
