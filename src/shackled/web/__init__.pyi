from ._bundle import ASSETS, asset
from ._page import check_page, export
from ._widget import view

__all__ = [
    "ASSETS",
    "asset",
    "check_page",
    "export",
    "view",
]
