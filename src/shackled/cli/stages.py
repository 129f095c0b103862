"""shackled stages"""

from __future__ import annotations

import io
from pathlib import Path
from typing import Annotated

from PIL import Image as PillowImage

from ..chain import CHAINS, open_chain
from ..whole_file import check_output_folder, make_output_folder, write_output
from .look_options import Look, load_with
from .option import argument, option


def stages(
    input: Annotated[str, argument("Mesh file, scene file, or name of a piece.", "INPUT")],
    output: Annotated[str, option("-o --output", "Folder for the pictures.", "DIR")],
    *,
    look: Look,
    evm: Annotated[
        str | None,
        option("--evm", f"EVM to draw in: {', '.join(CHAINS)}; default: revm.", "NAME"),
    ] = None,
) -> None:
    """Draw the result of each stage of the pipeline: six pictures, and a strip of all."""
    from ..stages import draw_stages, strip

    folder = check_output_folder(Path(output))
    made = draw_stages(load_with(input, look), open_chain(evm))
    pictures = {stage.name: PillowImage.fromarray(stage.pixels) for stage in made} | {"strip": strip(made)}
    make_output_folder(folder)
    for name, picture in pictures.items():
        stream = io.BytesIO()
        picture.save(stream, "png", optimize=True)
        write_output(folder / f"{name}.png", stream.getvalue())
    for stage in made:
        print(f"{folder / stage.name}.png: {stage.title.lower()}, {stage.detail}")
    print(folder / "strip.png")
