"""Make of contracts/layout.toml, the table of registers and packed words, the files of contracts/src/words but
Memory.sol, chain/_layout.py, scene/_records.py, and scene/records.ts of web/.

The compiler takes no expressions in assembly, so every address, shift and mask has to be a number of its own. Here they
are computed, so that one line of the table adds a register, and the contracts and the package cannot differ.
"""

from __future__ import annotations

import json
import re
import textwrap
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain, count, pairwise
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
TABLE = ROOT / "contracts" / "layout.toml"
FOLDER = ROOT / "contracts" / "src" / "words"
PACKAGE = ROOT / "src" / "shackled" / "chain" / "_layout.py"
#: The kinds of the records of Scene.extensions.
KINDS = ROOT / "src" / "shackled" / "scene" / "_records.py"
WEB_KINDS = ROOT / "web" / "src" / "scene" / "records.ts"
WORD = 32
#: Columns of a line of the contracts.
SOLIDITY_WIDTH = 140

HEAD = """// SPDX-License-Identifier: MIT
pragma solidity {version};

{imports}// Written by tools/layout.py from layout.toml.
"""
#: What records of Scene.extensions belong to: two bits of RECORD_OWNERS.
OWNERS = ("scene", "light", "object")
#: In RECORD_SIZES, for any number of words.
ANY_WORDS = 255


@dataclass(frozen=True)
class Constant:
    """A named number; `text` explains it, and is empty where the line before does."""

    name: str
    value: int
    text: str = ""


@dataclass(frozen=True)
class Section:
    """Constants that belong together.

    drawing: fields of a word, as `drawing` draws them. after: the title of the section that it follows.
    """

    title: str
    text: str
    constants: tuple[Constant, ...]
    drawing: str = ""
    after: str = ""


def section_of(part: dict[str, Any], constants: Iterable[Constant], drawing: str = "") -> Section:
    """Return a section with the title and the text of a part of the table."""
    return Section(part["title"], part.get("text", ""), tuple(constants), drawing, part.get("after", ""))


def drawing(part: dict[str, Any], fields: Iterable[tuple[str, int, int]] = ()) -> str:
    """Draw the bits of a word, highest first: of `fields`, (name, lowest bit, width), and of those that the part lists
    as `drawn`.
    """
    each = sorted([*fields, *part.get("drawn", [])], key=lambda row: row[1], reverse=True)
    cells = [f"{at} {name}" if width == 1 else f"{at}..{at + width - 1} {name}" for name, at, width in each]
    caption = f"{part['caption']}: " if "caption" in part else ""
    return f"{caption}| {' | '.join(cells)}" if cells else ""


def lanes_of(part: dict[str, Any]) -> Iterator[tuple[str, int, int]]:
    """Yield the lanes of a word, if they have names, each as wide as the distance to the next."""
    for name, (at, end) in zip(part.get("names", ()), pairwise([*part["at"], part.get("end", 256)]), strict=False):
        yield name, at, end - at


def together(sections: Iterable[Section]) -> Iterator[Section]:
    """Yield sections, each followed by those of parts of the same word."""
    found = list(sections)
    for each in found:
        if not each.after:
            yield each
            yield from (other for other in found if other.after == each.title)


def named(names: str, text: str, values: Iterator[int]) -> Iterator[Constant]:
    """Yield the constants of one row of the table; the first carries the text."""
    for i, name in enumerate(names.split()):
        yield Constant(name, next(values), "" if i else text)


