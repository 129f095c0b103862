"""shackled genesis"""

from __future__ import annotations

import json

from ..datasets.genesis import generate_on_chain, parse_seed, picture_on_chain
from ..errors import InputError
from ..image import FORMATS, check_output, one_of
from ..scene._files.picture import PICTURE
from .option import argument, option


def genesis(
    seeds: tuple[str, ...] = argument(
        "Seeds of 64 hexadecimal digits, or numbers from 0 to 1023.", "SEED", required=True
    ),
    as_json: bool = option("--json", "Print a JSON object per line: seed, traits, mesh, colours."),
    output: str | None = option("-o --output", f"Output file for the picture of one SEED: {one_of(FORMATS)}.", "FILE"),
) -> None:
    """Generate Genesis pieces from seeds in the contract."""
    if output is not None and len(seeds) > 1:
        raise InputError(f"--output needs exactly one SEED, not {len(seeds)}")
    path = None if output is None else check_output(output)
    for number, (text, seed) in enumerate([(text, parse_seed(text)) for text in seeds]):
        piece, gas = generate_on_chain(seed)
        image = None if path is None else picture_on_chain(piece)
        if image is not None and path is not None:
            image.save(path)
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
            "gas": f"{gas:,} for the piece" + ("" if image is None else f", {image.gas:,} from seed to picture"),
            "picture": "" if path is None else f"{path}{', with its scene' * (path.suffix.lower() == PICTURE)}",
        }
        print("\n" * (number > 0) + "\n".join(f"{name:9} {value}" for name, value in rows.items() if value))
