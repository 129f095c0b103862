"""Write the files that are made of contracts/scene_fields.toml, the table of what scenes are made of.

python -m tools.scene_fields            writes scene/_fields.py and scene/_constants.py of the package; types.ts,
                                        fields.ts and constants.ts of web/src/scene; tables of docs/scene-files.md
python -m tools.scene_fields --check    writes nothing; fails if a file is not as it would be written
"""

from __future__ import annotations

import json
import re
import sys
import textwrap
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from tools.pages import DOCS, ROOT, filled

TABLE = ROOT / "contracts" / "scene_fields.toml"
PACKAGE = ROOT / "src" / "shackled" / "scene"
WEB = ROOT / "web" / "src" / "scene"
PAGE = DOCS / "scene-files.md"
#: Columns of a line of TypeScript.
WIDTH = 120

PYTHON_HEAD = '''"""The fields of scenes. Written by tools/scene_fields.py from contracts/scene_fields.toml."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple


class Field(NamedTuple):
    """A field of a class.

    kind: as in the table; "" for one that is checked by hand. called: how messages call it. limits: the least and the
    greatest number, or the words of a choice. only: "file" for a key of scene files that is no field, "class" for a
    field that is no key. lights: the kinds of lights that have it; of all if empty.
    """

    kind: str
    called: str
    limits: tuple[Any, ...] = ()
    default: Any = None
    is_needed: bool = False
    only: str = ""
    lights: tuple[str, ...] = ()


'''
TYPES_HEAD = """// What a scene is made of, in the units and ranges of scene files: docs/scene-files.md.
// Written by tools/scene_fields.py from contracts/scene_fields.toml.

/** Rows of three numbers, as arrays or one after the other. */
export type Rows = ArrayLike<number> | readonly ArrayLike<number>[];

/** x, y, z. */
export type Vector3 = readonly [number, number, number];

/**
 * Red, green and blue in whole numbers 0..255, or in fractions 0..1 of which one at least is not whole; "#rgb",
 * "#rrggbb", or the CSS name of a colour. `Mesh.colors` also takes an alpha, "#rgba" or "#rrggbbaa".
 */
export type Color = readonly [number, number, number] | string;

/** Three angles in degrees about the axes x, then y, then z; or a quaternion x, y, z, w of any length but zero. */
export type Rotation = Vector3 | readonly [number, number, number, number];

/** A part of the canvas, in pixels from the top left corner. */
export interface Rectangle {
    x: number;
    y: number;
    width: number;
    height: number;
}
"""
FIELDS_HEAD = """// The fields of scenes. Written by tools/scene_fields.py from contracts/scene_fields.toml.

import type { Vector } from "./arithmetic.js";
import type { Rgb } from "./checks.js";
import type { Projection, Shading } from "./types.js";

/** A field of a class; one without a kind is checked by hand. */
export interface Field {
    readonly kind?: "number" | "whole" | "flag" | "color" | "vector" | "pair" | "choice";
    readonly low?: number;
    readonly high?: number;
    readonly choices?: readonly string[];
    readonly needed?: boolean;
    readonly usual?: unknown;
    /** Of a key of scene files that is no field, or of a field that is no key. */
    readonly only?: "file" | "class";
}
"""
CONSTANTS_TITLE = "Numbers of scenes. Written by tools/scene_fields.py from contracts/scene_fields.toml."
#: The types of the values of kinds in TypeScript: as they are given, and checked.
TYPES = {
    "number": ("number", "number"),
    "whole": ("number", "number"),
    "flag": ("boolean", "boolean"),
    "color": ("Color", "Rgb"),
    "vector": ("Vector3", "Vector"),
    "pair": ("readonly [number, number]", "readonly [number, number]"),
}
#: The choices whose types are public.
NAMED = ("Shading", "Projection")

Row = dict[str, Any]
Table = dict[str, Any]


def camel(name: str) -> str:
    """Return a name as TypeScript has it."""
    return re.sub("_([a-z])", lambda match: match[1].upper(), name)


def plural(name: str) -> str:
    """Return the name of the constant of all words of a choice, such as LIGHT_KINDS of LightKind."""
    return f"{re.sub('(?<=[a-z])(?=[A-Z])', '_', name).upper()}S".replace("XISS", "XES").replace("XIS", "XE")


