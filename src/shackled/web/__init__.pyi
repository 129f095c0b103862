from ._bundle import ASSETS, asset
from ._page import check_page, export, make_page, page_template
from ._widget import view

__all__ = ["ASSETS", "asset", "check_page", "export", "make_page", "page_template", "view"]
