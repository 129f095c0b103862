"""Compile the contracts into src/shackled/artifacts.

    python tools/build_contracts.py                  writes the artifacts
    python tools/build_contracts.py --group NAME ... those of some groups only
    python tools/build_contracts.py --check          writes nothing; fails, and says which are not up to date
    python tools/build_contracts.py --input NAME     prints the compiler's whole input of a group, libraries too
    python tools/build_contracts.py --functions NAME prints the bytes of each function of a contract, as it was built

Needs Node and `npm ci` in contracts/. The compiler is npm's solc, a JavaScript build: the same bytes on every machine.

The compiler's answers are kept in the cache folder of the user, by its version and its whole input: what was compiled
before is not compiled again.

What writes prints the functions that have more bytes than before. One that is larger than its text explains has copies:
the optimizer makes one for each literal argument (see ZERO_SLOT in contracts/src/words/Memory.sol).

contracts/groups.toml says which contracts are compiled together, and how. Groups are compiled apart, since what is
compiled together can change the order of instructions: a new token must not change the engine, whose address is made of
its bytes.
"""

from __future__ import annotations

import argparse
import fcntl
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
import tomllib
from bisect import bisect_right
from collections import Counter
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from pathlib import Path
from typing import Any

from platformdirs import user_cache_path

from shackled.artifacts import OUTPUTS as OUTPUTS
from shackled.artifacts import source as text_of
from shackled.base.whole_file import write_whole
from shackled.gas._source_map import instruction_sources

ROOT = Path(__file__).resolve().parent.parent
CONTRACTS = ROOT / "contracts"
SOURCES = CONTRACTS / "src"
LIBRARIES = CONTRACTS / "node_modules"
#: How contracts outside import these sources: as the npm package of tools/build_package.py.
PACKAGE = "shackled-contracts/"
ARTIFACTS = ROOT / "src" / "shackled" / "artifacts"
#: The source maps, for profiles.
SOURCE_MAPS = "source-maps.json"

#: The contracts and optimizer settings of each group.
GROUPS: dict[str, dict[str, Any]] = tomllib.loads((CONTRACTS / "groups.toml").read_text("utf-8"))

#: EIP-170: the largest size of a contract.
MAX_RUNTIME_SIZE = 24576
#: The largest input that Blockscout's verifier accepts by default, in bytes.
MAX_INPUT_SIZE = 2 << 20

#: A missing licence or pragma, an old annotation of memory-safe assembly (in libraries), and the size of a contract,
#: which is checked here.
HARMLESS = {"1878", "2424", "3420", "5574"}

#: For groups with `inline = false`: the compiler's own without its full inliner, which undoes the splitting of hot
#: loops into functions that fit the stack.
OPTIMIZER_STEPS = (
    "dhfoDgvulfnTUtnIf[exa[r]EescLMVcul [j]Trpeulxa[r]ecLgvefMCTUca[r]LSsTFOtfDnca[r]eIulcescCTUtgvefM]"
    "jmul[jul] VcTOcul jmul:fDnTOcmu"
)


def group_of(contract: str) -> str:
    """Return the group in which a contract is compiled."""
    return next(name for name, group in GROUPS.items() if contract in group["contracts"])


def settings_of(contract: str) -> dict[str, Any]:
    """Return the compiler's settings for a contract."""
    group = GROUPS[group_of(contract)]
    return settings(group["runs"], group["inline"])


def settings(runs: int, inline: bool) -> dict[str, Any]:
    """Return the compiler's settings.

    inline: whether functions are inlined, which is the compiler's default.
    """
    steps = {"yul": True, "yulDetails": {"stackAllocation": True, "optimizerSteps": OPTIMIZER_STEPS}}
    return {
        "viaIR": True,
        "evmVersion": "cancun",
        "optimizer": {"enabled": True, "runs": runs} | ({} if inline else {"details": steps}),
        "metadata": {"appendCBOR": False},
    }