def classes(table: Table) -> dict[str, Table]:
    """Return the classes by their names."""
    return {name: part for name, part in table.items() if "fields" in part}


def web_classes(table: Table) -> Iterator[tuple[str, str, dict[str, Row]]]:
    """Yield name, text and fields of each class of TypeScript, which has one for each kind of lights."""
    for name, part in classes(table).items():
        for kind, text in part.get("kinds", {"": part.get("text")}).items():
            rows = {key: row for key, row in part["fields"].items() if kind in row.get("lights", [kind])}
            if kind:
                rows["kind"] = {"kind": "choice", "of": "", "words": [kind], "needed": True, "text": ""}
            yield kind.capitalize() + part.get("ts", name), text, rows


# ---- Python ----


def python(table: Table) -> str:
    """Return the module of the package."""
    lines = []
    for name, words in table["choices"].items():
        listed = ", ".join(map(json.dumps, words))
        lines += [f"{name} = Literal[{listed}]", f"{plural(name)}: tuple[{name}, ...] = ({listed})"]
    lines += ["", "FIELDS: dict[str, dict[str, Field]] = {"]
    for name, part in classes(table).items():
        lines.append(f'    "{name}": {{')
        for key, row in part["fields"].items():
            lines.append(f'        "{key}": {python_field(part, key, row)},')
        lines.append("    },")
    return PYTHON_HEAD + "\n".join([*lines, "}", ""])


def python_field(part: Table, key: str, row: Row) -> str:
    """Return the constructor of a field."""
    word = "colour" if key == "color" else key
    pattern = part.get("called", "the {}")
    called = row.get("called", pattern.removeprefix("the ") if row.get("kind") == "flag" else pattern)
    limits = row.get("range", [])
    value = default_of(row) or ""
    if isinstance(row.get("default"), bool | list):
        value = python_value(row["default"])
    shown = f"({plural(row['of'])},)" if row.get("kind") == "choice" else python_value(limits) if limits else ""
    given = {
        "default": value,
        "is_needed": "True" if row.get("needed") else "",
        "only": json.dumps(row["only"]) if "only" in row else "",
        "lights": python_value(row["lights"]) if "lights" in row else "",
    }
    more = [f", {shown}"] * bool(shown) + [f", {name}={value}" for name, value in given.items() if value]
    return f'Field("{row.get("kind", "")}", {json.dumps(called.format(word))}{"".join(more)})'


def python_value(value: Any) -> str:
    """Return a value of the table in Python."""
    if isinstance(value, list):
        return f"({', '.join(map(python_value, value))}{',' * (len(value) == 1)})"
    return json.dumps(value) if isinstance(value, str) else repr(value)


def python_constants(table: Table) -> str:
    """Return the module of the numbers."""
    lines = [f'"""{CONSTANTS_TITLE}"""']
    for part in table["numbers"]:
        lines += ["", f"# {part['title']}"]
        for name, value, text in part["rows"]:
            lines += textwrap.wrap(text, WIDTH, initial_indent="#: ", subsequent_indent="#: ")
            lines.append(f"{name} = {expression(value, '2.0**', '({})')}")
    return "\n".join([*lines, ""])


def expression(value: Any, power: str, several: str) -> str:
    """Return a number of the table, or several: powers of two are texts, such as 2^26."""
    if isinstance(value, list):
        return several.format(", ".join(expression(each, power, several) for each in value))
    return value.replace("2^", power) if isinstance(value, str) else re.sub(r"e\+?(-?)0*", r"e\1", repr(value))


# ---- TypeScript ----


def types(table: Table) -> str:
    """Return the file of the types of scenes."""
    lines = [TYPES_HEAD]
    lines += [f"export type {name} = {union(table['choices'][name])};\n" for name in NAMED]
    for name, text, rows in web_classes(table):
        lines += [*comment(text), f"export interface {name} {{"]
        for key, row in rows.items():
            if row.get("only") != "file":
                given = "" if row.get("needed") else " | undefined"
                mark = ":" if row.get("needed") else "?:"
                lines += comment(remark(row), "    ")
                lines.append(f"    {camel(key)}{mark} {type_of(table, row, 0)}{given};")
        lines.append("}\n")
    kinds = [f"{kind.capitalize()}Light" for kind in table["Light"]["kinds"]]
    lines.append(f"export type Light = {' | '.join(kinds)};")
    return "\n".join([*lines, ""])


