from ._preview import Preview, Request, Token
from ._project import CompilerError, Project
from ._report import check_sheet, folded, summary, write_sheet
from ._server import serve
from ._world import stored_scene

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