def registers(table: dict[str, Any]) -> dict[str, list[Section]]:
    """Return the sections of registers by file, one word after the other, through all files."""
    address: int = table["registers_begin"]
    first = Constant("REGISTERS", address, table["registers_text"])
    files: dict[str, list[Section]] = {}
    ends: dict[str, int] = {}
    for part in table["registers"]:
        constants: list[Constant] = []
        for names, words, text in rows_of_registers(part):
            size = WORD * words
            found = tuple(named(names, text, count(address, size)))
            address += size * len(found)
            constants += found
        if name := part.get("block"):
            begin = constants[0].value
            constants.insert(
                0, Constant(f"{name}_BEGIN", begin, "The beginning of these registers, and their size in bytes.")
            )
            constants.insert(1, Constant(f"{name}_SIZE", address - begin))
        sections = files.setdefault(part.get("file", "Registers"), [])
        sections.append(Section(part["title"], part.get("text", ""), tuple(constants)))
        ends[part.get("file", "Registers")] = address
    for name, sections in files.items():
        end = Constant(f"{re.sub('(?<=[a-z])(?=[A-Z])', '_', name).upper()}_END", ends[name])
        sections.insert(0, Section("bounds", "", (first, end) if name == "Registers" else (end,)))
    return files


def rows_of_registers(part: dict[str, Any]) -> Iterator[tuple[str, int, str]]:
    """Yield names, words of each, and text of each row."""
    for row in part["rows"]:
        names, *size, text = row
        yield names, size[0] if size else 1, text


def records(table: dict[str, Any]) -> Iterator[Section]:
    """Yield records of several words: offsets of the fields, and the size; or fields in the middle of other records."""
    sections = chain.from_iterable(registers(table).values())
    addresses = {constant.name: constant.value for section in sections for constant in section.constants}
    for part in table["records"]:
        constants: list[Constant] = []
        offset = 0
        if "behind" in part:
            from_, to = part["behind"]
            offset = addresses[to] - addresses[from_]
        for names, words, text in rows_of_registers(part):
            for i, name in enumerate(names.split()):
                constants.append(Constant(f"{part['name']}_{name}", offset, "" if i else text))
                offset += WORD * words
        if "behind" not in part:
            constants.append(Constant(f"{part['name']}_SIZE", offset))
        yield section_of(part, constants)


def bits(table: dict[str, Any]) -> Iterator[Section]:
    """Yield flags of a word, a bit each."""
    for part in table["flags"]:
        values = (1 << i for i in range(256))
        constants = [constant for names, text in part["rows"] for constant in named(names, text, values)]
        yield section_of(part, constants)


def words(table: dict[str, Any]) -> Iterator[Section]:
    """Yield packed words: of each field its lowest bit and the mask of its value, where they are needed; of a flag,
    under its own name, the bit.
    """
    for part in table["words"]:
        constants = []
        fields = []
        top = max(at for _, at, *_ in part["rows"] + part.get("drawn", []))
        for name, at, width, text in part["rows"]:
            fields.append((name if width == 1 else name.lower().replace("_", " "), at, width))
            full = f"{part['name']}_{name}"
            if width == 1:
                constants.append(Constant(name, 1 << at, text))
            else:
                # the lowest field needs no shift, the highest no mask
                found = [Constant(f"{full}_AT", at, text)] if at else []
                if at < top:
                    found.append(Constant(f"{full}_MASK", (1 << width) - 1, "" if at else text))
                constants += found
        yield section_of(part, constants, drawing(part, fields))


def flags(table: dict[str, Any]) -> dict[str, int]:
    """Return all flags by name."""
    return {
        constant.name: constant.value for section in [*bits(table), *words(table)] for constant in section.constants
    }


def unions(table: dict[str, Any]) -> Iterator[Section]:
    """Yield sums of several flags."""
    known = flags(table)
    for part in table["unions"]:
        constants = [
            Constant(name, sum(known[flag] for flag in each.split()), text) for name, each, text in part["rows"]
        ]
        yield section_of(part, constants)


def shifts(table: dict[str, Any]) -> Iterator[Section]:
    """Yield by how many bits one flag is above another."""
    known = flags(table)
    for part in table["shifts"]:
        constants = [
            Constant(name, known[flag].bit_length() - known[lower].bit_length(), text)
            for name, flag, lower, text in part["rows"]
        ]
        yield section_of(part, constants)


def lanes(table: dict[str, Any]) -> Iterator[Section]:
    """Yield numbers side by side in a word: the same in each lane, or a list of them."""
    for part in table["lanes"]:
        constants = []
        for name, value, text in part["rows"]:
            each = value if isinstance(value, list) else [value] * len(part["at"])
            word = sum(number << at for number, at in zip(each, part["at"], strict=True))
            constants.append(Constant(name, word & ((1 << 256) - 1), text))
        yield section_of(part, constants, drawing(part, lanes_of(part)))


