"""Put the Creator into the site, at creator/, if `make page` has built it, and its logo: a hook of mkdocs."""

from __future__ import annotations

from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.plugins import get_plugin_logger
from mkdocs.structure.files import File, Files

#: The folder of the site.
FOLDER = "creator"
#: Where mkdocs.yml says that the logo is.
LOGO = "images/logo.svg"


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the files of the page to the site."""
    root = Path(config.config_file_path).parent
    files.append(
        File.generated(config, LOGO, content=(root / "web" / "src" / "creator" / "logo.svg").read_text("utf-8"))
    )
    page = root / "build" / "page"
    if not page.exists():
        get_plugin_logger(__name__).info("without the Creator, which make page builds")
    for path in sorted(path for path in page.rglob("*") if path.is_file()):
        content = path.read_bytes()
        if path.name == "index.html":
            content = content.replace(b"</title>", b'</title>\n<meta name="docs" content="../" />', 1)
        files.append(File.generated(config, f"{FOLDER}/{path.relative_to(page).as_posix()}", content=content))
    return files
