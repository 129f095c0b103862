"""Draw the picture of docs/studio.md: tokens of examples/tokens, as their URIs contain them.

    python -m tools.docs.draw_studio

Needs the compiler: `npm ci` in contracts/.
"""

from __future__ import annotations

import numpy as np
from PIL import Image as PillowImage

from shackled.datasets._pieces import require
from shackled.studio import store_scene
from tools.examples import compile_example, picture, token_uri
from tools.ledger import World
from tools.pages import IMAGES


def main() -> None:
    """Draw the picture."""
    world = World()
    studio = world.address("Studio")
    for storing in store_scene(require("icons/diamond").make(), studio):
        world.run(studio, storing.data, created=True)
    arguments = [address.rjust(32, b"\0") for address in (studio, storing.pointer)]
    kept = world.deploy(compile_example("examples/tokens/PictureToken.sol")[0], b"".join(arguments))
    town = world.deploy(compile_example("examples/tokens/SkylineToken.sol")[0], arguments[0])
    rows = []
    for token, numbers in ((kept, (0, 2, 4, 6)), (town, (0, 1, 2, 3))):
        pictures = [picture(token_uri(world, token, number, 7)) for number in numbers]
        print(f"{world.gas:,} gas")
        # one pixel of each square of 4 x 4
        rows.append(np.hstack([each[::4, ::4] for each in pictures]))
    PillowImage.fromarray(np.vstack(rows)).save(IMAGES / "studio.png", optimize=True)


if __name__ == "__main__":
    main()
