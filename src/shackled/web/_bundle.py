"""The files that browsers need to draw, which tools/build_web.py and tools/build_evm.py write."""

from __future__ import annotations

import base64
import gzip
from functools import cache
from importlib.resources import files

from ..evm import module_bytes

#: The files that the element needs, by name.
ASSETS = ("view.js", "evm.wasm", "contracts.json")


@cache
def asset(name: str) -> bytes:
    """Return one of the files view.js, evm.wasm, contracts.json, stages.json and template.html."""
    return module_bytes() if name == "evm.wasm" else files(__package__).joinpath(name).read_bytes()


def packed(content: bytes) -> str:
    """Return bytes in gzip and base64, as the element reads them from a page."""
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode()
