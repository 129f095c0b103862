from ._bundle import asset
from ._page import check_page, export
from ._widget import view

__all__ = ["asset", "check_page", "export", "view"]
