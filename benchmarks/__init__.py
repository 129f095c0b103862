"""Measure what pictures cost in gas: the snapshot of the tests, and the tables of `python -m benchmarks`."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike
from tools.pages import ROOT, update

from shackled import ShackledError

FOLDER = ROOT / "benchmarks"
README = FOLDER / "README.md"


@dataclass(frozen=True)
class Section:
    """A part of the results: its text, and the exact figures."""

    title: str
    text: str
    data: dict[str, Any]


def run_main(main: Callable[[], int | None], has_options: bool = False) -> NoReturn:
    """Run the command of a module, and end. What it needs and is not there is said in one sentence.

    has_options: whether it reads its arguments itself; others take none but --help.
    """
    module = sys.modules["__main__"]
    if not has_options:
        name = module.__spec__.name.removesuffix(".__main__") if module.__spec__ else ""
        form = argparse.RawDescriptionHelpFormatter
        argparse.ArgumentParser(f"python -m {name}", description=module.__doc__, formatter_class=form).parse_args()
    try:
        sys.exit(main())
    except ModuleNotFoundError as error:
        sys.exit(f"the package {error.name} is not installed: pip install {(error.name or '').replace('_', '-')}")
    except FileNotFoundError as error:
        hint = ": npm ci in contracts/" if "node_modules" in str(error.filename) else ""
        sys.exit(f"{error.filename} does not exist{hint}")
    except ShackledError as error:
        sys.exit(" ".join(str(error).split()))


def read_figures(path: Path) -> dict[str, Any]:
    """Return the figures of a JSON file; none if it does not exist yet."""
    figures: dict[str, Any] = json.loads(path.read_text("utf-8")) if path.exists() else {}
    return figures


def write_figures(path: Path, figures: Any, sort_keys: bool = False) -> None:
    """Write figures to a JSON file."""
    path.write_text(json.dumps(figures, indent=1, sort_keys=sort_keys) + "\n", "utf-8")


def measured(heading: str, parts: Iterable[Callable[[], Section]]) -> tuple[str, dict[str, Any]]:
    """Measure parts, print each, and return the whole text and the figures by the titles."""
    written, data = [heading], {}
    for part in parts:
        section = part()
        written.append(f"## {section.title}\n\n{section.text}\n")
        print(written[-1], flush=True)
        data[section.title] = section.data
    return "\n".join(written), data


def publish(name: str, figures: dict[str, Any], text: str, page: Path = README, mark: str | None = None) -> int:
    """Print a text. Write the figures of a module of this folder to NAME.json, the text to a page under its mark, by
    default the name of the module. Return the exit code.
    """
    print(text)
    write_figures(FOLDER / f"{name}.json", figures)
    return update({page: {mark or name: text}.get}, f"python -m benchmarks.{name}")


def flip(right: ArrayLike, seen: ArrayLike) -> float:
    """Return the mean FLIP, a perceptual difference from 0 to 1, of two pictures (H, W, 3) in levels from 0 to 255."""
    from flip_evaluator import evaluate

    pair = ((np.asarray(each) / 255).astype(np.float32) for each in (right, seen))
    return float(evaluate(*pair, "LDR", applyMagma=False)[1])