def find_contracts() -> dict[str, str]:
    """Return the files of the contracts, as they are named in contracts/src, by contract.

    Raises SystemExit if two have the same name, or if the groups do not list exactly these contracts.
    """
    found: dict[str, str] = {}
    for path in sorted(SOURCES.rglob("*.sol")):
        if re.search(rf"^contract {path.stem}\b", path.read_text("utf-8"), re.MULTILINE):
            if path.stem in found:
                raise SystemExit(f"two contracts have the name {path.stem}")
            found[path.stem] = path.relative_to(SOURCES).as_posix()
    grouped = [contract for group in GROUPS.values() for contract in group["contracts"]]
    if sorted(grouped) != sorted(found):
        wrong = {name for name in {*grouped, *found} if grouped.count(name) != (name in found)}
        raise SystemExit(f"contracts/groups.toml must list each contract once: {', '.join(sorted(wrong))}")
    return found


def read_sources(contracts: Iterable[str]) -> dict[str, str]:
    """Read the files of contracts and their imports, by their paths in contracts/src or contracts/node_modules."""
    found = find_contracts()
    return follow_imports([found[contract] for contract in contracts])


def follow_imports(names: Iterable[str], folder: Path = SOURCES) -> dict[str, str]:
    """Read the files of these names in the folder or the libraries, and their imports."""
    sources: dict[str, str] = {}
    waiting = list(names)
    while waiting:
        name = waiting.pop()
        if name in sources:
            continue
        path = next(
            (
                path
                for path in (folder / name, LIBRARIES / name, SOURCES / name.removeprefix(PACKAGE))
                if path.is_file()
            ),
            None,
        )
        if path is None:
            raise SystemExit(f"{name} is imported, but is neither in {folder} nor in contracts/node_modules")
        sources[name] = path.read_text("utf-8")
        for target in re.findall(r"""^\s*import\b[^;"']*["']([^"']+)["']\s*;""", sources[name], re.MULTILINE):
            waiting.append(_join(name, target) if target.startswith(".") else target)
    return dict(sorted(sources.items()))


def _join(name: str, relative: str) -> str:
    parts = name.split("/")[:-1]
    for part in relative.split("/"):
        if part == "..":
            parts.pop()
        elif part != ".":
            parts.append(part)
    return "/".join(parts)


def standard_input(group: str) -> dict[str, Any]:
    """Return the input of the compiler for a group, with outputs for its contracts only."""
    contracts, found = GROUPS[group]["contracts"], find_contracts()
    selection = {found[contract]: {contract: OUTPUTS} for contract in contracts}
    return request(read_sources(contracts), settings_of(contracts[0]), selection)


def request(
    sources: dict[str, str], settings: dict[str, Any], selection: dict[str, dict[str, list[str]]]
) -> dict[str, Any]:
    """Return the input of the compiler, with outputs by source and contract."""
    return {
        "language": "Solidity",
        "sources": {name: {"content": content} for name, content in sources.items()},
        "settings": settings | {"outputSelection": selection},
    }


def run_compiler(request: str) -> dict[str, Any]:
    """Run the compiler. Input and output are files, since the compiler truncates what it writes to a pipe."""
    with tempfile.TemporaryFile("w+") as stdin, tempfile.TemporaryFile("w+") as stdout:
        stdin.write(request)
        stdin.seek(0)
        command = ["node", str(LIBRARIES / "solc" / "solc.js"), "--standard-json"]
        subprocess.run(command, stdin=stdin, stdout=stdout, check=True, cwd=CONTRACTS)
        stdout.seek(0)
        answer = stdout.read()
    result = json.loads(answer[answer.index("{") :])
    faults = [e for e in result.get("errors", []) if e["severity"] == "error" or e.get("errorCode") not in HARMLESS]
    if faults:
        raise SystemExit("\n".join(fault["formattedMessage"] for fault in faults))
    return dict(result)


def kept_answer(request: str) -> dict[str, Any]:
    """Return the compiler's answer, which is kept. A process that asks for the same waits for the first."""
    compiler = (LIBRARIES / "solc" / "package.json").read_text("utf-8")
    path = user_cache_path("shackled", appauthor=False) / f"solc-answer-{digest(compiler + request)[:32]}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not path.is_file():
            write_whole(path, json.dumps(run_compiler(request)).encode())
    answer: dict[str, Any] = json.loads(path.read_bytes())
    return answer


def compile_once(request: dict[str, Any]) -> dict[str, Any]:
    """Return the contracts that the compiler makes of an input, by source and name: see `kept_answer`."""
    contracts: dict[str, Any] = kept_answer(_text(request))["contracts"]
    return contracts