def union(words: Iterable[str]) -> str:
    """Return the type of some words."""
    return " | ".join(map(json.dumps, words))


def type_of(table: Table, row: Row, which: int) -> str:
    """Return the type of a field in TypeScript. which: 0 as it is given, 1 checked."""
    if row.get("kind") == "choice":
        return str(row["of"]) if row["of"] in NAMED else union(words_of(table, row))
    return TYPES[row["kind"]][which] if "kind" in row else row["type"]


def words_of(table: Table, row: Row) -> list[str]:
    """Return the words of a choice."""
    found: list[str] = row.get("words") or table["choices"][row["of"]]
    return found


def remark(row: Row) -> str:
    """Return the comment of a field: one sentence or more, with the range and the default."""
    if "comment" in row or not row["text"]:
        return str(row.get("comment", ""))
    text = re.sub(r"\[([^]\[]+)\]\([^)]+\)", r"\1", ranged(row, "{}..{}", "at least {}"))
    first, dot, rest = text.partition(". ")
    usual = default_of(row)
    if usual is None or row.get("kind") == "color":
        usual = row.get("usual", "").replace("`", "")
    # a flag that is off by default, as most are, does not say so
    usual = f"; {usual} by default" if usual not in ("", "false") else ""
    return f"{first[0].upper()}{first[1:]}{usual}{dot}{rest}."


def ranged(row: Row, both: str, least: str) -> str:
    """Return the text of a field with its range at the end of the first clause."""
    limits = row.get("range", [])
    shown = row.get("shown", (both if len(limits) == 2 else least).format(*limits) if limits else "")
    first, mark, rest = re.fullmatch(r"(.*?)(?:([;.]) (.*))?", row["text"]).groups("")  # type: ignore[union-attr]
    return f"{first}{', ' * bool(shown)}{shown}{mark and mark + ' '}{rest}"


def default_of(row: Row) -> str | None:
    """Return the default as JSON, or as the expression that it is; None where there is none."""
    if "default" not in row:
        return None
    is_expression = row.get("kind") == "number" and isinstance(row["default"], str)
    return str(row["default"]) if is_expression else json.dumps(row["default"])


def comment(text: str | None, indent: str = "") -> list[str]:
    """Return a text as a comment of TypeScript."""
    if not text:
        return []
    if "\n" not in text and len(line := f"{indent}/** {text} */") <= WIDTH:
        return [line]
    parts = text.split("\n\n")
    inside = [
        textwrap.wrap(each, WIDTH, initial_indent=f"{indent} * ", subsequent_indent=f"{indent} * ") for each in parts
    ]
    lines = [line for number, each in enumerate(inside) for line in [*([f"{indent} *"] if number else []), *each]]
    return [f"{indent}/**", *lines, f"{indent} */"]


def fields(table: Table) -> str:
    """Return the file of what is checked of scenes."""
    lines = [FIELDS_HEAD]
    for name, words in table["choices"].items():
        lines.append(f"export const {plural(name)} = [{', '.join(map(json.dumps, words))}] as const;")
    lights = ", ".join(f'{kind}: "{kind.capitalize()}Light"' for kind in table["Light"]["kinds"])
    lines += ["/** The classes of the kinds of lights. */", f"export const LIGHTS = {{ {lights} }} as const;"]
    made = list(web_classes(table))
    lines += ["", "/** Of each class, the fields with a kind, checked. */", "export interface Plain {"]
    for name, _, rows in made:
        plain = {key: row for key, row in rows.items() if "kind" in row and row.get("only") != "file"}
        if plain:
            lines.append(f"    {name}: {{")
            for key, row in plain.items():
                absent = "" if row.get("needed") or "default" in row else " | undefined"
                lines.append(f"        {camel(key)}: {type_of(table, row, 1)}{absent};")
            lines.append("    };")
    lines += ["}", "", "/** Of each class, the keys of scene files that are no fields. */", "export interface InFile {"]
    for name, _, rows in made:
        own = [(key, row) for key, row in rows.items() if "kind" in row and row.get("only") == "file"]
        shown = "; ".join(f"{camel(key)}: {type_of(table, row, 1)}" for key, row in own)
        lines += [f"    {name}: {{ {shown} }};"] if own else []
    lines += ["}", "", "// prettier-ignore", "export const FIELDS = {"]
    for name, _, rows in made:
        lines.append(f"    {name}: {{")
        lines += [f"        {camel(key)}: {web_field(row)}," for key, row in rows.items()]
        lines.append("    },")
    lines += ["} as const satisfies Record<string, Record<string, Field>>;", ""]
    return "\n".join(lines)


