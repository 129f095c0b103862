"""shackled creator"""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Iterator, Mapping
from contextlib import suppress
from itertools import islice
from pathlib import Path
from urllib.parse import quote

from PIL import Image

from .._load import load, locate
from ..base.local_server import Answer, listen, run, type_of
from ..base.whole_file import make_output_folder
from ..chain._address_book import book_path
from ..datasets._pieces import Piece
from ..datasets.genesis import seed_of
from ..errors import InputError
from ..scene._files.beside import is_inside
from ..scene._files.link import Link
from ..scene._files.mesh_file import READERS
from ..scene._files.scene_file import SCENES
from .option import argument, option

#: Default port.
PORT = 8080
#: Files that name others, beside which those are, such as materials and textures; at most so many are looked at.
NAMING, MOST_BESIDE = (".obj", ".mtl", ".gltf", ".ply", *SCENES), 2000


def creator(
    input: str | None = argument("Mesh file, scene file, piece of a dataset, or link to open.", "INPUT"),
    port: int | None = option("--port", f"Port of the page (default: {PORT}, or a free one).", min=0, max=65535),
    browser: bool = option("--browser/--no-browser", "Open the page in the browser.", default=True),
    out: str | None = option("--out", "Write the page to a folder, for any web server, instead of opening it.", "DIR"),
) -> None:
    """Make pictures on a page in the browser, without code; all data stays on this machine."""
    page, one_file = built_page()
    if out is not None:
        if input is not None or port is not None:
            raise InputError("--out only writes the page: leave out INPUT and --port")
        make_output_folder(folder := Path(out))
        shutil.copytree(page, folder, dirs_exist_ok=True)
        shutil.copy(one_file, folder)
        print(f"{folder / 'index.html'}, and in one file {folder / one_file.name}")
        return
    answers, place = first_answers(input, page)

    def answer(path: str) -> Answer | None:
        body = found(page, answers, path[1:] or "index.html")
        return None if body is None else Answer(body, type_of(path[1:] or "index.html"))

    run(listen(answer, port, PORT), "the Creator is at", f"/{place}", browser)


def built_page() -> tuple[Path, Path]:
    """Return the folder of the page, and the page as one file: of the package, or of a clone. InputError without."""
    package = Path(__file__).parents[1]
    clone = package.parents[1]
    for folder in (package / "web", clone / "build"):
        if (folder / "page" / "index.html").is_file():
            return folder / "page", folder / "creator.html"
    if (clone / "Makefile").is_file():
        raise InputError("the page of the Creator is not built: run `make page`, which needs Node 20 or newer and npm")
    raise InputError(
        "this installation has no page of the Creator: building it needs Node 20 or newer and npm. With these in the "
        "PATH, install Shackled again from its clone: `pip install --force-reinstall --no-deps .`"
    )


def first_answers(input: str | None, page: Path) -> tuple[dict[str, Path | bytes], str]:
    """Return what is served besides the page, by path, and what follows its address, to open the input.

    page: its folder; a piece that is not in there is served as a scene file.
    """
    book = book_path()
    answers: dict[str, Path | bytes] = {"addresses.json": book if book.is_file() else b'{"chains": {}}'}
    if input is None:
        return answers, ""
    source = locate(input)
    if isinstance(source, Link):
        load(input)  # refuses a damaged one
        return answers, "#" + source.text.rpartition("#")[2]
    seed = re.fullmatch(r"genesis/(\d+)", input)
    # the page knows them by their seeds
    name = f"genesis/{seed_of(int(seed[1])).hex()}" if seed and len(seed[1]) < 64 else input
    told: dict[str, object] = {"piece": name}
    packed = page / "data" / "pieces" / f"{name.replace('/', '-')}.gz"
    if isinstance(source, Piece) and not name.startswith("genesis/") and not packed.is_file():
        file = f"{source.name.rpartition('/')[2]}.json"
        answers[f"input/{file}"] = load(source.name).encode()
        told = {"names": [file]}
    elif not isinstance(source, Piece):
        if not source.is_file():
            raise InputError(f"{source} does not exist")
        files = {path.relative_to(source.parent).as_posix(): path for path in (source, *_beside(source))}
        answers |= {f"input/{name}": path for name, path in files.items()}
        told = {"names": [*files]}
    return answers | {"input.json": json.dumps(told).encode()}, "?input"


def _beside(path: Path) -> Iterator[Path]:
    """Yield the files in the folder of a file, and in folders there, that it names and readers use."""
    if path.suffix.lower() not in NAMING:
        return
    text = path.read_bytes()
    images = (extension for extension, format in Image.registered_extensions().items() if format in Image.OPEN)
    used = {*NAMING, *READERS, ".bin", *images}
    around = filter(Path.is_file, islice(path.parent.rglob("*"), MOST_BESIDE))
    for each in sorted(around, key=lambda each: (each.suffix.lower() not in NAMING, each)):
        if each == path or each.suffix.lower() not in used or not is_inside(path.parent, each):
            continue
        names = b"|".join(re.escape(name.encode()) for name in {each.name, quote(each.name)})
        if re.search(rb"(?<![\w.-])(?:%s)(?![\w.-])" % names, text, re.IGNORECASE):
            if each.suffix.lower() in NAMING:
                text += each.read_bytes()
            yield each


def found(page: Path, answers: Mapping[str, Path | bytes], name: str) -> bytes | None:
    """Return a file of the page, or what else is served; None if there is no such file."""
    place = answers.get(name) or page / name
    if isinstance(place, bytes):
        return place
    with suppress(OSError, ValueError):  # ValueError: a NUL in the name
        if name in answers or place.resolve().is_relative_to(page.resolve()):
            return place.read_bytes()
    return None
