"""Write the reference of the contracts into docs/contracts.md: a hook of mkdocs.

The compiled interfaces say which functions, events and errors there are, and the NatSpec comments of contracts/src what
they mean. The page has a line <!-- functions NAME --> for each contract, <!-- structs PATH --> for the structs of a
file, and <!-- errors --> for the errors of all of its contracts.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

from mkdocs.structure.pages import Page

from shackled.artifacts import artifact
from tools.pages import ROOT

SOURCES = ROOT / "contracts" / "src"
#: NatSpec comments with the declarations below them: kind, name and parameters; or, of a public variable, its name.
NATSPEC = r"((?:^ *///.*\n)+)"
DECLARATION = re.compile(
    rf"{NATSPEC}^ *(?:(function|event|error) (\w+)\s*\(([^)]*)\)|[^/\n]* public (?:\w+ )*(\w+)(?: =|;))", re.MULTILINE
)
MARK = re.compile(r"^<!-- (functions|structs|errors) ?(\S*) -->$", re.MULTILINE)
#: What a function is called for, by its state mutability.
KINDS = {"view": "call", "pure": "call", "nonpayable": "transaction", "payable": "transaction, with ether"}

#: What is said about a declaration, by its kind, its name and the number of its parameters.
Comments = dict[tuple[str, str, int], str]


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """Fill in the tables of the page."""
    return filled(markdown) if page.file.src_uri == "contracts.md" else markdown


def filled(text: str) -> str:
    """Return the text of the page with its tables."""
    names = [name for kind, name in MARK.findall(text) if kind == "functions"]

    def table(match: re.Match[str]) -> str:
        if match[1] == "functions":
            return functions(match[2])
        return structs(match[2]) if match[1] == "structs" else errors(names)

    return MARK.sub(table, text)


def functions(contract: str) -> str:
    """Return the table of the functions of a contract, and that of its events."""
    entries = sorted(artifact(contract).abi, key=lambda entry: (entry.get("name", ""), len(entry.get("inputs", []))))
    calls, events, others = [], [], []
    for entry in (each for each in entries if each["type"] in {"function", "event"}):
        said = comment(contract, entry)
        if not said:
            others.append(signature(entry))
        elif entry["type"] == "event":
            events.append(f"| {signature(entry)} | {said} |")
        else:
            results = parameters(entry["outputs"])
            shown = signature(entry) + (f" → `{results}`" if results else "")
            calls.append(f"| {shown} | {KINDS[entry['stateMutability']]} | {said} |")
    lines = ["| function | for a | |", "|---|---|---|", *calls]
    if events:
        lines += ["", "| event | |", "|---|---|", *events]
    return "\n".join(lines + inherited(others))


def errors(contracts: Iterable[str]) -> str:
    """Return the table of the errors of contracts."""
    found: dict[str, tuple[str, list[str]]] = {}
    for name in contracts:
        for each in (each for each in artifact(name).abi if each["type"] == "error"):
            found.setdefault(signature(each), (comment(name, each), []))[1].append(name)
    rows = [f"| {shown} | {said} | {', '.join(names)} |" for shown, (said, names) in sorted(found.items()) if said]
    others = [shown for shown, (said, _) in sorted(found.items()) if not said]
    return "\n".join(["| error | | of |", "|---|---|---|", *rows, *inherited(others)])


def inherited(names: list[str]) -> list[str]:
    """Return lines with what has no remark in these sources, most of which the standards define."""
    return (
        ["", f"Without a remark, or of the standards and libraries that are used: {', '.join(names)}."] if names else []
    )


def signature(entry: dict[str, Any]) -> str:
    """Return the name and the parameters of an entry of an ABI."""
    return f"`{entry['name']}({parameters(entry['inputs'])})`"


def structs(path: str) -> str:
    """Return the structs of a file, with the comments on their fields."""
    text = (SOURCES / path).read_text("utf-8")
    found = re.findall(r"((?:^///.*\n)*^struct \w+ \{.*?^\})", text, re.DOTALL | re.MULTILINE)
    return "```solidity\n" + "\n\n".join(found) + "\n```"


def parameters(entries: list[dict[str, Any]]) -> str:
    """Return parameters as in Solidity, such as "Scene scene, uint256 scale"."""
    types = (re.sub(r"^(struct|contract|enum) ", "", each["internalType"]) for each in entries)
    return ", ".join(f"{kind} {each['name']}".strip() for kind, each in zip(types, entries, strict=True))


def comment(contract: str, entry: dict[str, Any]) -> str:
    """Return what the sources of a contract say about an entry of its ABI; "" if they say nothing."""
    key = (entry["type"], entry["name"], len(entry["inputs"]))
    return next((found[key] for found in map(comments, sources(contract)) if key in found), "").replace("|", r"\|")


@cache
def sources(contract: str) -> list[Path]:
    """Return the sources of a contract, those of libraries left out: its interface, itself, interfaces, others."""
    names = [f"I{contract}", contract, f"I{contract}Core"]
    built = json.loads((ROOT / "src" / "shackled" / "artifacts" / f"{contract}.json").read_text("utf-8"))
    files = [SOURCES / path for path in built["sources"]]

    def rank(path: Path) -> tuple[int, bool]:
        return names.index(path.stem) if path.stem in names else len(names), path.parent.name != "interfaces"

    return sorted((path for path in files if path.is_file()), key=rank)


@cache
def comments(path: Path) -> Comments:
    """Return the comments of a file."""
    found: Comments = {}
    for natspec, kind, name, inputs, variable in DECLARATION.findall(path.read_text("utf-8")):
        count = inputs.count(",") + 1 if inputs.strip() else 0
        found[kind or "function", name or variable, count] = prose(natspec)
    return {key: text for key, text in found.items() if text}


def prose(natspec: str) -> str:
    """Return the text of a NatSpec comment for readers, in one line; what is for developers only is left out."""
    text = " ".join(re.sub(r"^ *///", "", natspec, flags=re.MULTILINE).split())
    words: list[str] = []
    for tag, body in re.findall(r"@(\w+) (.*?)(?= @\w+ |$)", text):
        name, _, meaning = body.partition(" ")
        if tag == "notice":
            words.insert(0, body)
        elif tag == "param" or (tag == "return" and name[0].islower()):
            words.append(f"`{name}`: {meaning}")
        elif tag == "return":
            words.append(f"Returns: {body}")
    return " ".join(words)