def web_field(row: Row) -> str:
    """Return a field as an object of TypeScript."""
    limits = row.get("range", [])
    found = {
        "kind": json.dumps(row["kind"]) if "kind" in row else "",
        "low": str(limits[0]) if limits else "",
        "high": str(limits[1]) if len(limits) > 1 else "",
        "choices": "",
        "needed": "true" if row.get("needed") else "",
        "usual": default_of(row) or "",
        "only": json.dumps(row["only"]) if "only" in row else "",
    }
    if row.get("kind") == "choice":
        found["choices"] = plural(row["of"]) if row["of"] else json.dumps(row["words"])
    inside = ", ".join(f"{name}: {value}" for name, value in found.items() if value)
    return f"{{ {inside} }}" if inside else "{}"


def web_constants(table: Table) -> str:
    """Return the file of the numbers."""
    lines = [f"// {CONSTANTS_TITLE}"]
    for part in table["numbers"]:
        lines += ["", f"// {part['title']}", ""]
        for name, value, text in part["rows"]:
            lines += comment(text)
            several = " as const" if isinstance(value, list) else ""
            lines.append(f"export const {name} = {expression(value, '2 ** ', '[{}]')}{several};")
    return "\n".join([*lines, ""])


# ---- documentation ----


def keys(table: Table, name: str) -> str | None:
    """Return the table of the keys of a class, by the name of its marks; a scene has those without marks, too."""
    pages = {part["page"]: part for part in classes(table).values() if "page" in part}
    if name not in pages:
        return None
    # of a class without a table of its own, where a scene has it
    inside = {each.lower(): part["fields"] for each, part in classes(table).items() if "page" not in part}
    lines = ["| key | value | default |", "|---|---|---|"]
    for key, row in pages[name]["fields"].items():
        if row.get("only") != "class":
            lines.append(key_row(key, row))
            own = inside.get(key, {}) if name == "scene" else {}
            lines += [key_row(f"{key}.{each}", more) for each, more in own.items()]
    return "\n".join(lines)


def key_row(key: str, row: Row) -> str:
    """Return the row of a key."""
    value = default_of(row)
    usual = "required for these kinds" if "lights" in row else "required"
    if not row.get("needed"):
        usual = "none" if value is None else f"`{value}`"
    usual = row.get("usual", usual)
    return f"| `{key}` | {ranged(row, '{} to {}', '{} or more')} | {usual} |"


def files() -> dict[Path, str]:
    """Return the text of every file that is made of the table."""
    table = tomllib.loads(TABLE.read_text("utf-8"))
    return {
        PACKAGE / "_fields.py": python(table),
        PACKAGE / "_constants.py": python_constants(table),
        WEB / "types.ts": types(table),
        WEB / "fields.ts": fields(table),
        WEB / "constants.ts": web_constants(table),
        PAGE: filled(PAGE, lambda name: keys(table, name)),
    }


def main() -> int:
    """Write or check the files."""
    made = files()
    if "--check" in sys.argv[1:]:
        stale = [path for path, text in made.items() if not path.exists() or path.read_text("utf-8") != text]
        for path in stale:
            print(f"{path.relative_to(ROOT)} is not made of scene_fields.toml: run tools.scene_fields", file=sys.stderr)
        return 1 if stale else 0
    for path, text in made.items():
        path.write_text(text, "utf-8", newline="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