def build(groups: Sequence[str] = tuple(GROUPS)) -> dict[str, str]:
    """Return the text of every artifact file of these groups, by name."""
    files: dict[str, str] = {}
    maps = [_kept_maps(groups)]
    # a process for each group, and a thread that waits for it
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        functions = threads.submit(functions_of, groups)
        results = list(threads.map(build_group, groups))
    for built, answer in results:
        files |= built
        maps.append(source_maps(answer, functions.result()))
    files[SOURCE_MAPS] = merge_maps(maps)
    return files


def build_group(group: str) -> tuple[dict[str, str], dict[str, Any]]:
    """Return the text of every artifact file of a group, by name, and the compiler's answer."""
    asked = standard_input(group)
    if (size := len(_text(asked))) > MAX_INPUT_SIZE:
        raise SystemExit(f"the compiler's input of {group} has {size:,} bytes, more than {MAX_INPUT_SIZE:,}")
    files: dict[str, str] = {}
    answer = kept_answer(_text(with_maps(asked)))
    for source, contracts in answer["contracts"].items():
        for name, output in contracts.items():
            metadata = json.loads(output["metadata"])
            texts = {path: asked["sources"][path]["content"] for path in sorted(metadata["sources"])}
            files[f"{name}.json"] = _text(
                {
                    "contract": name,
                    "group": group,
                    "source": source,
                    "compiler": metadata["compiler"]["version"],
                    "settings": settings_of(name),
                    "sources": {path: digest(text) for path, text in texts.items()},
                    "methodIdentifiers": output["evm"]["methodIdentifiers"],
                    "abi": output["abi"],
                    "bytecode": output["evm"]["bytecode"]["object"],
                    "deployedBytecode": output["evm"]["deployedBytecode"]["object"],
                }
            )
    return files, answer


def digest(text: str) -> str:
    """Return the SHA-256 of a text."""
    return hashlib.sha256(text.encode()).hexdigest()


def outdated(groups: Sequence[str]) -> list[str]:
    """Return a line for each source of which other groups than these were compiled from another text, and them."""
    users: dict[str, set[str]] = {}
    for contract in _others(groups):
        path = ARTIFACTS / f"{contract}.json"
        hashes = json.loads(path.read_text("utf-8"))["sources"] if path.is_file() else {}
        for name, value in hashes.items():
            if digest(text_of(name) or "") != value:
                users.setdefault(name, set()).add(group_of(contract))
    return [f"compile the groups {', '.join(sorted(users[name]))}, too: {name} has changed" for name in sorted(users)]


def _others(groups: Sequence[str]) -> list[str]:
    """Return the contracts of other groups than these."""
    return [contract for name, group in GROUPS.items() if name not in groups for contract in group["contracts"]]


def with_maps(asked: dict[str, Any]) -> dict[str, Any]:
    """Return the request with source maps among the outputs, which verifiers of sources do not want."""
    more = ["evm.deployedBytecode.sourceMap", "evm.deployedBytecode.functionDebugData"]
    selection = {
        source: {contract: [*wanted, *more] for contract, wanted in contracts.items()}
        for source, contracts in asked["settings"]["outputSelection"].items()
    }
    return asked | {"settings": asked["settings"] | {"outputSelection": selection}}


def functions_of(groups: Sequence[str]) -> dict[str, list[list[Any]]]:
    """Return the functions of each source of these groups, as `_functions` does.

    One run for all groups, which only parses: with the code, syntax trees would take three times as long.
    """
    sources = read_sources(contract for group in groups for contract in GROUPS[group]["contracts"])
    settings = {"stopAfter": "parsing", "outputSelection": {"*": {"": ["ast"]}}}
    asked = request(sources, {}, {}) | {"settings": settings}
    trees = run_compiler(_text(asked))["sources"]
    return {name: _functions(each["ast"], Path(name).stem) for name, each in trees.items()}


def source_maps(answer: dict[str, Any], functions: dict[str, list[list[Any]]]) -> dict[str, Any]:
    """Return each contract's source map and the positions of its functions, and the functions of each source.

    As `shackled.gas._source_map` reads it. Places in sources are in bytes of UTF-8.
    """
    maps, used = {}, set()
    for contracts in answer["contracts"].values():
        for name, output in contracts.items():
            deployed = output["evm"]["deployedBytecode"]
            if not deployed["object"]:
                continue
            debug = deployed["functionDebugData"]
            entries = {key: value["entryPoint"] for key, value in debug.items() if value["entryPoint"] is not None}
            maps[name] = {"map": deployed["sourceMap"], "entries": entries}
            used |= {int(field) for field in re.findall(r"(?:^|;)\d*:\d*:(\d+)", deployed["sourceMap"])}
    sources = {
        str(source["id"]): {"name": name, "functions": functions[name]}
        for name, source in answer["sources"].items()
        if source["id"] in used
    }
    return {"contracts": maps, "sources": sources}


