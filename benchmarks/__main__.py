"""`python -m benchmarks`: print all tables and write them to results.md and results.json."""

from . import FOLDER, cost, run_main, stages, write_figures

RESULTS, FIGURES = FOLDER / "results.md", FOLDER / "results.json"


def main() -> int:
    """Make the tables."""
    written = ["# Benchmarks\n\nMade by `python -m benchmarks`. Gas is exact: the same on every machine.\n"]
    data = {}
    for part in (cost.section, stages.section):
        section = part()
        written.append(f"## {section.title}\n\n{section.text}\n")
        print(written[-1], flush=True)
        data[section.title] = section.data
    if all(data.values()) or not FIGURES.exists():
        RESULTS.write_text("\n".join(written), "utf-8")
        write_figures(FIGURES, data)
        print(f"written: {RESULTS.name}, {FIGURES.name}")
    else:
        print(f"{RESULTS.name} and {FIGURES.name} are left as they are, since a part was skipped")
    return 0


if __name__ == "__main__":
    run_main(main)
