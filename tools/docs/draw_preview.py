"""Make the picture of docs/token-tutorial.md: `shackled preview` with the tokens of the tutorial, in a real browser.

    python -m tools.docs.draw_preview

Needs chromium, Node and the compiler: npm ci in contracts/.
"""

from __future__ import annotations

import io
import sys
import tempfile
from pathlib import Path

from PIL import Image

from tools.page_server import chromium
from tools.pages import IMAGES
from tools.tokens.tutorial import TOKENS, Server, make_project

PICTURE = IMAGES / "preview.png"


def main() -> int:
    """Start the preview, take the picture when all tokens are there, and write it."""
    with tempfile.TemporaryDirectory() as name, chromium() as browser:
        folder = Path(name)
        make_project(folder)
        with Server(folder) as server:
            for message in server.messages():
                if message.get("status") == "done":
                    break
            page = browser.new_page(viewport={"width": 1200, "height": 800})
            page.goto(server.url)
            page.get_by_text(f"{TOKENS} tokens in").wait_for()
            page.wait_for_load_state("networkidle")
            shot = page.screenshot()
    Image.open(io.BytesIO(shot)).convert("P", palette=Image.Palette.ADAPTIVE, dither=Image.Dither.NONE).save(
        PICTURE, optimize=True
    )
    print(f"{PICTURE.relative_to(Path.cwd())}: {PICTURE.stat().st_size:,} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
