"""shackled datasets"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable, Sequence
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Any

from ..checks import choice
from ..datasets import DATASETS, Piece, PieceCost, cost, pieces
from ..errors import InputError
from ..whole_file import check_output_file, write_output
from .option import argument, option
from .progress import LateBar

#: Number of Genesis pieces in a gallery without --all.
GENESIS_SHOWN = 48

DATASET = argument(f"{', '.join(DATASETS)}; all by default.", "DATASET", parse=partial(choice, choices=tuple(DATASETS)))


def list_(
    dataset: str | None = DATASET,
    as_json: bool = option("--json", "Print a list of JSON objects."),
    every: bool = option("--all", "List each Genesis piece."),
) -> None:
    """List the pieces with their triangles, gas at 128 x 128, and licence."""
    rows = [(piece, cost(piece)) for piece in pieces(dataset)]
    if as_json:
        print(json.dumps([_object(piece, figures) for piece, figures in rows], ensure_ascii=False))
        return
    for name, group in groupby(rows, lambda row: row[0].dataset):
        members = list(group)
        print(f"{name}: {len(members):,} pieces")
        lines = [_summary(members)] if name == "genesis" and not every else [_line(*row) for row in members]
        a, b, c, d, _ = (max(map(len, column)) for column in zip(*lines, strict=True))
        for piece, triangles, gas, title, terms in lines:
            print(f"  {piece:{a}}  {triangles:>{b}} triangles  {gas:>{c}} gas  {title:{d}}  {terms}")


def _object(piece: Piece, figures: PieceCost) -> dict[str, Any]:
    return {
        "name": piece.name,
        "dataset": piece.dataset,
        "title": piece.title,
        "triangles": figures.triangles,
        "gas": figures.gas,
        "licence": piece.licence,
        "commercial": piece.commercial,
        "credit": piece.credit,
        "fetched": piece.ready(),
    }


def _line(piece: Piece, figures: PieceCost) -> tuple[str, str, str, str, str]:
    triangles = "-" if figures.triangles is None else f"{figures.triangles:,}"
    gas = "-" if figures.gas is None else f"{figures.gas:,}"
    to_fetch = "" if piece.ready() else f"; run: shackled datasets fetch {piece.name}"
    return piece.name, triangles, gas, piece.title, f"{piece.terms}{to_fetch}"


def _summary(rows: Sequence[tuple[Piece, PieceCost]]) -> tuple[str, str, str, str, str]:
    def span(values: Iterable[int | None]) -> str:
        known = [value for value in values if value is not None]
        return f"{min(known):,} to {max(known):,}" if known else "-"

    (first, _), (last, _) = rows[0], rows[-1]
    triangles, gas = span(figures.triangles for _, figures in rows), span(figures.gas for _, figures in rows)
    return f"{first.name} .. {last.name}", triangles, gas, "", first.licence


def fetch(
    names: tuple[str, ...] = argument("Names of models, as in `shackled datasets list`.", "NAME", required=True),
    own: Path | None = option("--from", "Local mesh file or archive to use instead of a download.", "FILE"),
    cache: Path | None = option("--cache", "Cache folder; $SHACKLED_CACHE or that of the system by default.", "DIR"),
    again: bool = option("--again", "Prepare models again even if they are in the cache."),
) -> None:
    """Download third-party models, clean and simplify them, and keep the result."""
    from ..datasets import VARIABLE
    from ..datasets.common import model

    if own is not None and len(names) != 1:
        raise InputError("--from needs exactly one NAME")
    if cache is not None:
        os.environ[VARIABLE] = str(cache)
    for each in [model(name) for name in names]:
        _fetch(each, own, again)


def _fetch(model: Any, own: Path | None, again: bool) -> None:
    from ..datasets.common import fetch, take

    terms = "" if model.commercial else "; not for commercial use"
    print(f"{model.name}: {model.title} by {model.author}; licence: {model.licence}{terms}", file=sys.stderr)
    if own is None:
        with LateBar(model.name, 0) as bar:
            done = fetch(model, again, bar.set)
        if not done:
            source = "from a local file; --again downloads the published one" if model.is_own() else "already"
            print(f"{model.name}: it is in the cache {source}", file=sys.stderr)
    elif not take(model, own):
        note = "is not the published file, so its checksum was not compared; check its licence yourself"
        print(f"{model.name}: {own} {note}", file=sys.stderr)
    name, triangles, gas, *_ = _line(model.piece(), cost(model.piece()))
    print(f"{name}: {triangles} triangles, {gas} gas; shackled render {name}")


def gallery(
    outputs: tuple[Path, ...] = option("-o --output", "Output file, .html or .png; can be repeated.", "FILE"),
    dataset: str | None = DATASET,
    every: bool = option("--all", f"Show all Genesis pieces instead of {GENESIS_SHOWN}."),
    jobs: int | None = option("--jobs", "Number of worker processes; one per core by default.", min=1),
) -> None:
    """Render all pieces into a self-contained HTML page or a contact sheet. Finished drawings are cached."""
    from ..datasets import draw_all, page, sheet

    paths = outputs or [Path("gallery.html")]
    for path in paths:
        if path.suffix.lower() not in (".html", ".png"):
            raise InputError(f"the gallery {path} must end in .html or .png")
        check_output_file(path, "gallery")
    found = list(pieces(dataset))
    genesis = [piece for piece in found if piece.dataset == "genesis"]
    left_out = set() if every else {piece.name for piece in genesis[GENESIS_SHOWN:]}
    shown = [piece for piece in found if piece.name not in left_out]
    ready = [piece for piece in shown if piece.ready()]
    drawings = {}
    with LateBar("drawing") as bar:
        for drawing in draw_all(ready, processes=jobs):
            drawings[drawing.name] = drawing
            bar.set(len(drawings), len(ready))
    for path in paths:
        html = path.suffix.lower() == ".html"
        write_output(path, page(shown, drawings).encode() if html else sheet(shown, drawings))
        print(f"{path}: {len(drawings if not html else shown):,} pieces")
