"""shackled export"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import Any

from .._load import locate
from ..base.whole_file import check_output_file
from ..datasets._pieces import Piece
from ..errors import InputError
from ..scene._scene import Scene
from ..studio._files import make_glb
from ..web._page import check_page
from ..web._page import export as write_page
from .look_options import INPUT, load_with
from .option import option
from .picture import tell_why_nothing
from .progress import LateBar


def export(
    input: str = INPUT,
    output: str | None = option(
        "-o --output", "File to write: a page, .html, or a model, .glb. Named after INPUT by default.", "FILE"
    ),
    title: str | None = option(
        "--title", "Title of the page (default: the title of the piece, or the name of FILE).", "TEXT"
    ),
    as_json: bool = option("--json", "Print a JSON object instead of text."),
    **look: Any,
) -> None:
    """Write a scene as an interactive HTML page in one file, which needs no network, or as a .glb model.

    The model is for other viewers; one call of a contract makes it, as for a token.
    """
    source = locate(input)
    stem = source.file_stem if isinstance(source, Piece) else source.stem
    path = Path(output or f"{stem or 'scene'}.html")
    is_model = path.suffix.lower() == ".glb"
    path = check_output_file(path, "model") if is_model else check_page(path)
    if is_model and title is not None:
        raise InputError("--title is for pages: a model has no title")
    started = time.perf_counter()
    if is_model:
        with LateBar("writing"):
            scene = load_with(input, look, is_picture=False)
            made = make_glb(scene)
            made.save(path)
        if missing := _left_out(scene):
            print(f"the model leaves out {missing}", file=sys.stderr)
        facts, more, rows = {"gas": made.gas}, {}, {"gas": f"{made.gas:,}"}
    else:
        if isinstance(source, Piece) and source.notice:
            print(source.notice, file=sys.stderr)
        with LateBar("rendering"):
            image = write_page(source, path, title=title, **look)
        if not image.visible_pixels:
            assert image.scene is not None
            tell_why_nothing(image.scene)
        facts = {"width": image.width, "height": image.height, "triangles": image.triangles, "gas": image.gas}
        more = {"sha256": image.sha256}
        rows = {"picture": f"{image.width} x {image.height} pixels, {image.gas:,} gas", **more}
    seconds, size = time.perf_counter() - started, path.stat().st_size
    if as_json:
        where = {"seconds": round(seconds, 6), "output": str(path), "bytes": size}
        print(json.dumps({"input": input, **facts, **where, **more}))
        return
    rows = {"model" if is_model else "page": f"{path}, {size:,} bytes", **rows, "time": f"{seconds:.3f} s"}
    print("\n".join(f"{name:8} {value}" for name, value in rows.items()))


def _left_out(scene: Scene) -> str:
    """Return in words what a model does not have of the surfaces of a scene, or nothing."""
    parts = {
        "textures": any(each.material.texture is not None for each in scene.objects),
        "opacities of vertices": any(each.mesh.opacities is not None for each in scene.objects),
        "shadows": any(each.shadow for each in scene.lights),
        "the fading of the ground": scene.ground is not None or any(each.fade is not None for each in scene.objects),
    }
    return ", ".join(name for name, is_there in parts.items() if is_there)
