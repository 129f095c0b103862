"""shackled genesis"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

from ..datasets.genesis import GenesisPiece
from ..errors import InputError
from ..image import FORMATS, check_output, one_of
from ..scene import PICTURE
from .option import argument, option
from .progress import LateBar


def genesis(
    seeds: Annotated[
        list[str] | None,
        argument("Seeds of 64 hexadecimal digits, or numbers from 0 to 1023.", "SEED"),
    ] = None,
    as_json: Annotated[bool, option("--json", "Print a JSON object per line: seed, traits, mesh, colours.")] = False,
    output: Annotated[
        str | None,
        option("-o --output", f"Output file for the picture of one SEED: {one_of(FORMATS)}.", "FILE"),
    ] = None,
    sheet: Annotated[
        str | None,
        option("--sheet", "Output file for all 1024 pieces in one picture, .png.", "FILE"),
    ] = None,
    count: Annotated[int | None, option("--count", "Number of pieces.", "N", "Sheet")] = None,
    size: Annotated[
        int | None,
        option("--size", "Pixels per piece, 128 by default.", "N", "Sheet"),
    ] = None,
    workers: Annotated[
        int | None,
        option("--jobs", "Number of worker processes; one per core by default.", "N", "Sheet", min=1),
    ] = None,
) -> None:
    """Generate Genesis pieces from seeds in the contract, or render the whole collection.

    An interrupted sheet continues where it stopped.
    """
    if sheet is None:
        if not seeds:
            raise InputError(
                "a SEED is missing: 64 hexadecimal digits or a number from 0 to 1023; or give --sheet FILE"
            )
        if count is not None or size is not None or workers is not None:
            raise InputError("--count, --size and --jobs need --sheet FILE")
        _pieces(seeds, as_json, output)
        return
    if seeds or as_json or output is not None:
        raise InputError("--sheet excludes SEED, --json and --output")
    _sheet(sheet, count, size, workers)


def _pieces(seeds: list[str], as_json: bool, output: str | None) -> None:
    from ..datasets.genesis import generate_on_chain, parse_seed

    if output is not None and len(seeds) > 1:
        raise InputError(f"--output needs exactly one SEED, not {len(seeds)}")
    path = None if output is None else check_output(output)
    for number, (text, seed) in enumerate([(text, parse_seed(text)) for text in seeds]):
        piece, gas = generate_on_chain(seed)
        rendering = None if path is None else _draw(piece, path)
        if as_json:
            print(json.dumps(piece.document(), separators=(",", ":")))
            continue
        rows = {
            "piece": text if len(text) < 64 else "",
            "seed": seed.hex(),
            "structure": piece.structure,
            "chroma": piece.chroma,
            "symmetry": piece.pseudosymmetry,
            "prisms": f"{piece.prisms}, {len(piece.faces)} triangles",
            "style": ", ".join(
                word for word, holds in (("wireframe", piece.wireframe), ("inverted", piece.invert)) if holds
            ),
            "gas": f"{gas:,} for the piece" + ("" if rendering is None else f", {rendering:,} from seed to picture"),
            "picture": "" if path is None else f"{path}{', with its scene' * (path.suffix.lower() == PICTURE)}",
        }
        print("\n" * (number > 0) + "\n".join(f"{name:9} {value}" for name, value in rows.items() if value))


def _draw(piece: GenesisPiece, path: Path) -> int:
    """Save the picture of a piece, made by one call; return its gas."""
    from ..datasets.genesis import picture_on_chain

    image = picture_on_chain(piece)
    image.save(path)
    assert image.gas is not None
    return image.gas


def _sheet(sheet: str, count: int | None, size: int | None, workers: int | None) -> None:
    from ..datasets import SIZE
    from ..datasets.genesis import COUNT, render_sheet

    count, size = COUNT if count is None else count, SIZE if size is None else size
    with LateBar("drawing", 0) as bar:
        render_sheet(sheet, count, size, workers, bar.set)
    print(f"{sheet}: {count:,} pieces")
