from ._blocks import blocks, functions
from ._exact import KEPT, counting, floor_gas, margin, measure, needed_for, render_call
from ._flame_graph import MARGIN, WIDTH, flame_graph
from ._limits import Limit, limits
from ._profile import Profile, profile
from ._report import Report, make_report
from ._runs import engine_calls
from ._search import FIRST_LIMIT, Step, search, suffices
from ._source_map import source_map
from ._speedscope import speedscope
from ._stages import STAGES
from ._trace import TRACER, Frame, can_trace, trace

__all__ = [
    "FIRST_LIMIT",
    "KEPT",
    "MARGIN",
    "STAGES",
    "TRACER",
    "WIDTH",
    "Frame",
    "Limit",
    "Profile",
    "Report",
    "Step",
    "blocks",
    "can_trace",
    "counting",
    "engine_calls",
    "flame_graph",
    "floor_gas",
    "functions",
    "limits",
    "make_report",
    "margin",
    "measure",
    "needed_for",
    "profile",
    "render_call",
    "search",
    "source_map",
    "speedscope",
    "suffices",
    "trace",
]
