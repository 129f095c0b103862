"""A scene as a page of one file, which draws it in the browser of its reader."""

from __future__ import annotations

import base64
import gzip
import hashlib
import os
import re
from functools import cache
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Unpack

from .._load import Thing, load_picture, locate
from .._render import render
from ..base.values import plural
from ..base.whole_file import check_output_file, write_output
from ..datasets._pieces import Piece
from ..errors import InputError
from ..evm._module import module_bytes
from ..image import Image
from ..scene._codec import render_call
from ..scene._settings import LookOptions

#: The files that the element needs, by name; tools/build_web.py and tools/build_evm.py write them.
ASSETS = ("view.js", "evm.wasm", "contracts.json")
#: The extensions of pages.
EXTENSIONS = (".html", ".htm")
#: The most gas that the element uses for a picture, and the most bytes of a call: web/src/evm and web/src/view.
GAS_LIMIT = 30_000_000_000
MAX_CALL = 1 << 24
#: The most bytes of a PNG file within a page.
MAX_PNG = 1 << 19


def export(
    thing: Thing,
    path: str | os.PathLike[str],
    size: int | tuple[int, int] | None = None,
    *,
    title: str | None = None,
    **look: Unpack[LookOptions],
) -> Image:
    """Write a scene as a page of one file, on which it can be turned; return its picture.

    The page opens from disk in any browser, without a server or a network. There the contracts' own bytecode draws the
    scene, with the pixels of `render`.

    thing, size, look: as in `load`. path: of an HTML file.
    title: of the page; None for that of the piece, or else the name of the HTML file.
    InputError for an invalid scene, one that is too large for a browser, or a wrong path.
    """
    target = check_page(path)
    found = locate(thing) if isinstance(thing, str | os.PathLike) else thing
    image = render(load_picture(found, size, **look))
    piece = found if isinstance(found, Piece) else None
    name = title if title is not None else piece.title if piece else target.stem
    write_output(target, make_page(image, name, piece.notice if piece else ""))
    return image


def check_page(path: str | os.PathLike[str]) -> Path:
    """Return the path, if a page can be written there. InputError if not."""
    path = Path(path)
    if path.suffix.lower() not in EXTENSIONS:
        hint = "; the command `shackled export` writes models" if path.suffix.lower() == ".glb" else ""
        raise InputError(f"the page {path} must end in {EXTENSIONS[0]}{hint}")
    return check_output_file(path, "page")


def make_page(image: Image, title: str, notice: str = "") -> bytes:
    """Return the page of a picture whose scene is known, as an HTML file. InputError if it is too large for a browser.

    notice: credit and terms to show, or "".
    """
    assert image.scene is not None
    call = render_call(image.scene)
    if len(call) > MAX_CALL:
        raise InputError(
            f"the scene has {len(call):,} bytes, of which a page may have {MAX_CALL:,}: reduce it by `max_triangles`"
        )
    if image.gas is not None and image.gas > GAS_LIMIT:
        raise InputError(
            f"the picture takes {image.gas:,} gas, of which a browser uses at most {GAS_LIMIT:,}: give a smaller `size`"
        )
    name = escape(title)
    picture = image.encode(".png")
    if len(picture) > MAX_PNG:
        picture = image.encode(".png", scene=False)
    size = f'width="{image.width}" height="{image.height}"'
    still = f'<img src="data:image/png;base64,{base64.b64encode(picture).decode()}" alt="{name}" {size}>'
    if len(picture) > MAX_PNG:
        still = "<noscript><p>The picture is drawn by a script.</p></noscript>"
    values = {
        "title": name,
        "still": still,
        "triangles": plural(sum(len(each.mesh.faces) for each in image.scene.objects), "triangle"),
        "width": str(image.width),
        "height": str(image.height),
        "gas": "" if image.gas is None else f", {image.gas:,} gas",
        "sha256": image.sha256,
        "notice": f"<p>{escape(notice)}</p>" if notice else "",
        "scene": _packed(call),
        "evm": _packed_asset("evm.wasm"),
        "contracts": _packed_asset("contracts.json"),
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda found: values[found[1]], page_template()).encode()


@cache
def page_template() -> str:
    """Return the page with places for the values of `make_page`: {{title}}, {{scene}} and so on."""
    text, script = asset("template.html").decode(), asset("view.js").decode()
    assert not re.search("</script|<!--", script, re.IGNORECASE)
    style = text[text.index("<style>") + len("<style>") : text.index("</style>")]
    policy = (
        f"default-src 'none'; script-src '{_hash(script)}' 'wasm-unsafe-eval'; worker-src blob:; "
        f"style-src '{_hash(style)}'; img-src data:; connect-src http: https:; base-uri 'none'; form-action 'none'"
    )
    return text.replace("{{policy}}", policy).replace("{{script}}", script)


@cache
def asset(name: str) -> bytes:
    """Return a file that browsers need to draw: view.js, evm.wasm, contracts.json, stages.json or template.html."""
    return module_bytes() if name == "evm.wasm" else files(__package__).joinpath(name).read_bytes()


@cache
def _packed_asset(name: str) -> str:
    return _packed(asset(name))


def _packed(content: bytes) -> str:
    """Return bytes in gzip and base64, as the element reads them from a page."""
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode()


def _hash(text: str) -> str:
    """Return a source of a content security policy that allows a script or style with this text."""
    return f"sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}"
