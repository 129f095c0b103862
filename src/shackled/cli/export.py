"""shackled export"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import Annotated, Any

from .._load import locate
from ..datasets import Piece
from ..errors import InputError
from ..scene import Scene
from ..studio import make_glb
from ..web import check_page
from ..web import export as write_page
from ..whole_file import check_output_file
from .look_options import Input, Look, load_with
from .option import option
from .progress import LateBar

#: Bytes of a page, and gas of its picture, above which a note is printed.
LARGE = 1_500_000
SLOW = 2_000_000_000


def export(
    input: Input,
    output: Annotated[
        str | None,
        option("-o --output", "File to write: a page, .html, or a model, .glb. Named after INPUT by default.", "FILE"),
    ] = None,
    title: Annotated[
        str | None, option("--title", "Title of the page (default: that of the piece, or the name of FILE).", "TEXT")
    ] = None,
    as_json: Annotated[bool, option("--json", "Print a JSON object instead of text.")] = False,
    *,
    look: Look,
) -> None:
    """Write a scene as an interactive HTML page of one file, which needs no network, or as a .glb model.

    The model is for other viewers; one call of a contract makes it, as for a token.
    """
    source = locate(input)
    stem = source.file_stem if isinstance(source, Piece) else source.stem
    is_model = output is not None and Path(output).suffix.lower() == ".glb"
    path = (
        check_output_file(Path(output or ""), "model") if is_model else check_page(output or f"{stem or 'scene'}.html")
    )
    if isinstance(source, Piece) and source.notice:
        print(source.notice, file=sys.stderr)
    started = time.perf_counter()
    if is_model:
        if title is not None:
            raise InputError("--title is for pages: a model has no title")
        with LateBar("writing"):
            scene = load_with(input, look, is_picture=False)
            made = make_glb(scene)
            made.save(path)
        report = {
            "input": input,
            "gas": made.gas,
            "seconds": round(time.perf_counter() - started, 6),
            "output": str(path),
            "bytes": len(made.content),
        }
        if missing := _left_out(scene):
            print(f"the model leaves out {missing}", file=sys.stderr)
        text = f"model    {path}, {report['bytes']:,} bytes\ngas      {made.gas:,}\ntime     {report['seconds']:.3f} s"
        print(json.dumps(report) if as_json else text)
        return
    with LateBar("rendering"):
        image = write_page(source, path, title=title, **look)
    seconds = time.perf_counter() - started
    size = path.stat().st_size
    report = {
        "input": input,
        "width": image.width,
        "height": image.height,
        "triangles": image.triangles,
        "gas": image.gas,
        "seconds": round(seconds, 6),
        "output": str(path),
        "bytes": size,
        "sha256": image.sha256,
    }
    if not image.covered_pixels:
        print("nothing is visible; the picture shows only the background", file=sys.stderr)
    if size > LARGE:
        print(f"the page is large, {size / 1e6:.1f} MB: --max-triangles makes it smaller", file=sys.stderr)
    if image.gas is not None and image.gas > SLOW:
        print(
            f"the picture takes {image.gas:,} gas: a browser takes about {image.gas / 1e8:.0f} s; see --size",
            file=sys.stderr,
        )
    print(json.dumps(report) if as_json else _words(report, path))


def _left_out(scene: Scene) -> str:
    """Return in words what a model does not have of the surfaces of a scene, or nothing."""
    parts = {
        "textures": any(each.material.texture is not None for each in scene.objects),
        "opacities of vertices": any(each.mesh.opacities is not None for each in scene.objects),
        "shadows": any(each.shadow for each in scene.lights),
        "the fading of the ground": scene.ground is not None or any(each.fade is not None for each in scene.objects),
    }
    return ", ".join(name for name, is_there in parts.items() if is_there)


def _words(report: dict[str, Any], path: Path) -> str:
    rows = {
        "page": f"{path}, {report['bytes'] / 1e6:.2f} MB",
        "picture": f"{report['width']} x {report['height']} pixels, {report['gas']:,} gas",
        "sha256": report["sha256"],
        "time": f"{report['seconds']:.3f} s",
    }
    return "\n".join(f"{name:8} {value}" for name, value in rows.items())
