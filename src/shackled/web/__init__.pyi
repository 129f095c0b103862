from ._page import ASSETS, asset, check_page, export
from ._widget import view

__all__ = [
    "ASSETS",
    "asset",
    "check_page",
    "export",
    "view",
]
