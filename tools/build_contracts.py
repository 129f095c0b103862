"""Compile the contracts into src/shackled/artifacts.

    python tools/build_contracts.py                  writes the artifacts
    python tools/build_contracts.py --group NAME     those of one group only
    python tools/build_contracts.py --check          writes nothing; fails, and says which are not up to date
    python tools/build_contracts.py --input NAME     prints the compiler's whole input of a group, libraries too

Needs Node and `npm ci` in contracts/. The compiler is npm's solc, a JavaScript build: the same bytes on every machine.

Groups are compiled one by one, since what is compiled together can change the order of instructions: a new token must
not change the engine, whose address is made of its bytes.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import re
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path, PurePosixPath
from typing import Any

from Crypto.Hash import keccak

ROOT = Path(__file__).resolve().parent.parent
CONTRACTS = ROOT / "contracts"
SOURCES = CONTRACTS / "src"
LIBRARIES = CONTRACTS / "node_modules"
ARTIFACTS = ROOT / "src" / "shackled" / "artifacts"
STANDARD_INPUT = "standard-input"
#: Where in the sources of the core each instruction comes from, for profiles.
SOURCE_MAPS = "source-maps.json"

#: The engine and what draws with it: all sources but those of the other groups.
CORE = "core"
#: The folders of contracts/src that are compiled by themselves, with what they import.
GROUPS = ("calls", "studio", "tokens")

#: EIP-170: the largest contract that a chain takes.
MAX_RUNTIME_SIZE = 24576
#: What verifiers of sources accept.
MAX_STANDARD_INPUT_SIZE = 1 << 20
MAX_SOURCE_MAPS_SIZE = 1 << 20

#: No licence or pragma in a file, an old way to say that assembly is memory-safe (libraries), and the size of a
#: contract, which is checked here with a plainer message.
HARMLESS = {"1878", "2424", "3420", "5574"}

#: Chosen by measuring: without the compiler's full inliner, which undoes the splitting of hot loops into functions that
#: fit the stack.
OPTIMIZER_STEPS = (
    "dhfoDgvulfnTUtnIf[exa[r]EescLMVcul [j]Trpeulxa[r]ecLgvefMCTUca[r]LSsTFOtfDnca[r]eIulcescCTUtgvefM]"
    "jmul[jul] VcTOcul jmul:fDnTOcmu"
)
SETTINGS: dict[str, Any] = {
    "viaIR": True,
    "evmVersion": "cancun",
    "optimizer": {
        "enabled": True,
        "runs": 4000,
        "details": {"yul": True, "yulDetails": {"stackAllocation": True, "optimizerSteps": OPTIMIZER_STEPS}},
    },
    "metadata": {"appendCBOR": False},
}
OUTPUTS = ["abi", "metadata", "evm.bytecode.object", "evm.deployedBytecode.object", "evm.methodIdentifiers"]


def group_of(name: str) -> str:
    """The group of a source of ours."""
    folder = name.partition("/")[0]
    return folder if folder in GROUPS else CORE


def read_sources(folder: Path, group: str | None = None) -> dict[str, str]:
    """Every .sol file under the folder, named by its path in it, and what these import from the libraries.

    Of a group, its files and what these import from anywhere.
    """
    ours = {path.relative_to(folder).as_posix(): path for path in sorted(folder.rglob("*.sol"))}
    sources = {name: path.read_text("utf-8") for name, path in ours.items() if group is None or group_of(name) == group}
    waiting = list(sources)
    while waiting:
        name = waiting.pop()
        for target in re.findall(r"""^\s*import\b[^;"']*["']([^"']+)["']\s*;""", sources[name], re.MULTILINE):
            if target.startswith("."):
                target = _join(name, target)
            if target not in sources:
                path = ours.get(target, LIBRARIES / target)
                if not path.is_file():
                    raise SystemExit(f"{name} imports {target}: neither in contracts/src nor in contracts/node_modules")
                sources[target] = path.read_text("utf-8")
                waiting.append(target)
    return dict(sorted(sources.items()))


def _join(name: str, relative: str) -> str:
    parts = name.split("/")[:-1]
    for part in relative.split("/"):
        if part == "..":
            parts.pop()
        elif part != ".":
            parts.append(part)
    return "/".join(parts)


