from ._preview import Preview, Request, Token
from ._project import CompilerError, Project
from ._report import folded, summary
from ._server import serve
from ._world import stored_scene

__all__ = [
    "CompilerError",
    "Preview",
    "Project",
    "Request",
    "Token",
    "folded",
    "serve",
    "stored_scene",
    "summary",
]
