"""Make faulty versions of the contracts that draw, and of the definition, and find out which tests detect them.

    python -m tools.mutants                 the mutants of the present contracts, in at most three hours on two cores
    python -m tools.mutants --picture       those of contracts/picture.py, which needs OpenGL
    python -m tools.mutants --count 20      so many, spread over the folders
    python -m tools.mutants --list          what would be changed, without compiling it

A mutant differs from a contract in one place of one file: see OPERATORS. Places are chosen by the file's text, so a
change of one file leaves the mutants of the others alone. Only one contract that uses the file is compiled. Results are
kept in build/mutants.jsonl, by the compiled sources and the judges: what was interrupted goes on where it stopped.
Prints a table in Markdown; a mutant that nothing detects is not necessarily a gap: see docs/conformance.md.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from hashlib import sha256
from itertools import zip_longest
from pathlib import Path
from typing import Any
from unittest.mock import patch

from shackled.artifacts import RENDERER, artifact
from shackled.chain._embedded import EmbeddedChain, RevmChain
from tools import build_contracts as tool

ROOT = tool.ROOT
RESULTS = ROOT / "build" / "mutants.jsonl"
FOLDERS = ("scene", "uniforms", "effects", "pipeline", "shadows")
#: A mutant of the definition takes its place in the judge, too, which therefore is no witness: see OF_PICTURE.
PICTURE = tool.CONTRACTS / "picture.py"
#: Of each file, so many mutants are tried before those of other files are.
PER_FILE = 4
#: The gas of a call, with which an endless loop ends soon, and the seconds of a mutant's tests.
GAS, SECONDS = 1 << 31, 900
#: Warnings about what is left over in broken code: variables, states, unreachable code.
LEFT_OVER = {"2018", "2072", "5667", "5740", "6133"}
#: The exact rules: which samples a triangle covers, wires, clipping, tiles, symmetry, depth, and refusals.
RULES = [
    "tests/judge/test_judge.py",
    "tests/contracts/test_fill_rule.py",
    "tests/contracts/test_bad_input_on_chain.py",
    "tests/contracts/test_watertight.py",
    "tests/contracts/test_wire_rule.py",
    "tests/contracts/test_clipping.py",
    "tests/contracts/test_tiles.py",
    "tests/contracts/test_symmetry.py",
    "tests/contracts/test_depth.py",
    "tests/test_rules.py",
    "tests/contracts/test_coincident_faces.py",
    "tests/contracts/test_shadows.py",
    "tests/contracts/test_tile_culling.py",
    "tests/test_transparent.py",
    "tests/contracts/test_random_scenes.py",
]
#: Those that hold when the definition draws in place of the contracts.
RULES_OF_PICTURE = [
    "tests/judge/test_judge.py::test_coverage_of_a_square",
    "tests/judge/test_judge.py::test_light_of_a_sphere",
    "tests/contracts/test_fill_rule.py::test_a_pixel_on_each_kind_of_edge",
    "tests/contracts/test_fill_rule.py::test_slivers",
    "tests/contracts/test_clipping.py::test_the_near_plane_cuts_where_it_is",
    "tests/contracts/test_depth.py::test_of_two_coplanar_triangles_the_first_wins",
]
#: Seeds of random scenes, of each kind, that the judge sees; of those that OpenGL sees, and the most triangles of one.
SEEDS, OPENGL_SEEDS, TRIANGLES = range(1, 9), range(1, 17), 300


@dataclass(frozen=True)
class Mutant:
    """A change of a file. kind: the operator. place, end: what is replaced, by `new`."""

    file: str
    kind: str
    place: int
    end: int
    new: str

    def apply(self, text: str) -> str:
        """Return the changed text of the file."""
        return text[: self.place] + self.new + text[self.end :]

    def describe(self, text: str) -> tuple[str, str]:
        """Return the changed line, before and after, without indentation."""
        start = text.rfind("\n", 0, self.place) + 1
        stop = text.find("\n", self.end)
        line = text[start : self.place] + self.new + text[self.end : stop]
        return " ".join(text[start:stop].split()), " ".join(line.split()) or "nothing"


# ---- the operators: (text without comments) -> (begin, end, replacement) ----

Places = Iterator[tuple[int, int, str]]
TURNED = {"lt": "gt", "gt": "lt", "slt": "sgt", "sgt": "slt"}
EDGES = {"<": "<=", ">": ">=", "<=": "<", ">=": ">", "==": "!=", "!=": "=="}


def _arguments(text: str, place: int) -> list[tuple[int, int]]:
    """Return where the arguments of a call in assembly are; `place` is behind its parenthesis."""
    found, depth, start = [], 0, place
    for i in range(place, len(text)):
        if depth == 0 and text[i] in ",)":
            found.append((start, i))
            start = i + 1
            if text[i] == ")":
                return found
        depth += {"(": 1, ")": -1}.get(text[i], 0)
    return []


def constants(text: str) -> Places:
    """A constant by one."""
    for match in re.finditer(r"(?<![\w.])(0x[0-9a-fA-F]+|\d+)(?![\w.])", text):
        value = int(match[0], 0) + 1
        yield match.start(), match.end(), hex(value) if match[0].startswith("0x") else str(value)


def comparisons(text: str) -> Places:
    """A comparison turned, or moved by one."""
    for match in re.finditer(r"\b(s?[lg]t)\(", text):
        yield match.start(1), match.end(1), TURNED[match[1]]
    for match in re.finditer(r" ([<>]=?|==|!=) ", text):
        yield match.start(1), match.end(1), EDGES[match[1]]


def terms(text: str) -> Places:
    """A term dropped, or a mask."""
    for match in re.finditer(r"\b(add|sub|or|and)\(", text):
        arguments = _arguments(text, match.end())
        if len(arguments) == 2:
            # masks stand first, or second
            (a, b), (c, d) = arguments
            keep = text[c:d] if match[1] == "and" and text[a:b].isupper() else text[a:b]
            yield match.start(), d + 1, keep.strip()
    for match in re.finditer(r" [+|&-] [\w.]+(\([^()]*\))?(?=[ ;)\]])", text):
        yield match.start(), match.end(), ""


def lanes(text: str) -> Places:
    """A lane shifted."""
    for match in re.finditer(r"\b(?:shl|shr|sar)\(", text):
        arguments = _arguments(text, match.end())
        if len(arguments) == 2:
            (a, b), _ = arguments
            yield a, b, f"add({text[a:b]}, 1)"
    for match in re.finditer(r"(?:<<|>>) ([A-Z_0-9]+)", text):
        yield match.start(1), match.end(1), f"({match[1]} + 1)"


def checks(text: str) -> Places:
    """A check or a special case removed."""
    for match in re.finditer(r"^ +if \((?:[^;{}])*;", text, re.M):
        yield match.start(), match.end(), ""


def factors(text: str) -> Places:
    """A factor or a divisor dropped."""
    for match in re.finditer(r" [*/@] [\w.]+(\([^()]*\))?(?=[ ,)\]\n])", text):
        yield match.start(), match.end(), ""


OPERATORS: dict[str, Callable[[str], Places]] = {
    "constant": constants,
    "comparison": comparisons,
    "term": terms,
    "lane": lanes,
    "check": checks,
}


def mutants_of(file: str) -> list[Mutant]:
    """Return the mutants of a file, one of each operator in turn, in an order that its text determines."""
    text = (tool.SOURCES / file).read_text("utf-8")
    # what is left out keeps its length, so that places are those of the text
    code = re.sub(
        r"//.*|^(?:pragma|import|uint256 constant|int256 constant).*", lambda m: " " * len(m[0]), text, flags=re.M
    )
    code = blanked(r"^import\b[^;]*;|\"[^\"\n]*\"", code)
    # the line that names functions of picture.py does not choose the places
    return shuffled(file, code, OPERATORS, re.sub(r"^// .* of picture\.py.*\n\n?", "", text, flags=re.M))


def mutants_of_picture() -> list[Mutant]:
    """Return the mutants of the definition, but for comments and strings."""
    text = PICTURE.read_text("utf-8")
    code = blanked(r'"""(?s:.*?)"""|"[^"\n]*"|#.*', text)
    return shuffled(PICTURE.name, code, OPERATORS | {"factor": factors}, text)


def blanked(pattern: str, text: str) -> str:
    """Return the text without what matches the pattern, which leaves its lines and length."""
    return re.sub(pattern, lambda m: re.sub(r"\S", " ", m[0]), text, flags=re.M)


def shuffled(file: str, code: str, operators: dict[str, Callable[[str], Places]], seed: str) -> list[Mutant]:
    """Return the mutants of code, one of each operator in turn, in an order that the seed determines."""
    rng = random.Random(sha256(seed.encode()).digest())
    found = []
    for kind, operator in operators.items():
        places = sorted(set(operator(code)))
        rng.shuffle(places)
        found.append([Mutant(file, kind, *place) for place in places])
    rng.shuffle(found)
    return [mutant for turn in zip_longest(*found) for mutant in turn if mutant]


def files() -> list[str]:
    """Return the files that are mutated, those of the folders in turn."""
    folders = [sorted((tool.SOURCES / folder).rglob("*.sol")) for folder in FOLDERS]
    every = [path.relative_to(tool.SOURCES).as_posix() for turn in zip_longest(*folders) for path in turn if path]
    return [file for file in every if mutants_of(file)]


# ---- compiling ----


def request_of(contract: str, sources: dict[str, str]) -> str:
    """Return the input of the compiler for a contract."""
    outputs = {tool.find_contracts()[contract]: {contract: ["evm.bytecode.object", "evm.deployedBytecode.object"]}}
    return json.dumps(tool.request(sources, tool.settings_of(contract), outputs))


def compile_one(contract: str, sources: dict[str, str]) -> dict[str, str] | None:
    """Return the code of a contract, None if it does not compile."""
    try:
        with patch.object(tool, "HARMLESS", tool.HARMLESS | LEFT_OVER):
            built = tool.run_compiler(request_of(contract, sources))
    except SystemExit:
        return None
    output = built["contracts"][tool.find_contracts()[contract]][contract]["evm"]
    return {"creation": output["bytecode"]["object"], "runtime": output["deployedBytecode"]["object"]}


# ---- what judges ----


def by_judge() -> str | None:
    """Judge random scenes: tests/judge."""
    from judge import judge
    from random_scenes import TAME, random_scene
    from shackled.errors import ShackledError

    for seed in SEEDS:
        for kind in TAME:
            try:
                faults = judge(f"{kind} {seed}", random_scene(kind, seed)).faults
            except ShackledError as error:
                faults = [type(error).__name__]
            if faults:
                return f"{kind} {seed}"
    return None


def by_tests(tests: list[str]) -> str | None:
    """Return the first file of these tests that fails."""
    import pytest

    failed: list[str] = []

    class Listener:
        def pytest_runtest_logreport(self, report: Any) -> None:
            if report.failed:
                failed.append(report.nodeid.split("::")[0].removeprefix("tests/"))

    code = pytest.main(["-x", "-q", "--tb=no", "-p", "no:cacheprovider", *tests], plugins=[Listener()])
    return (failed or [f"exit code {code}"])[0] if code else None


def by_golden() -> str | None:
    """Compare the digests of pixels, and the errors, of tests/support/golden.json; not the gas."""
    import golden

    old, new = golden.recorded(), golden.take()
    return next((name for name in old if name not in new or new[name][0] != old[name][0]), None)


def by_opengl() -> str | None:
    """Compare random scenes with OpenGL."""
    from conformance.compare import compare
    from random_scenes import random_scene
    from shackled.scene._in_range import in_range

    scenes = ((seed, random_scene("plain", seed)) for seed in OPENGL_SEEDS)
    small = ((seed, scene) for seed, scene in scenes if in_range(scene).triangles <= TRIANGLES)
    return next((f"plain {seed}" for seed, scene in small if compare("", scene).faults), None)


JUDGES: dict[str, Callable[[], str | None]] = {
    "judge": by_judge,
    "rules": partial(by_tests, RULES),
    "golden": by_golden,
}
OF_PICTURE: dict[str, Callable[[], str | None]] = {
    "OpenGL": by_opengl,
    "rules": partial(by_tests, RULES_OF_PICTURE),
    "contracts": partial(by_tests, ["tests/contracts/test_definition.py"]),
}


def run(file: str, judge: str) -> None:
    """Print what a judge finds when a mutant is in the place of its contract, as JSON."""
    if Path(file).name == PICTURE.name:
        import picture  # before pytest finds the one that is right
        import pictures

        if judge != "contracts":
            # tests that are imported from now on draw with it
            patch.object(pictures, "draw", lambda scene: picture.draw(pictures.call_data("render", scene))).start()
        print(json.dumps(OF_PICTURE[judge]()))
        return
    mutant = json.loads(Path(file).read_text("utf-8"))
    name, creation = mutant["contract"], bytes.fromhex(mutant["creation"])
    built = artifact(name)
    object.__setattr__(built, "runtime", bytes.fromhex(mutant["runtime"]))
    init, create = EmbeddedChain.__init__, RevmChain.create

    def create_mutant(chain: RevmChain, contract: str, code: bytes) -> bytes:
        # addresses follow from the creation code of the contract that is right
        return create(chain, contract, creation + code[len(built.creation) :] if contract == name else code)

    with (
        patch.object(EmbeddedChain, "__init__", lambda self, gas_limit=GAS: init(self, min(gas_limit, GAS))),
        patch.object(RevmChain, "create", create_mutant),
    ):
        print(json.dumps(JUDGES[judge]()))


def killer(file: Path, judge: str) -> str | None:
    """Return what a judge finds of a mutant, in a process of its own that imports what is beside the file."""
    command = [sys.executable, "-m", "tools.mutants", "--run", str(file), judge]
    folders = (file.parent, "", "tests", "tests/contracts", "tests/support", "src", "contracts")
    paths = os.pathsep.join(str(ROOT / folder) for folder in folders)
    # one thread each: the arrays are small
    environment = os.environ | {"PYTHONPATH": paths, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    try:
        done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, env=environment, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return "time"
    if done.returncode:
        return "crash: " + (done.stderr.strip().splitlines() or ["?"])[-1][:60]
    found: str | None = json.loads(done.stdout.strip().splitlines()[-1])
    return found


# ---- a run ----


def tried(mutant: Mutant) -> dict[str, Any] | None:
    """Compile a mutant and let all judges find it; None if it does not compile, or changes no code."""
    text = (tool.SOURCES / mutant.file).read_text("utf-8")
    old, new = mutant.describe(text)
    users = [name for name in RENDERER if mutant.file in tool.read_sources([name])]
    random.Random(old + new).shuffle(users)
    for contract in users:
        sources = tool.read_sources([contract])
        changed = sources | {mutant.file: mutant.apply(text)}
        key = sha256((request_of(contract, changed) + " ".join(JUDGES)).encode()).hexdigest()[:16]
        known = recorded().get(key)
        if known is None:
            built = compile_one(contract, changed)
            known = {"key": key, "file": mutant.file, "kind": mutant.kind, "old": old, "new": new, "contract": contract}
            if built is None:
                known["left out"] = "does not compile"
            elif built["creation"] == artifact(contract).creation.hex():
                known["left out"] = "the same code"
            else:
                with tempfile.TemporaryDirectory() as folder:
                    path = Path(folder, "mutant.json")
                    path.write_text(json.dumps(built | {"contract": contract}), "utf-8")
                    known["killed by"] = {}
                    for judge in JUDGES:
                        if judge == "rules" and known["killed by"]["judge"]:
                            known["killed by"][judge] = None
                            continue
                        known["killed by"][judge] = killer(path, judge)
            with RESULTS.open("a", encoding="utf-8") as file:
                file.write(json.dumps(known) + "\n")
        if known.get("left out") == "does not compile":
            return None
        if "killed by" in known:
            return known
    return None


def tried_in_place(mutant: Mutant) -> dict[str, Any] | None:
    """Let all judges find a mutant of the definition; None if it is no program."""
    text = PICTURE.read_text("utf-8")
    changed = mutant.apply(text)
    try:
        compile(changed, PICTURE.name, "exec")
    except SyntaxError:
        return None
    key = sha256((changed + " ".join(OF_PICTURE)).encode()).hexdigest()[:16]
    known = recorded().get(key)
    if known is None:
        old, new = mutant.describe(text)
        function = ["", *re.findall(r"^(?:def|class|    def(?= \w+\(self)) (\w+)", text[: mutant.place], re.M)][-1]
        known = {"key": key, "file": PICTURE.name, "kind": mutant.kind, "old": old, "new": new, "contract": function}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, PICTURE.name)
            path.write_text(changed, "utf-8")
            known["killed by"] = dict[str, str | None].fromkeys(OF_PICTURE)
            for judge in OF_PICTURE:
                if found := killer(path, judge):
                    known["killed by"][judge] = found
                    break
        with RESULTS.open("a", encoding="utf-8") as file:
            file.write(json.dumps(known) + "\n")
    return known


def recorded() -> dict[str, dict[str, Any]]:
    """Return the results of earlier runs, by key."""
    if not RESULTS.is_file():
        return {}
    rows = [json.loads(line) for line in RESULTS.read_text("utf-8").splitlines()]
    return {row["key"]: row for row in rows}


def of_file(file: str, number: int) -> dict[str, Any] | None:
    """Return the result of the mutant of a file with this number, among those that compile and change its code."""
    found = 0
    for mutant in mutants_of(file)[: 4 * PER_FILE]:
        result = tried(mutant)
        if result is not None:
            found += 1
            if found > number:
                return result
    return None


def table(rows: list[dict[str, Any]]) -> str:
    """Return the results in Markdown, a line for each mutant."""
    judges, folders = [*rows[0]["killed by"]], [*FOLDERS, PICTURE.name]
    head = ["file", "function" if rows[0]["file"] == PICTURE.name else "contract", "change", *judges]
    lines = [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    for row in sorted(rows, key=lambda row: (folders.index(row["file"].split("/")[0]), row["file"], row["old"])):
        before, after = shortened(row["old"], row["new"])
        marks = (row["killed by"][judge] or "" for judge in judges)
        cells = [row["file"], row["contract"], f"`{before}` → `{after}`".replace("|", "\\|"), *marks]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def shortened(old: str, new: str, around: int = 12) -> tuple[str, str]:
    """Return what differs between two lines, with a few characters before and after."""
    start = next((i for i, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), min(len(old), len(new)))
    stop = next((i for i, (a, b) in enumerate(zip(old[::-1], new[::-1], strict=False)) if a != b), 0)
    stop = min(stop, len(old) - start, len(new) - start)
    begin, rest = max(0, start - around), max(0, stop - around)
    return old[begin : len(old) - rest], new[begin : len(new) - rest] or "nothing"


def summary(rows: list[dict[str, Any]]) -> str:
    """Return in Markdown how many mutants of each folder each judge detects, and how many none does."""
    counts = {folder: Counter[str]() for folder in [*FOLDERS, PICTURE.name, "**all**"]}
    judges = [*rows[0]["killed by"]]
    for row in rows:
        found = [judge for judge in judges if row["killed by"][judge]] or ["none"]
        for folder in (row["file"].split("/")[0], "**all**"):
            counts[folder].update(["mutants", *found])
    names = ["mutants", *judges, "none"]
    lines = [f"| folder | {' | '.join(names)} |", "|---" * (1 + len(names)) + "|"]
    for folder, found_by in counts.items():
        if found_by:
            lines.append(f"| {folder} | {' | '.join(str(found_by[name]) for name in names)} |")
    return "\n".join(lines)


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(prog="tools.mutants", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--picture", action="store_true", help="mutants of contracts/picture.py")
    parser.add_argument("--count", type=int, default=80, help="how many mutants (80)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes")
    parser.add_argument("--list", action="store_true", help="show what would be changed")
    parser.add_argument("--run", nargs=2, metavar=("FILE", "JUDGE"), help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.run:
        run(*arguments.run)
        return 0
    if arguments.list:
        for file in files():
            text = (tool.SOURCES / file).read_text("utf-8")
            for mutant in mutants_of(file)[:PER_FILE]:
                print(f"{file}: {mutant.kind}: {' -> '.join(shortened(*mutant.describe(text), 30))}")
        return 0
    RESULTS.parent.mkdir(exist_ok=True)
    tasks: list[Callable[[], dict[str, Any] | None]]
    if arguments.picture:
        unchanged = tried_in_place(Mutant(PICTURE.name, "", 0, 0, ""))
        if unchanged is None or any(unchanged["killed by"].values()):
            raise SystemExit(f"picture.py does not pass as it is: {unchanged}")
        tasks = [partial(tried_in_place, mutant) for mutant in mutants_of_picture()[: arguments.count]]
    else:
        chosen = [(file, number) for number in range(PER_FILE) for file in files()][: arguments.count]
        tasks = [partial(of_file, *each) for each in chosen]
    started, rows = time.perf_counter(), []
    with ThreadPoolExecutor(arguments.jobs) as threads:
        for done, row in enumerate(threads.map(lambda task: task(), tasks), 1):
            if row is not None:
                rows.append(row)
                found = ", ".join(f"{name}: {by}" for name, by in row["killed by"].items() if by) or "SURVIVED"
                minutes = (time.perf_counter() - started) / 60
                print(f"{done} of {len(tasks)}, {minutes:.0f} min: {row['file']}: {found}", file=sys.stderr, flush=True)
    print(table(rows))
    print()
    print(summary(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