def standard_input(sources: dict[str, str], group: str | None = None) -> dict[str, Any]:
    """The input of the compiler; outputs are asked only for contracts (of a group) that are named as their files."""
    selection = {
        name: {PurePosixPath(name).stem: OUTPUTS}
        for name, text in sources.items()
        if _declares(name, text) and (group is None or group_of(name) == group)
    }
    return {
        "language": "Solidity",
        "sources": {name: {"content": content} for name, content in sources.items()},
        "settings": SETTINGS | {"outputSelection": selection},
    }


def _declares(name: str, text: str) -> bool:
    """Whether a file of ours declares a contract of its own name."""
    return (SOURCES / name).is_file() and bool(
        re.search(rf"^contract {PurePosixPath(name).stem}\b", text, re.MULTILINE)
    )


def run_compiler(request: str) -> dict[str, Any]:
    """The compiler's answer. Files, not pipes, on both sides: the compiler cuts off what it writes to a pipe."""
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


def build(folder: Path = SOURCES, groups: Sequence[str] = (CORE, *GROUPS)) -> dict[str, str]:
    """The text of every artifact file of these groups, by name."""
    files: dict[str, str] = {}
    for group in groups:
        built = build_group(folder, group)
        if doubled := files.keys() & built.keys():
            raise SystemExit(f"two contracts are called {min(doubled).removesuffix('.json')}")
        files |= built
    return files


def build_group(folder: Path, group: str) -> dict[str, str]:
    """The text of every artifact file of a group, by name."""
    sources = read_sources(folder, group)
    request = standard_input(sources, group)
    if not request["settings"]["outputSelection"]:
        return {}
    files = {input_name(group): _text(without_libraries(request))}
    for name, text in files.items():
        if len(text) > MAX_STANDARD_INPUT_SIZE:
            raise SystemExit(f"{name} has {len(text):,} bytes, more than {MAX_STANDARD_INPUT_SIZE:,}")
    answer = run_compiler(_text(_with_source_maps(request) if group == CORE else request))
    if group == CORE:
        files[SOURCE_MAPS] = source_maps(answer)
        if len(files[SOURCE_MAPS]) > MAX_SOURCE_MAPS_SIZE:
            raise SystemExit(f"{SOURCE_MAPS} has {len(files[SOURCE_MAPS]):,} bytes, more than {MAX_SOURCE_MAPS_SIZE:,}")
    for source, contracts in answer["contracts"].items():
        for name, output in contracts.items():
            if not output["evm"]["bytecode"]["object"]:
                continue  # an interface
            metadata = json.loads(output["metadata"])
            used = sorted(metadata["sources"])
            files[f"{name}.json"] = _text(
                {
                    "contract": name,
                    "group": group,
                    "source": source,
                    "compiler": metadata["compiler"]["version"],
                    "settings": SETTINGS,
                    "sources": {path: hashlib.sha256(sources[path].encode()).hexdigest() for path in used},
                    "methodIdentifiers": output["evm"]["methodIdentifiers"],
                    "abi": output["abi"],
                    "bytecode": output["evm"]["bytecode"]["object"],
                    "deployedBytecode": output["evm"]["deployedBytecode"]["object"],
                }
            )
    return files


def input_name(group: str) -> str:
    """The file of the compiler's input of a group."""
    return f"{STANDARD_INPUT}.json" if group == CORE else f"{STANDARD_INPUT}-{group}.json"


def without_libraries(request: dict[str, Any]) -> dict[str, Any]:
    """The request with the code of others named by place and hash: it is not ours to keep here."""
    sources = {
        name: source
        if (SOURCES / name).is_file()
        else {
            "keccak256": "0x" + keccak.new(digest_bits=256, data=source["content"].encode()).hexdigest(),
            "urls": [f"node_modules/{name}"],
        }
        for name, source in request["sources"].items()
    }
    return request | {"sources": sources}


