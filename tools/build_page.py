"""Build the Creator: build/page/, the files of a static page, and build/creator.html, the same page as one file.

    python -m tools.build_page [--sizes FILE]

Needs Node and `npm ci` in web/. Fails if the page has become too large. --sizes: writes the sizes in JSON, too.
"""

from __future__ import annotations

import argparse
import base64
import gzip
import hashlib
import io
import json
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from examples.showcase import SCENES
from numpy.typing import ArrayLike
from PIL import Image, ImageOps

from shackled import Scene, load
from shackled.artifacts import artifact
from shackled.datasets import Piece, pieces
from shackled.datasets._drawing import draw, table
from shackled.ethereum._encoding import to_hex
from shackled.scene._mesh import vertex_normals
from shackled.web._page import asset, page_template
from tools.build_web import WEB, code_of

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build"
DRACO = "three/examples/jsm/libs/draco/gltf/draco_decoder.wasm"

#: The contracts that the page runs besides those that draw.
MORE = ("PngEncoder", "Turntable", "GlbEncoder", "Genesis", "Editions", "Studio")
#: Scenes of the showcase, and their titles; the others have large meshes, or are those of icons.
SHOWCASE = {"glass": "Glass: opacity and a rim", "wires": "Wires, antialiased"}
#: The side of a thumbnail.
THUMBNAIL = 64
#: The picture that other sites show for a link, and its size.
PREVIEW_SIZE = (1200, 630)
PREVIEW = ROOT / "docs" / "images" / "creator.png"
#: The most bytes in gzip: of what the first picture needs, and of all.
MOST_FIRST, MOST = 450_000, 1_200_000
#: What the page may ask besides its own files: nodes that a visitor names.
CONNECT = "data: blob: http: https:"


def main() -> int:
    """Build the page, and print its sizes."""
    parser = argparse.ArgumentParser(description="Build the Creator into build/page and build/creator.html.")
    parser.add_argument("--sizes", type=Path, help="file for the sizes, in JSON")
    options = parser.parse_args()
    BUILD.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(dir=BUILD) as folder:
        scripts, page = Path(folder, "scripts"), Path(folder, "page")
        if code := subprocess.run(["node", "build.mjs", "page", scripts], cwd=WEB).returncode:
            return code
        data = {name: gzip.compress(content, 9, mtime=0) for name, content in data_files(scripts).items()}
        one = write_one(scripts / "one", data)
        shutil.rmtree(scripts / "one")
        meta = json.loads((scripts / "meta.json").read_text("utf-8"))
        for name in ("meta.json", "LICENSES.txt"):
            (scripts / name).unlink()
        shutil.copytree(scripts, page)
        write_folder(page, data)
        sizes = measure(page, first_files(meta), data)
        shutil.rmtree(BUILD / "page", ignore_errors=True)
        page.rename(BUILD / "page")
    (BUILD / "creator.html").write_bytes(one)
    sizes["one"] = len(one)
    return report(sizes, options.sizes)


# ---- data ----


def data_files(scripts: Path) -> dict[str, bytes]:
    """Return the content of the data files by name: see web/src/creator/assets.ts."""
    shown = [piece for name in ("icons", "common") for piece in pieces(name) if piece.ready()]
    staged = {piece.file_stem: load(piece) for piece in shown}
    for name, title in SHOWCASE.items():
        shown.append(Piece(f"showcase/{name}", "showcase", title, "MIT", SCENES[name]))
        staged[shown[-1].file_stem] = SCENES[name]()
    files = {name: asset(name) for name in ("evm.wasm", "contracts.json", "stages.json")}
    files |= {
        "more.json": dump(more_contracts()),
        "pieces.json": dump([entry(piece) for piece in shown]),
        "thumbnails.json": dump({piece.name: thumbnail(piece) for piece in shown}),
        "page.html": page_template().encode(),
        "draco.wasm": (WEB / "node_modules" / DRACO).read_bytes(),
        "LICENSES.txt": (scripts / "LICENSES.txt").read_bytes() + (ROOT / "THIRD-PARTY-NOTICES").read_bytes(),
    }
    return files | {f"pieces/{name}": pack(scene) for name, scene in staged.items()}


