from ._listening import listen, open_in_browser, run, url_of
from ._security import HEADERS, LOCAL, SameOrigin

__all__ = ["HEADERS", "LOCAL", "SameOrigin", "listen", "open_in_browser", "run", "url_of"]
