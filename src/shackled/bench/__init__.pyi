from ._deploy import deployment_gas
from ._engines import open_engines, time_engine
from ._linear import DIVISIONS, LOOKS, SIDES, SQUARE_SIDE, cubes, squares
from ._measure import call, call_renderer, cost, gas
from ._original import CODE_SIZES, DEPLOYMENT_GAS, original, original_gas
from ._report import ExperimentReport, millions, table, wrapped
from ._runner import EXPERIMENTS, Runner, check_names, check_plots

__all__ = [
    "CODE_SIZES",
    "DEPLOYMENT_GAS",
    "DIVISIONS",
    "EXPERIMENTS",
    "LOOKS",
    "SIDES",
    "SQUARE_SIDE",
    "ExperimentReport",
    "Runner",
    "call",
    "call_renderer",
    "check_names",
    "check_plots",
    "cost",
    "cubes",
    "deployment_gas",
    "gas",
    "millions",
    "open_engines",
    "original",
    "original_gas",
    "squares",
    "table",
    "time_engine",
    "wrapped",
]