def more_contracts() -> dict[str, Any]:
    """Return the contracts of `MORE` in the form of contracts.json."""
    errors = {to_hex(key): value for name in MORE for key, value in artifact(name).errors.items()}
    return {"contracts": {name: code_of(name) for name in MORE}, "errors": dict(sorted(errors.items()))}


def entry(piece: Piece) -> dict[str, Any]:
    """Return what pieces.json says of a piece."""
    scene = piece.make()
    known = table().get(piece.name)
    return {
        "name": piece.name,
        "title": piece.title,
        "dataset": piece.dataset,
        "licence": piece.licence,
        "notice": piece.notice,
        "commercial": piece.commercial,
        "triangles": scene.triangles,
        "objects": len(scene.objects),
        "gas": known.gas if known else draw(piece).gas,
    }


def thumbnail(piece: Piece) -> str:
    """Return a small picture as a data URL: that of the contracts, of which four pixels become one."""
    with Image.open(io.BytesIO(draw(piece, 2 * THUMBNAIL).png)) as picture:
        small = picture.resize((THUMBNAIL, THUMBNAIL), Image.Resampling.BOX)
    return "data:image/webp;base64," + base64.b64encode(encoded(small, "webp", quality=62, method=6)).decode()


def encoded(picture: Image.Image, kind: str, **options: Any) -> bytes:
    """Return a picture as a file."""
    stream = io.BytesIO()
    picture.save(stream, kind, **options)
    return stream.getvalue()


def dump(value: Any) -> bytes:
    """Return JSON."""
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False).encode()


# ---- pieces, as web/src/document/packed.ts reads them ----


def pack(staged: Scene) -> bytes:
    """Return the scene file of a piece, with its meshes as numbers of which equal bytes lie together."""
    scene = json.loads(staged.encode())
    meshes: list[dict[str, Any]] = []
    numbers = []
    for place, each in enumerate(scene["objects"]):
        mesh = each["mesh"]
        each["mesh"] = place
        positions, faces = (np.array(mesh[name]) for name in ("positions", "faces"))
        meshes.append({"vertices": len(positions), "triangles": len(faces)})
        differences = np.diff(faces.ravel().astype("<i4"), prepend=np.int32(0))
        numbers += [floats(positions), planes(differences)]
        if "colors" in mesh:
            meshes[-1]["colors"] = len(mesh["colors"][0])
            numbers.append(planes(np.array(mesh["colors"], "u1")))
        for name in ("normals", "uvs", "opacities"):
            if name == "normals" and mesh.get(name) == vertex_normals(positions, faces).tolist():
                meshes[-1][name] = "computed"
            elif name in mesh:
                meshes[-1][name] = 1
                numbers.append(floats(mesh[name]))
    head = dump({"scene": scene, "meshes": meshes})
    return len(head).to_bytes(4, "little") + head + b"".join(numbers)


def floats(values: ArrayLike) -> bytes:
    """Return numbers as a table of those without sign that differ, and places in it with the sign in the last bit."""
    flat = np.asarray(values, "<f8").ravel()
    known, places = np.unique(np.abs(flat), return_inverse=True)
    signed = (2 * places + np.signbit(flat)).astype("<u2" if len(known) < 1 << 15 else "<u4")
    return len(known).to_bytes(4, "little") + planes(known) + planes(signed)


def planes(values: Any) -> bytes:
    """Return the first bytes of all numbers, then their second ones, and so on."""
    flat = np.ascontiguousarray(values).ravel()
    return np.ascontiguousarray(flat.view(np.uint8).reshape(-1, flat.itemsize).T).tobytes()


# ---- pages ----


