"""Draw the picture of token-commands.md: the gallery that `shackled token demo` writes, in a real browser.

    python -m tools.docs.draw_token_gallery

Needs anvil and chromium. The pieces differ from run to run, because the chain determines their seeds.
"""

from __future__ import annotations

import io
import os
import sys
import tempfile
from pathlib import Path

from PIL import Image

from shackled.chain._address_book import VARIABLE
from shackled.tokens._demo import run_demo
from tools.anvil import Anvil, find_anvil
from tools.page_server import chromium
from tools.pages import IMAGES

#: Size of the palette, which keeps the file small.
COLORS = 256


def main() -> None:
    """Draw the picture."""
    binary = find_anvil()
    if binary is None:
        raise SystemExit("anvil is not installed: npm ci in contracts/")
    with tempfile.TemporaryDirectory() as folder, Anvil(binary) as node, chromium() as browser:
        os.environ[VARIABLE] = str(Path(folder) / "addresses.json")
        output = Path(folder).resolve() / "demo"
        run_demo(node.connection, output, lambda text: print(text, file=sys.stderr))
        page = browser.new_page(viewport={"width": 1280, "height": 1060}, color_scheme="light")
        page.goto((output / "gallery.html").as_uri())
        with Image.open(io.BytesIO(page.screenshot())) as picture:
            picture.convert("RGB").quantize(COLORS).save(IMAGES / "gallery.png", optimize=True)


if __name__ == "__main__":
    main()
