"""Draw the gallery of docs/gallery.md: run each of its commands, and write pictures, commands and gas into the page.

    python -m tools.docs.draw_gallery

A picture is in docs/images/gallery under its name; tests run the commands of the page, and compare the pixels.
"""

from __future__ import annotations

import json
import shlex
import sys
from pathlib import Path

from click.testing import CliRunner
from examples import showcase

from shackled.cli.app import app
from tools.pages import DOCS, IMAGES, update

PAGE = DOCS / "gallery.md"
FOLDER = IMAGES / "gallery"
#: Names of pictures, what they show, and the arguments of `shackled render`. What is in build/, an example draws.
PICTURES: dict[str, tuple[str, str]] = {
    "teapot": ("A teapot in the default look", "teapot"),
    "gold": ("Gold", "icons/crown --preset gold"),
    "clay": ("Clay", "torus-knot --preset clay"),
    "neon": ("Neon", "dodecahedron --preset neon"),
    "blueprint": ("A blueprint: edges only", "icons/skull --preset blueprint"),
    "facets": ("Facets: one shade for each face", "icosphere --shading flat --color teal"),
    "shadow": ("A shadow on a ground", "menger-sponge --shadow --ground '#b9b4a8'"),
    "lamps": (
        "Two point lights",
        "uv-sphere --light point:-3,2,2:#ff5040 --light point:3,1,2:#40a0ff --color white --background '#10141f'",
    ),
    "hemisphere": (
        "Light from the sky and from the ground",
        "seashell --hemisphere skyblue,tan --ambient-light '#202020' --color white",
    ),
    "rim": ("Light along the outline", "icons/cat --rim '#7ab8ff,3' --background '#10141f,#2a3550'"),
    "opacity": ("Half transparent", "klein-bottle --opacity 0.6 --color '#2f7fa8'"),
    "filmic": ("Bright light, compressed as on film", "icons/heart --exposure 1.6 --filmic"),
    "orthographic": ("Parallel projection", "spring --orthographic --elevation 35 --color tomato"),
    "wide": ("A wide field of view, from near", "cube --fov 90 --azimuth 30 --elevation 25"),
    "invert": ("Inverted", "icons/planet --invert"),
    "cornell-box": ("A scene with its own camera and lights", "cornell-box"),
    "genesis": ("A piece of Genesis, made from a seed", "genesis/12"),
    "texture": ("A texture", "build/showcase/vase.png --size 256"),
    "glass": ("Glass", "build/showcase/glass.png --size 256"),
    "turntable": ("A turntable", "icons/rocket --turntable 24"),
}


def file_name(name: str) -> str:
    """Return the name of the file of a picture."""
    return f"{name}.gif" if "--turntable" in PICTURES[name][1] else f"{name}.png"


def drawn(name: str) -> str:
    """Draw a picture; return its card."""
    title, arguments = PICTURES[name]
    file = file_name(name)
    words = ["render", *shlex.split(arguments), "-o", str(FOLDER / file), "--json"]
    made, scene = "", Path(words[1])
    if scene.parent == showcase.FOLDER:
        made = f"python examples/showcase.py {scene.stem}\n    "
        scene.parent.mkdir(parents=True, exist_ok=True)
        showcase.draw(scene.stem, scene.parent)
    result = CliRunner().invoke(app, words, catch_exceptions=False)
    if result.exit_code:
        raise SystemExit(f"{name}: {result.output}")
    gas = json.loads(result.stdout)["gas"] / 1e6
    print(f"{file}: {gas:.1f} million gas", file=sys.stderr)
    return (
        f"-   ![{title}](images/gallery/{file}){{ loading=lazy }}\n\n    **{title}**, {gas:,.1f} million gas\n\n"
        f"    ```sh\n    {made}shackled render {arguments} -o {file}\n    ```\n"
    )


def main() -> int:
    """Draw the pictures and write the page."""
    FOLDER.mkdir(exist_ok=True)
    cards = "\n".join(map(drawn, PICTURES))
    return update({PAGE: {"gallery": f'<div class="grid cards" markdown>\n\n{cards}\n</div>'}.get}, __spec__.name)


if __name__ == "__main__":
    sys.exit(main())