def write_folder(page: Path, data: dict[str, bytes]) -> None:
    """Write the page beside its scripts, and its data."""
    policy = f"script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; connect-src 'self' {CONNECT}"
    head = '<link rel="stylesheet" href="creator.css" />\n<script type="module" src="creator.js"></script>'
    (page / "index.html").write_bytes(html(f"{policy}; img-src 'self' data: blob:", head, ""))
    for name, content in data.items():
        path = page / "data" / f"{name}.gz"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    with Image.open(PREVIEW) as picture:
        small = ImageOps.fit(picture.convert("RGB"), PREVIEW_SIZE, centering=(0.5, 0))
    (page / "preview.jpg").write_bytes(encoded(small, "jpeg", quality=80))


def write_one(folder: Path, data: dict[str, bytes]) -> bytes:
    """Return the page as one file, with the scripts in a folder."""
    style, script = ((folder / f"creator.{kind}").read_text("utf-8") for kind in ("css", "js"))
    if re.search("</script|<!--", script, re.IGNORECASE) or "</style" in style.lower():
        raise SystemExit("a script or style contains what ends it in a page")
    policy = f"script-src {sha256(script)} 'wasm-unsafe-eval'; style-src {sha256(style)}; connect-src {CONNECT}"
    elements = "\n".join(
        f'<script type="text/plain" id="asset-{name}">{base64.b64encode(content).decode()}</script>'
        for name, content in data.items()
    )
    body = f'{elements}\n<script type="module">{script}</script>'
    return html(f"{policy}; img-src data: blob:", f"<style>{style}</style>", body)


def html(policy: str, head: str, body: str) -> bytes:
    """Return the page. policy: what it may load besides its worker."""
    logo = base64.b64encode((WEB / "src" / "creator" / "logo.svg").read_bytes()).decode()
    values = {
        "policy": f"default-src 'none'; {policy}; worker-src blob:; base-uri 'none'; form-action 'none'",
        "icon": f"data:image/svg+xml;base64,{logo}",
        "head": head,
        "body": body,
    }
    text = (WEB / "src" / "creator" / "index.html").read_text("utf-8")
    return re.sub(r"\{\{(\w+)\}\}", lambda found: values[found[1]], text).encode()


def sha256(text: str) -> str:
    """Return a source of a content security policy that allows a script or style with this text."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


# ---- sizes ----


def first_files(meta: dict[str, Any]) -> set[str]:
    """Return the scripts that the page loads at once: its own, and what that imports."""
    outputs = {Path(path).name: output for path, output in meta["outputs"].items()}
    found, left = set(), {"creator.js"}
    while left:
        name = left.pop()
        found.add(name)
        imports = (each for each in outputs[name]["imports"] if each["kind"] == "import-statement")
        left |= {Path(each["path"]).name for each in imports} - found
    return found


def measure(page: Path, first: Iterable[str], data: dict[str, bytes]) -> dict[str, int]:
    """Return sizes in gzip: of scripts and data, of what the first picture needs, and of all that the page loads."""
    text = {path.name: len(gzip.compress(path.read_bytes(), 9)) for path in page.rglob("*") if path.suffix in TEXT}
    sizes = {**text, **{name: len(content) for name, content in data.items()}}
    largest = max(size for name, size in sizes.items() if name.startswith("pieces/icons"))
    needed = {*first, "index.html", "creator.css", "evm.wasm", "contracts.json", "pieces.json"}
    sizes["first picture"] = sum(sizes[name] for name in needed) + largest
    sizes["all"] = sum(size for name, size in sizes.items() if name != "first picture")
    return sizes


TEXT = (".html", ".css", ".js")


def report(sizes: dict[str, int], path: Path | None) -> int:
    """Print sizes; return 1 if one is too large."""
    pieces_ = sum(size for name, size in sizes.items() if name.startswith("pieces/"))
    for name, size in [*((n, s) for n, s in sizes.items() if not n.startswith("pieces/")), ("pieces", pieces_)]:
        print(f"{size:>10,}  {name}")
    if path:
        path.write_text(json.dumps(sizes, indent=1) + "\n", "utf-8")
    large = [name for name, most in (("first picture", MOST_FIRST), ("all", MOST)) if sizes[name] > most]
    for name in large:
        print(f"{name}: {sizes[name]:,} bytes in gzip are too many", file=sys.stderr)
    return 1 if large else 0


if __name__ == "__main__":
    sys.exit(main())
