from ._findings import folded
from ._library import stored_scene
from ._preview import Preview, Request, Token
from ._project import CompilerError, Project
from ._server import serve
from ._sheet import check_sheet, write_sheet
from ._summary import summary

__all__ = [
    "CompilerError",
    "Preview",
    "Project",
    "Request",
    "Token",
    "check_sheet",
    "folded",
    "serve",
    "stored_scene",
    "summary",
    "write_sheet",
]
