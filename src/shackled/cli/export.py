"""shackled export"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import Any

from .._load import locate
from ..datasets import Piece
from ..errors import InputError
from ..scene import Scene
from ..studio import make_glb
from ..web import check_page
from ..web import export as write_page
from ..whole_file import check_output_file
from .look_options import INPUT, load_with
from .option import option
from .progress import LateBar

#: Bytes of a page, and gas of its picture, above which a note is printed.
LARGE = 1_500_000
SLOW = 2_000_000_000


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
    if isinstance(source, Piece) and source.notice:
        print(source.notice, file=sys.stderr)
    started = time.perf_counter()
    report: dict[str, Any] = {"input": input}
    with LateBar("writing" if is_model else "rendering"):
        if is_model:
            scene = load_with(input, look, is_picture=False)
            made = make_glb(scene)
            made.save(path)
            report["gas"] = made.gas
        else:
            image = write_page(source, path, title=title, **look)
            report |= {"width": image.width, "height": image.height, "triangles": image.triangles, "gas": image.gas}
    report |= {"seconds": round(time.perf_counter() - started, 6), "output": str(path), "bytes": path.stat().st_size}
    gas, size = f"{report['gas']:,}", report["bytes"]
    if is_model:
        if missing := _left_out(scene):
            print(f"the model leaves out {missing}", file=sys.stderr)
        rows = {"model": f"{path}, {size:,} bytes", "gas": gas}
    else:
        report["sha256"] = image.sha256
        if not image.covered_pixels:
            print("nothing is visible; the picture shows only the background", file=sys.stderr)
        if size > LARGE:
            print(f"the page is large, {size / 1e6:.1f} MB: --max-triangles makes it smaller", file=sys.stderr)
        if (image.gas or 0) > SLOW:
            seconds = report["gas"] / 1e8
            print(f"the picture takes {gas} gas: a browser takes about {seconds:.0f} s; see --size", file=sys.stderr)
        picture = f"{image.width} x {image.height} pixels, {gas} gas"
        rows = {"page": f"{path}, {size / 1e6:.2f} MB", "picture": picture, "sha256": image.sha256}
    rows["time"] = f"{report['seconds']:.3f} s"
    print(json.dumps(report) if as_json else "\n".join(f"{name:8} {value}" for name, value in rows.items()))


def _left_out(scene: Scene) -> str:
    """Return in words what a model does not have of the surfaces of a scene, or nothing."""
    parts = {
        "textures": any(each.material.texture is not None for each in scene.objects),
        "opacities of vertices": any(each.mesh.opacities is not None for each in scene.objects),
        "shadows": any(each.shadow for each in scene.lights),
        "the fading of the ground": scene.ground is not None or any(each.fade is not None for each in scene.objects),
    }
    return ", ".join(name for name, is_there in parts.items() if is_there)
