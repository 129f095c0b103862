"""shackled stages"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from PIL import Image as PillowImage

from ..chain import CHAINS, open_chain
from ..errors import InputError
from ..load import locate
from .look import Changes, load_changed
from .look_options import with_look


@with_look
def stages(
    input: Annotated[str, typer.Argument(help="A mesh or scene file, or a piece of a dataset.", metavar="INPUT")],
    output: Annotated[str, typer.Option("--output", "-o", help="The folder for the pictures.", metavar="DIR")],
    *,
    changes: Changes,
    chain: Annotated[
        str | None, typer.Option("--chain", help=f"Where it is computed: {', '.join(CHAINS)}.", metavar="NAME")
    ] = None,
) -> None:
    """Draw what each stage of the pipeline makes of a scene: six pictures, and all in one strip."""
    from ..stages import draw_stages, strip

    folder = Path(output)
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder} is a file, not a folder to write to")
    made = draw_stages(load_changed(locate(input), changes), open_chain(chain))
    pictures = {stage.name: PillowImage.fromarray(stage.pixels) for stage in made} | {"strip": strip(made)}
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, picture in pictures.items():
            picture.save(folder / f"{name}.png", optimize=True)
    except OSError as error:
        raise InputError(f"nothing can be written to the folder {folder}: {error.strerror}") from None
    for stage in made:
        print(f"{folder / stage.name}.png: {stage.title.lower()}, {stage.detail}")
    print(folder / "strip.png")