def numbers(table: dict[str, Any]) -> Iterator[Section]:
    """Yield single numbers."""
    for part in table["numbers"]:
        yield section_of(part, (Constant(name, value, text) for name, value, text in part["rows"]), drawing(part))


def kinds(table: dict[str, Any]) -> Section:
    """Return the kinds of the records of Scene.extensions, what each belongs to, and its size."""
    part = table["extensions"]
    owners = sum((1 + OWNERS.index(owner)) << 2 * kind for _, kind, owner, _, _ in part["kinds"])
    sizes = sum((ANY_WORDS if size == "words" else size) << 8 * kind for _, kind, _, size, _ in part["kinds"])
    constants = [Constant(name, kind, text) for name, kind, _, _, text in part["kinds"]]
    constants += [Constant(*row) for row in part["numbers"]]
    constants += [
        Constant("LONG_KINDS", part["long_kinds"], "The first kind whose size is given in words, not in bytes."),
        Constant("RECORD_HEADER", part["header"], "Bytes of a record before its content."),
        Constant("RECORD_OWNERS", owners, "What a kind belongs to: two bits at twice its number, 0 if it is unknown."),
        *(Constant(f"OF_{owner.upper()}", 1 + number) for number, owner in enumerate(OWNERS)),
        Constant("RECORD_SIZES", sizes, "Bytes of the content: a byte at 8 times its number; ANY_WORDS for any words."),
        Constant("ANY_WORDS", ANY_WORDS),
    ]
    return Section("records of Scene.extensions", "", tuple(constants))


def kinds_of_packages(table: dict[str, Any]) -> tuple[str, str]:
    """Return the texts of the modules of the same, for Python and for TypeScript."""
    part = table["extensions"]
    title = "The kinds of the records of Scene.extensions. Written by tools/layout.py from contracts/layout.toml."
    kind_lines = [f"{name} = {kind}" for name, kind, *_ in part["kinds"]]
    number_lines = [f"{name} = {value}" for name, value, _ in part["numbers"]]
    tone = [name for name, *_ in part["numbers"] if name.startswith("TONE_")]
    pairs = [(json.dumps(name.removeprefix("TONE_").lower()), name) for name in tone]
    single = [
        (
            "The first kind whose size is given in words of 32 bytes, not in bytes.",
            f"LONG_KINDS = {part['long_kinds']}",
        ),
        ("Bytes of a record before its content.", f"RECORD_HEADER = {part['header']}"),
    ]
    python = [f'"""{title}"""', "", *kind_lines, "", *number_lines, ""]
    python += [line for text, constant in single for line in (f"#: {text}", constant)]
    flags = ", ".join(f"{field}: {name}" for field, name in pairs)
    python += ["#: The flags of a tone, by its fields.", f"TONE_FLAGS = {{{flags}}}"]
    python += ["#: Bytes of its content; None for any number of words.", "SIZES: dict[int, int | None] = {"]
    python += [f"    {name}: {None if size == 'words' else size}," for name, _, _, size, _ in part["kinds"]]
    web = [f"// {title}", "", *(f"export const {line};" for line in kind_lines), ""]
    web += [*(f"export const {line};" for line in number_lines), ""]
    web += [line for text, constant in single for line in (f"/** {text} */", f"export const {constant};")]
    web += ["/** The fields and the flags of a tone. */", "export const TONE_FLAGS = ["]
    web += [*(f"    [{field}, {name}]," for field, name in pairs), "] as const;"]
    web += ["/** Bytes of the content, for kinds of one size. */", "export const SIZES = {"]
    web += [f"    [{name}]: {size}," for name, _, _, size, _ in part["kinds"] if size != "words"]
    return "\n".join([*python, "}", ""]), "\n".join([*web, "} as const;", ""])


