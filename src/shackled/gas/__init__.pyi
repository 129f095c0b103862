from ._exact import KEPT, Limit, counting, floor_gas, limits, margin, measure, needed_for, render_call
from ._fits import Fit, fit_of, fits_of, headline
from ._fitting import FITS, Fitted, fit_scene
from ._flame_graph import MARGIN, WIDTH, flame_graph
from ._profile import KINDS, STACK, Profile, profile
from ._report import GasReport, make_report
from ._runs import BAND_PIXELS, engine_calls
from ._search import FIRST_LIMIT, SearchStep, search, suffices
from ._source_map import instruction_sources, source_map
from ._stages import STAGES
from ._trace import CallFrame, places, trace

__all__ = [
    "BAND_PIXELS",
    "FIRST_LIMIT",
    "FITS",
    "KEPT",
    "KINDS",
    "MARGIN",
    "STACK",
    "STAGES",
    "WIDTH",
    "CallFrame",
    "Fit",
    "Fitted",
    "GasReport",
    "Limit",
    "Profile",
    "SearchStep",
    "counting",
    "engine_calls",
    "fit_of",
    "fit_scene",
    "fits_of",
    "flame_graph",
    "floor_gas",
    "headline",
    "instruction_sources",
    "limits",
    "make_report",
    "margin",
    "measure",
    "needed_for",
    "places",
    "profile",
    "render_call",
    "search",
    "source_map",
    "suffices",
    "trace",
]