def _kept_maps(groups: Sequence[str]) -> dict[str, Any]:
    """Return the source maps on disk of the contracts of other groups than these."""
    others = _others(groups)
    path = ARTIFACTS / SOURCE_MAPS
    maps: dict[str, Any] = json.loads(path.read_text("utf-8")) if path.is_file() and others else {"sources": {}}
    return maps | {"contracts": {name: each for name, each in maps.get("contracts", {}).items() if name in others}}


def merge_maps(parts: Iterable[dict[str, Any]]) -> str:
    """Merge source maps of several runs of the compiler, each of which numbers the sources differently."""
    numbers: dict[str, str] = {}
    sources: dict[str, Any] = {}
    contracts: dict[str, Any] = {}
    found = [(name, each, part["sources"]) for part in parts for name, each in part["contracts"].items()]
    for contract, each, known in sorted(found, key=lambda row: row[0]):
        entries = [entry.split(":") for entry in each["map"].split(";")]
        for fields in entries:
            if len(fields) > 2 and fields[2]:
                source = known.get(fields[2])
                # -1: generated by the compiler
                fields[2] = "-1" if source is None else numbers.setdefault(source["name"], str(len(numbers)))
                sources |= {} if source is None else {fields[2]: source}
        contracts[contract] = each | {"map": ";".join(map(":".join, entries))}
    return json.dumps({"contracts": contracts, "sources": sources}, sort_keys=True, separators=(",", ":")) + "\n"


def _functions(node: Any, owner: str) -> list[list[Any]]:
    """Return the functions in a syntax tree: name with that of the contract or file, begin, and length."""
    if isinstance(node, list):
        return [function for each in node for function in _functions(each, owner)]
    if not isinstance(node, dict):
        return []
    if node.get("nodeType") == "ContractDefinition":
        owner = node["name"]
    if node.get("nodeType") == "FunctionDefinition":
        begin, length, _ = map(int, node["src"].split(":"))
        return [[f"{owner}.{node['name'] or node['kind']}", begin, length]]
    return [function for value in node.values() for function in _functions(value, owner)]


def _text(value: object) -> str:
    return json.dumps(value, indent=1, sort_keys=True) + "\n"


def artifacts_of(groups: Sequence[str]) -> set[str]:
    """Return the names of the artifact files on disk that belong to these groups."""
    names = set()
    for path in ARTIFACTS.glob("*.json"):
        group = "" if path.name == SOURCE_MAPS else json.loads(path.read_text("utf-8")).get("group")
        # files of groups that no longer exist belong to none
        if group in groups or group not in GROUPS:
            names.add(path.name)
    return names


def sizes(files: dict[str, str]) -> dict[str, Counter[str]]:
    """Return the bytes of each function, by contract, from artifact files, the source maps among them."""
    maps = json.loads(files.get(SOURCE_MAPS, "{}"))
    return {
        name: function_sizes(bytes.fromhex(json.loads(text)["deployedBytecode"]), mapped["map"], maps["sources"])
        for name, mapped in maps.get("contracts", {}).items()
        if (text := files.get(f"{name}.json"))
    }


def function_sizes(code: bytes, entries: str, sources: dict[str, Any]) -> Counter[str]:
    """Return the number of bytes of each function.

    Those in no function, such as of constants, are counted for their file, and those without a source for `compiler`.
    Functions within inline assembly belong to the function around them.

    entries: the compiler's source map of the code. sources: by its numbers, each with a `name` and its `functions`:
    name, first byte, and number of bytes, as in source-maps.json.
    """
    ordered: dict[int, tuple[str, list[list[Any]], list[int]]] = {}
    for key, source in sources.items():
        functions = sorted(source["functions"], key=lambda function: int(function[1]))
        ordered[int(key)] = source["name"], functions, [begin for _, begin, _ in functions]
    counted: Counter[str] = Counter()
    instructions = [(at, number, begin) for at, number, begin, _, _ in instruction_sources(code, entries)]
    for (at, number, begin), (end, _, _) in pairwise([*instructions, (len(code), -1, 0)]):
        file, functions, begins = ordered.get(number, ("compiler", [], []))
        # the last one that begins at or before it
        name, first, length = functions[bisect_right(begins, begin) - 1] if functions else (file, 0, 0)
        counted[name if first <= begin < first + length else file] += end - at
    return counted