def _with_source_maps(request: dict[str, Any]) -> dict[str, Any]:
    """The request that asks for source maps and syntax trees too, which verifiers of sources do not want."""
    more = ["evm.deployedBytecode.sourceMap", "evm.deployedBytecode.functionDebugData"]
    selection = {
        source: {contract: [*wanted, *more] for contract, wanted in contracts.items()}
        for source, contracts in request["settings"]["outputSelection"].items()
    }
    return request | {"settings": request["settings"] | {"outputSelection": selection | {"*": {"": ["ast"]}}}}


def source_maps(answer: dict[str, Any]) -> str:
    """Of each contract the compiler's source map and where its functions begin; of each source the functions in it.

    As `shackled.gas.source_map` reads it. Places in sources are in bytes of UTF-8.
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
        source["id"]: {"name": name, "functions": _functions(source["ast"], Path(name).stem)}
        for name, source in answer["sources"].items()
        if source["id"] in used
    }
    return json.dumps({"contracts": maps, "sources": sources}, sort_keys=True, separators=(",", ":")) + "\n"


def _functions(node: Any, owner: str) -> list[list[Any]]:
    """The functions in a syntax tree: name with that of the contract or file, begin, and length."""
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
    """The names of the artifact files on disk that belong to these groups."""
    names = {input_name(group) for group in groups} | ({SOURCE_MAPS} if CORE in groups else set())
    found = {path.name: path for path in ARTIFACTS.glob("*.json")}
    for name, path in found.items():
        if name.startswith((SOURCE_MAPS, STANDARD_INPUT)):
            continue
        if json.loads(path.read_text("utf-8"))["group"] in groups:
            names.add(name)
    return names & found.keys()


def differences(files: dict[str, str], groups: Sequence[str]) -> list[str]:
    """What of the artifacts on disk is not as it should be, one line each."""
    found = artifacts_of(groups)
    lines = [f"{name} is there, but nothing builds it" for name in sorted(found - files.keys())]
    for name, text in files.items():
        if name not in found:
            lines.append(f"{name} is missing")
        elif (actual := (ARTIFACTS / name).read_bytes()) != text.encode():
            try:
                old, new = json.loads(actual), json.loads(text)
                keys = [key for key in sorted(old.keys() | new.keys()) if old.get(key) != new.get(key)]
            except ValueError:
                keys = []
            lines.append(f"{name} differs: {', '.join(keys) or 'not as this tool writes it'}")
    return lines


def report_sizes(files: dict[str, str]) -> bool:
    """Prints the size of every contract; whether all are within the limit."""
    fits = True
    for name, text in files.items():
        if name != SOURCE_MAPS and not name.startswith(STANDARD_INPUT):
            size = len(json.loads(text)["deployedBytecode"]) // 2
            fits &= size <= MAX_RUNTIME_SIZE
            remark = "" if size <= MAX_RUNTIME_SIZE else ", TOO LARGE"
            print(f"{name.removesuffix('.json')}: {size:,} of {MAX_RUNTIME_SIZE:,} bytes{remark}")
    return fits


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description="Compile the contracts into src/shackled/artifacts.")
    parser.add_argument("--check", action="store_true", help="write nothing; fail if the artifacts are not up to date")
    parser.add_argument("--group", choices=(CORE, *GROUPS), help="only the contracts of this group")
    parser.add_argument("--input", choices=(CORE, *GROUPS), help="print the compiler's input of a group, and stop")
    options = parser.parse_args()
    if options.input:
        print(_text(standard_input(read_sources(SOURCES, options.input), options.input)), end="")
        return 0
    groups = (options.group,) if options.group else (CORE, *GROUPS)
    files = build(groups=groups)
    if options.check:
        fits = report_sizes(files)
        lines = differences(files, groups)
        for line in lines:
            print(line, file=sys.stderr)
        if lines:
            print("the artifacts are not those of the sources: run tools/build_contracts.py", file=sys.stderr)
        return 0 if fits and not lines else 1
    for name in artifacts_of(groups) - files.keys():
        (ARTIFACTS / name).unlink()
    for name, text in files.items():
        (ARTIFACTS / name).write_text(text, "utf-8", newline="\n")
    # last: a closed pipe ends the command where it prints
    return 0 if report_sizes(files) else 1


if __name__ == "__main__":
    sys.exit(main())
