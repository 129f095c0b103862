"""Make the pictures of the site interactive that contain their scene: a hook of mkdocs."""

from __future__ import annotations

import posixpath
import re
from functools import cache
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page
from mkdocs.utils import get_relative_url

from shackled import InputError, Scene, load
from shackled.web._page import ASSETS, asset

#: The folder of the site with the files of <shackled-view>.
FOLDER = "assets/shackled"
#: The least width at which a picture can be turned, in pixels of a style sheet.
LEAST_WIDTH = 384


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the files of the element to the site."""
    for name in ASSETS:
        files.append(File.generated(config, f"{FOLDER}/{name}", content=asset(name)))
    return files


def on_page_content(html: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Put pictures with a scene into elements that draw it."""

    def turnable(match: re.Match[str]) -> str:
        path = posixpath.normpath(posixpath.join(page.url, match[2]))
        scene = scene_of(Path(config.docs_dir, path))
        if scene is None:
            return match[0]
        style = f"max-width: {max(scene.width, LEAST_WIDTH)}px"
        return f'<shackled-view src="{match[2]}" label="{match[1]}" style="{style}">{match[0]}</shackled-view>'

    found = re.sub(r'<img alt="([^"]*)" src="([^":]+\.png)" />', turnable, html)
    if found == html:
        return html
    script = get_relative_url(f"{FOLDER}/{ASSETS[0]}", page.url)
    return f'{found}\n<script type="module" src="{script}"></script>'


@cache
def scene_of(path: Path) -> Scene | None:
    """Return the scene that a picture carries; None if it carries none."""
    try:
        return load(path)
    except InputError:
        return None
