from ._deploy import deployment_gas
from ._measure import call, call_renderer, gas
from ._original import DEPLOYMENT_GAS, original, original_gas
from ._report import can_plot, millions, table
from ._runner import EXPERIMENTS, Runner

__all__ = [
    "DEPLOYMENT_GAS",
    "EXPERIMENTS",
    "Runner",
    "call",
    "call_renderer",
    "can_plot",
    "deployment_gas",
    "gas",
    "millions",
    "original",
    "original_gas",
    "table",
]
