"""Update the figures of README.md and docs/light.md: those of benchmarks/ and of docs/images/pictures.json.

python -m tools.readme            writes them between the marks <!-- begin NAME --> and <!-- end NAME -->
python -m tools.readme --check    writes nothing; fails if they are not up to date
"""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any

from tools.pages import ROOT, update

README = ROOT / "README.md"
LIGHT = ROOT / "docs" / "light.md"
RESULTS = ROOT / "benchmarks" / "results.json"
TOKENS = ROOT / "benchmarks" / "tokens.json"
PICTURES = ROOT / "docs" / "images" / "pictures.json"
EFFECTS = ROOT / "benchmarks" / "effects.json"

#: Numbers in words, for sentences.
COUNTS = {5: "five", 6: "six", 7: "seven"}

#: Rows of the cost table for the README: a part of the name of the row, and the title.
ROWS = {
    "obj_*_cull": "a model of about 1,000 triangles, lit (mean of 15)",
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


def pictures() -> str:
    """Return the table of what the pictures of the documentation cost."""
    data = json.loads(PICTURES.read_text("utf-8"))
    scene, strip, teapot = data["scene"], data["strip"], data["teapot"]
    return (
        f"Every pixel above was computed by contracts. The still life: {scene['width']} x {scene['height']} pixels,"
        f" {scene['triangles']:,} triangles, {millions(scene['gas'])} gas.\n"
        f"The strip: {COUNTS[len(strip['gas'])]} pictures of 128 x 128 pixels, {min(strip['gas']) / 1e6:.1f} to"
        f" {max(strip['gas']) / 1e6:.1f} million gas each.\n"
        f"The teapot of `make demo`: {teapot['triangles']:,} triangles drawn at"
        f" {teapot['width']} x {teapot['height']} pixels, {millions(teapot['gas'])} gas."
    )


def effects() -> str:
    """Return the table of what the pictures of docs/light.md cost, from left to right."""
    data = json.loads(PICTURES.read_text("utf-8"))
    lines = ["| pictures | without | with |", "|---|---:|---:|"]
    for name, title in {"hemisphere": "hemisphere light", "rim": "rim", "fog": "fog", "tone": "tone"}.items():
        first, *others = (f"{gas / 1e6:.1f}" for gas in data[name]["gas"])
        lines.append(f"| {title} | {first} | {', '.join(others)} |")
    return "\n".join(lines)


def pixels() -> str:
    """Return the table of what each effect costs for each pixel."""
    data: dict[str, list[int]] = json.loads(EFFECTS.read_text("utf-8"))
    lines = ["| gas for each pixel | flat | smooth |", "|---|---:|---:|"]
    lines += [f"| {name} | {' | '.join(f'{gas:,}' for gas in each)} |" for name, each in data.items()]
    return "\n".join(lines)


def showcase() -> str:
    """Return a line about the scenes of the showcase."""
    gas = json.loads(PICTURES.read_text("utf-8"))["showcase"].values()
    return (
        f"`shackled datasets showcase -o DIR` draws these {len(gas)} scenes, {millions(min(gas))} to"
        f" {millions(max(gas))} gas each."
    )


def millions(gas: float) -> str:
    """Format gas as 4.9 million."""
    return f"{gas / 1e6:,.1f} million" if gas < 1e8 else f"{gas / 1e6:,.0f} million"


def main() -> int:
    """Update the figures, or check that they are up to date."""
    parser = argparse.ArgumentParser(description="Update the figures of README.md.")
    parser.add_argument("--check", action="store_true", help="write nothing; fail if they are not up to date")
    check = parser.parse_args().check
    contents = {each.__name__: each for each in (costs, effects, pictures, pixels, showcase, tokens)}
    return update(dict.fromkeys((README, LIGHT), lambda name: contents[name]()), "python -m tools.readme", check)


if __name__ == "__main__":
    sys.exit(main())