def solidity_literal(value: int) -> str:
    """Return a number in hexadecimal; with 39 to 41 digits it would be an address, so there it begins with zeros."""
    if value < 256:
        return str(value)
    digits = f"{value:x}"
    return f"0x{digits.zfill(42) if 39 <= len(digits) <= 41 else digits}"


def solidity(sections: Iterator[Section], *imports: str, version: str = "0.8.37") -> str:
    """Return the text of a file of constants."""
    lines = [
        HEAD.format(
            version=version, imports="".join(f'import "./{name}";\n' for name in imports) + "\n" * bool(imports)
        )
    ]
    for section in sections:
        lines.append(f"// {'-' * (SOLIDITY_WIDTH - 5 - len(section.title))} {section.title}")
        lines += wrapped(section.text, "// ", SOLIDITY_WIDTH)
        # breaks between fields only
        drawn = wrapped(section.drawing.replace(" ", "\0").replace("\0|", " |"), "// ", SOLIDITY_WIDTH)
        lines += [line.replace("\0", " ") for line in drawn]
        lines.append("")
        for constant in section.constants:
            lines += wrapped(constant.text, "/// @dev " if constant.text else "", SOLIDITY_WIDTH, "/// ")
            lines.append(f"uint256 constant {constant.name} = {solidity_literal(constant.value)};")
        lines.append("")
    return "\n".join(lines).rstrip() + "\n"


def python(sections: Iterator[Section], used: set[str]) -> str:
    """Return the text of a Python module with those constants that `used` names; the comments are in the table."""
    lines = ['"""Registers, packed words and modes. Written by tools/layout.py from contracts/layout.toml."""']
    for section in sections:
        constants = [constant for constant in section.constants if constant.name in used]
        if constants:
            lines += ["", f"# {section.title}"]
        for constant in constants:
            text = str(constant.value) if constant.value < 256 else f"0x{constant.value:X}"
            lines.append(f"{constant.name} = {text}")
    return "\n".join(lines) + "\n"


def used_names() -> set[str]:
    """Return the names that chain/_engines.py uses of chain/_layout.py, as `layout.NAME`."""
    return set(re.findall(r"\blayout\.([A-Z]\w+)", PACKAGE.with_name("_engines.py").read_text("utf-8")))


def bands() -> Section:
    """Return the number of pixels of a band, which the contracts have where they use it."""
    text = (FOLDER.parent / "pipeline" / "Pipeline.sol").read_text("utf-8")
    (pixels,) = re.findall(r"^uint256 constant BAND_PIXELS = (\d+);", text, re.MULTILINE)
    return Section("of pipeline/Pipeline.sol", "", (Constant("BAND_PIXELS", int(pixels)),))


def wrapped(text: str, first: str, width: int, rest: str | None = None) -> list[str]:
    """Wrap a text to comment lines."""
    indent = first if rest is None else rest
    return textwrap.wrap(text, width, initial_indent=first, subsequent_indent=indent) if text else []


def files() -> dict[Path, str]:
    """Return the text of every file that is made of the table."""
    table = tomllib.loads(TABLE.read_text("utf-8"))
    packed = [*together([*numbers(table), *words(table), *unions(table), *shifts(table), *lanes(table)])]
    found = registers(table)
    common = [*found.pop("Registers"), *records(table), *bits(table)]
    for_python, for_web = kinds_of_packages(table)
    made = {
        FOLDER / "Registers.sol": solidity(iter(common), "Memory.sol", "Words.sol"),
        FOLDER / "Words.sol": solidity(iter(packed)),
        # contracts of others import this file
        FOLDER / "Records.sol": solidity(iter([kinds(table)]), version="^0.8.25"),
        KINDS: for_python,
        WEB_KINDS: for_web,
        PACKAGE: python(iter([*common, *packed, bands()]), used_names() | {"BAND_PIXELS"}),
    }
    # each of the others is for fewer engines than the one before
    before = "Registers.sol"
    for name, sections in found.items():
        made[FOLDER / f"{name}.sol"] = solidity(iter(sections), before)
        before = f"{name}.sol"
    return made
