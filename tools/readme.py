"""Make tables of README.md and docs/: figures of benchmarks/ and of pictures.json, and the settings of a look."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from shackled.scene._settings import SETTINGS
from tools.pages import DOCS, IMAGES, ROOT, filled

PAGES = (ROOT / "README.md", DOCS / "index.md", DOCS / "light.md", DOCS / "look.md")
RESULTS = ROOT / "benchmarks" / "results.json"
TOKENS = ROOT / "benchmarks" / "tokens.json"
PICTURES = IMAGES / "pictures.json"
EFFECTS = ROOT / "benchmarks" / "effects.json"

#: Rows of the cost table for the README: a part of the name of the row, and the title.
ROWS = {
    "mean of the 10 of them": "a model of about 1,000 triangles, lit (mean of 10)",
    "genesis_000": "a piece of the Genesis collection (mean of 24)",
    "cube_persp_128": "a cube",
    "cube_persp_512": "a cube, 512 x 512",
}


def costs() -> str:
    """Return the table of what pictures cost."""
    if not RESULTS.exists():
        return "Run `make bench` for the figures."
    data: dict[str, dict[str, Any]] = next(iter(json.loads(RESULTS.read_text("utf-8")).values()))
    lines = ["| picture, 128 x 128 | original, gas | Shackled, gas | ratio |", "|---|---:|---:|---:|"]
    for part, name in ROWS.items():
        row = next((values for key, values in data.items() if part in key and values["original"]), None)
        if row is not None:
            ratio = f"{row['original'] / row['gas']:,.0f}"
            lines.append(f"| {name} | {millions(row['original'])} | {millions(row['gas'])} | {ratio} |")
    return "\n".join(lines)


def tokens() -> str:
    """Return the table of what tokens cost, beside what they cost in the original."""
    data: dict[str, int] = json.loads(TOKENS.read_text("utf-8"))
    pieces: dict[str, dict[str, Any]] = next(iter(json.loads(RESULTS.read_text("utf-8")).values()))
    mean = next(row["gas"] for name, row in pieces.items() if name.startswith("Genesis `tokenURI`, mean"))
    most = next(row["gas"] for name, row in pieces.items() if name.startswith("Genesis `tokenURI`, most"))
    return (
        "| Genesis | original, gas | Shackled, gas |\n|---|---:|---:|\n"
        f"| mint 1 | 124 thousand | {data['mint 1'] / 1e3:.0f} thousand |\n"
        f"| mint 5 | 712 thousand | {data['mint 5'] / 1e3:.0f} thousand |\n"
        "| `tokenURI`, metadata and picture | 5,700 to 14,400 million |"
        f" {millions(mean)} on average, {millions(most)} at most |"
    )


def scene() -> str:
    """Return the line about the still life, docs/images/scene.png."""
    data = json.loads(PICTURES.read_text("utf-8"))["scene"]
    return (
        f"*{data['width']} x {data['height']} pixels, {data['triangles']:,} triangles, {millions(data['gas'])} gas."
        " Turn the picture: your browser runs the contracts.*"
    )


def effects() -> str:
    """Return the table of what the pictures of docs/light.md cost, from left to right."""
    data = json.loads(PICTURES.read_text("utf-8"))
    lines = ["| pictures | without | with |", "|---|---:|---:|"]
    for name, title in {"hemisphere": "hemisphere light", "rim": "rim", "fog": "fog", "tone": "tone"}.items():
        first, *others = (f"{gas / 1e6:.1f}" for gas in data[name]["gas"])
        lines.append(f"| {title} | {first} | {', '.join(others)} |")
    return "\n".join(lines)


def models() -> str:
    """Return the table of what effects cost on models: gas without them, and by what each multiplies it."""
    data: dict[str, dict[str, int]] = json.loads(EFFECTS.read_text("utf-8"))
    columns = {"teapot": "`teapot`, 256 x 256", "icons/crystals": "`icons/crystals`, 128 x 128"}
    columns["icons/rocket, quick path"] = "`icons/rocket`, 128 x 128, quick path"
    (first, *names), plain = data["teapot"], [next(iter(data[model].values())) for model in columns]
    lines = [f"| | {' | '.join(columns.values())} |", "|---|---:|---:|---:|"]
    lines.append(f"| {first} | {' | '.join(millions(gas) for gas in plain)} |")
    for name in names:
        ratios = (f"x {data[model][name] / gas:.2f}" for model, gas in zip(columns, plain, strict=True))
        lines.append(f"| {name} | {' | '.join(ratios)} |")
    return "\n".join(lines)


def settings() -> str:
    """Return the table of all settings of a look."""
    lines = ["| keyword | option | what it sets | values | default |", "|---|---|---|---|---|"]
    for setting in SETTINGS:
        option = setting.option.replace("/", "`, `")
        lines.append(f"| `{setting.name}` | `{option}` | {setting.text} | {setting.values} | {setting.default} |")
    return "\n".join(lines)


def millions(gas: float) -> str:
    """Format gas as 4.9 million."""
    return f"{gas / 1e6:,.1f} million" if gas < 1e8 else f"{gas / 1e6:,.0f} million"


def files() -> dict[Path, str]:
    """Return the texts of the pages, by their paths."""
    found = {each.__name__: each() for each in (costs, effects, models, scene, settings, tokens)}
    return {page: filled(page, found.get) for page in PAGES}
