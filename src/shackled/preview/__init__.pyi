from ._arguments import Call, parse_call, parse_value
from ._document import Document, File, judge, judge_picture
from ._findings import folded
from ._library import library_codes, stored_scene
from ._preview import Preview, Request, Token
from ._project import Compiled, CompilerError, Project
from ._quantities import in_units
from ._server import Live, serve
from ._sheet import check_sheet, write_sheet
from ._summary import summary
from ._world import MAX_GAS, World

__all__ = [
    "MAX_GAS",
    "Call",
    "Compiled",
    "CompilerError",
    "Document",
    "File",
    "Live",
    "Preview",
    "Project",
    "Request",
    "Token",
    "World",
    "check_sheet",
    "folded",
    "in_units",
    "judge",
    "judge_picture",
    "library_codes",
    "parse_call",
    "parse_value",
    "serve",
    "stored_scene",
    "summary",
    "write_sheet",
]