def risen(before: dict[str, Counter[str]], after: dict[str, Counter[str]]) -> list[str]:
    """Return a line for each contract with functions that have more bytes than before: these, most more first."""
    lines = []
    for contract in sorted(before.keys() & after.keys()):
        old, new = before[contract], after[contract]
        if more := (new - old).most_common():
            lines.append(f"{contract}: " + ", ".join(f"{name} {old[name]:,} -> {new[name]:,}" for name, _ in more))
    return lines


def differences(files: dict[str, str], groups: Sequence[str]) -> list[str]:
    """Return how the artifacts on disk differ from these, one line each."""
    found = artifacts_of(groups)
    lines = [f"{name} is not built from any source" for name in sorted(found - files.keys())]
    for name, text in files.items():
        if name not in found:
            lines.append(f"{name} is missing")
        elif (actual := (ARTIFACTS / name).read_bytes()) != text.encode():
            try:
                old, new = json.loads(actual), json.loads(text)
                keys = [key for key in sorted(old.keys() | new.keys()) if old.get(key) != new.get(key)]
            except ValueError:
                keys = []
            lines.append(f"{name} differs: {', '.join(keys) or 'its format'}")
    return lines


def report_sizes(files: dict[str, str]) -> bool:
    """Print the size of every contract; return whether all are within the limit."""
    fits = True
    for name, text in files.items():
        if name != SOURCE_MAPS:
            size = len(json.loads(text)["deployedBytecode"]) // 2
            fits &= size <= MAX_RUNTIME_SIZE
            remark = "" if size <= MAX_RUNTIME_SIZE else ", TOO LARGE"
            print(f"{name.removesuffix('.json')}: {size:,} of {MAX_RUNTIME_SIZE:,} bytes{remark}")
    return fits


def main() -> int:
    """Build or check the artifacts."""
    parser = argparse.ArgumentParser(description="Compile the contracts into src/shackled/artifacts.")
    parser.add_argument("--check", action="store_true", help="write nothing; fail if the artifacts are not up to date")
    parser.add_argument("--group", nargs="+", choices=tuple(GROUPS), help="only the contracts of these groups")
    parser.add_argument("--input", choices=tuple(GROUPS), help="print the compiler's input of a group, and stop")
    every = [name for group in GROUPS.values() for name in group["contracts"]]
    parser.add_argument("--functions", choices=every, metavar="NAME", help="print the bytes of each function, and stop")
    options = parser.parse_args()
    if options.functions:
        files = {name: (ARTIFACTS / name).read_text("utf-8") for name in (f"{options.functions}.json", SOURCE_MAPS)}
        for name, size in sizes(files)[options.functions].most_common():
            print(f"{size:6,} {name}")
        return 0
    if options.input:
        print(_text(standard_input(options.input)), end="")
        return 0
    groups = options.group or tuple(GROUPS)
    files = build(groups=groups)
    others = outdated(groups)
    if options.check:
        fits = report_sizes(files)
        lines = differences(files, groups) + others
        for line in lines:
            print(line, file=sys.stderr)
        if lines:
            print("the artifacts differ from the sources: run tools/build_contracts.py", file=sys.stderr)
        return 0 if fits and not lines else 1
    before = sizes({name: (ARTIFACTS / name).read_text("utf-8") for name in files if (ARTIFACTS / name).is_file()})
    for name in artifacts_of(groups) - files.keys():
        (ARTIFACTS / name).unlink()
    for name, text in files.items():
        (ARTIFACTS / name).write_text(text, "utf-8", newline="\n")
    # last, since a closed pipe ends the command
    fits = report_sizes(files)
    if rises := risen(before, sizes(files)):
        print("functions with more bytes than before:", *rises, sep="\n")
    for line in others:
        print(line, file=sys.stderr)
    return 0 if fits and not others else 1


if __name__ == "__main__":
    sys.exit(main())
