from ._deploy import deployment_gas
from ._linear import DIVISIONS, LOOKS, SIDES, SQUARE_SIDE, cubes, squares
from ._measure import call, call_renderer, gas
from ._original import DEPLOYMENT_GAS, original, original_gas
from ._report import millions, table
from ._runner import EXPERIMENTS, Runner, check_names, check_plots

__all__ = [
    "DEPLOYMENT_GAS",
    "DIVISIONS",
    "EXPERIMENTS",
    "LOOKS",
    "SIDES",
    "SQUARE_SIDE",
    "Runner",
    "call",
    "call_renderer",
    "check_names",
    "check_plots",
    "cubes",
    "deployment_gas",
    "gas",
    "millions",
    "original",
    "original_gas",
    "squares",
    "table",
]
