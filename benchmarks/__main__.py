"""`python -m benchmarks`: print all tables and write them to results.md and results.json."""

from __future__ import annotations

from . import FOLDER, cost, measured, run_main, stages, write_figures

RESULTS, FIGURES = FOLDER / "results.md", FOLDER / "results.json"


def main() -> int:
    """Make the tables."""
    heading = "# Benchmarks\n\nMade by `python -m benchmarks`. Gas is exact: the same on every machine.\n"
    text, data = measured(heading, (cost.section, stages.section))
    if all(data.values()) or not FIGURES.exists():
        RESULTS.write_text(text, "utf-8")
        write_figures(FIGURES, data)
        print(f"written: {RESULTS.name}, {FIGURES.name}")
    else:
        print(f"{RESULTS.name} and {FIGURES.name} are left as they are, since a part was skipped")
    return 0


if __name__ == "__main__":
    run_main(main)
