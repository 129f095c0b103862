"""Make the files of contracts/scene_fields.toml, the table of what scenes are made of: scene/_fields.py and
scene/_constants.py of the package, types.ts, fields.ts and constants.ts of web/src/scene, and tables of
docs/scene-files.md.
"""

import json
import re
import textwrap
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from tools.pages import DOCS, ROOT, filled

TABLE = ROOT / "contracts" / "scene_fields.toml"
PACKAGE = ROOT / "src" / "shackled" / "scene"
WEB = ROOT / "web" / "src" / "scene"
PAGE = DOCS / "scene-files.md"
#: Columns of a line.
WIDTH = 120
MADE = "Written by tools/scene_fields.py from contracts/scene_fields.toml."

PYTHON_HEAD = f'''"""The fields of scenes. {MADE}"""

# ruff: noqa: E501
# fmt: off

from __future__ import annotations

from typing import Any, Literal, NamedTuple


class Field(NamedTuple):
    """A field of a class.

    kind: as in the table; "" for one that is checked by hand. called: how messages call it. limits: the least and the
    greatest number. default: None where there is none. only: "file" for a key of scene files that is no field, "class"
    for a field that is no key. lights: the kinds of lights that have it; of all if empty.
    """

    called: str
    kind: str = ""
    limits: tuple[Any, ...] = ()
    choices: tuple[str, ...] = ()
    default: Any = None
    needed: bool = False
    only: str = ""
    lights: tuple[str, ...] = ()

'''
TYPES_HEAD = f"""// What a scene is made of, in the units and ranges of scene files: docs/scene-files.md.
// {MADE}

import type {{ Color, Rotation, Rows, Vector3 }} from "./values.js";

export type * from "./values.js";
"""
FIELDS_HEAD = f"""// The fields of scenes. {MADE}

import type {{ Vector }} from "./arithmetic.js";
import type {{ Rgb }} from "./checks.js";
import type {{ Projection, Shading }} from "./types.js";
"""
PAIR = "readonly [number, number]"
#: The types of the values of kinds in TypeScript: as they are given, and checked.
TYPES = {
    "number": ("number", "number"),
    "whole": ("number", "number"),
    "flag": ("boolean", "boolean"),
    "color": ("Color", "Rgb"),
    "vector": ("Vector3", "Vector"),
    "pair": (PAIR, PAIR),
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
    return re.sub("(?<=[a-z])(?=[A-Z])", "_", name.replace("xis", "xe")).upper() + "S"


def rows_of(table: Table) -> dict[str, dict[str, Row]]:
    """Return the fields of each class, with the words of choices."""
    found = {name: part["fields"] for name, part in table.items() if "fields" in part}
    for rows in found.values():
        for row in rows.values():
            if "of" in row:
                row["choices"] = table["choices"][row["of"]]
    return found


def web_rows(table: Table) -> Iterator[tuple[str, str, dict[str, Row]]]:
    """Yield name, text and fields of each class of TypeScript, which has one for each kind of lights."""
    for name, fields in rows_of(table).items():
        for kind, text in table[name].get("kinds", {"": table[name].get("text")}).items():
            rows = {camel(key): row for key, row in fields.items() if kind in row.get("lights", [kind])}
            if kind:
                rows["kind"] = {"kind": "choice", "choices": [kind], "needed": True, "text": ""}
            yield kind.capitalize() + table[name].get("ts", name), text, rows


def described(row: Row, brackets: str, *more: str) -> Iterator[tuple[str, str]]:
    """Yield what code is told of a field, as names and literals; in Python lists are tuples."""
    for name in ("kind", "limits", "choices", "default", *more):
        if name in row:
            yield name, literal(row[name], brackets)


def literal(value: Any, brackets: str) -> str:
    """Return a value in TypeScript or Python: texts such as 2^26 are powers."""
    if isinstance(value, list):
        comma = "," if brackets == "()" and len(value) == 1 else ""
        return f"{brackets[0]}{', '.join(literal(each, brackets) for each in value)}{comma}{brackets[1]}"
    if isinstance(value, str) and value.startswith("2^"):
        return value.replace("2^", "2.0**" if brackets == "()" else "2 ** ")
    if isinstance(value, bool) and brackets == "()":
        return str(value)
    return re.sub(r"^([\d.]+)e\+?(-?)0*", r"\1e\2", json.dumps(value))


# ---- Python ----


def python(table: Table) -> str:
    """Return the module of the package."""
    lines = [PYTHON_HEAD]
    for name, words in table["choices"].items():
        lines.append(f"{name} = Literal[{literal(words, '()')[1:-1]}]")
        lines.append(f"{plural(name)}: tuple[{name}, ...] = {literal(words, '()')}")
    lines += ["", "FIELDS: dict[str, dict[str, Field]] = {"]
    for name, rows in rows_of(table).items():
        lines.append(f'    "{name}": {{')
        for key, row in rows.items():
            called = table[name].get("called", "the {}").format("colour" if key == "color" else key)
            called = row.get("called", called.removeprefix("the ") if row.get("kind") == "flag" else called)
            more = [f", {name}={value}" for name, value in described(row, "()", "needed", "only", "lights")]
            lines.append(f'        "{key}": Field({json.dumps(called)}{"".join(more)}),')
        lines.append("    },")
    return "\n".join([*lines, "}", ""])


def python_comment(text: str) -> list[str]:
    """Return a text as a comment of Python."""
    return textwrap.wrap(text, WIDTH, initial_indent="#: ", subsequent_indent="#: ")


# ---- TypeScript ----


def types(table: Table) -> str:
    """Return the file of the types of scenes."""
    lines = [TYPES_HEAD]
    lines += [f"export type {name} = {' | '.join(map(json.dumps, table['choices'][name]))};\n" for name in NAMED]
    for name, text, rows in web_rows(table):
        lines += [*comment(text), f"export interface {name} {{"]
        for key, row in rows.items():
            if row.get("only") != "file":
                mark, absent = (":", "") if row.get("needed") else ("?:", " | undefined")
                lines += [*comment(remark(row), "    "), f"    {key}{mark} {type_of(row, 0)}{absent};"]
        lines.append("}\n")
    kinds = " | ".join(f"{kind.capitalize()}Light" for kind in table["Light"]["kinds"])
    return "\n".join([*lines, f"export type Light = {kinds};", ""])


def type_of(row: Row, which: int) -> str:
    """Return the type of a field in TypeScript. which: 0 as it is given, 1 checked."""
    if row.get("of") in NAMED:
        return str(row["of"])
    if "choices" in row:
        return " | ".join(map(json.dumps, row["choices"]))
    return TYPES[row["kind"]][which] if "kind" in row else str(row["type"])


def remark(row: Row) -> str:
    """Return the comment of a field: one sentence or more, with the range and the default."""
    if "comment" in row or not row["text"]:
        return str(row.get("comment", ""))
    text = re.sub(r"\[([^]\[]+)\]\([^)]+\)", r"\1", ranged(row, "{}..{}", "at least {}"))
    first, dot, rest = text.partition(". ")
    usual = json.dumps(row["default"]) if "default" in row else ""
    if not usual or row.get("kind") == "color":
        usual = row.get("usual", "").replace("`", "")
    # a flag that is off by default, as most are, does not say so
    usual = f"; {usual} by default" if usual not in ("", "false") else ""
    return f"{first[0].upper()}{first[1:]}{usual}{dot}{rest}."


def ranged(row: Row, both: str, least: str) -> str:
    """Return the text of a field with its range at the end of the first clause."""
    limits = row.get("limits", [])
    shown = row.get("shown", (both if len(limits) == 2 else least).format(*limits) if limits else "")
    first, mark, rest = re.fullmatch(r"(.*?)(?:([;.]) (.*))?", row["text"]).groups("")  # type: ignore[union-attr]
    return f"{first}{', ' * bool(shown)}{shown}{mark and mark + ' '}{rest}"


def comment(text: str | None, indent: str = "") -> list[str]:
    """Return a text as a comment of TypeScript."""
    if not text:
        return []
    if "\n" not in text and len(line := f"{indent}/** {text} */") <= WIDTH:
        return [line]
    inside = [textwrap.wrap(part, WIDTH - len(indent) - 3) or [""] for part in text.split("\n")]
    return [f"{indent}/**", *(f"{indent} * {line}".rstrip() for part in inside for line in part), f"{indent} */"]


def fields(table: Table) -> str:
    """Return the file of what is checked of scenes."""
    lines = [FIELDS_HEAD]
    for name, words in table["choices"].items():
        lines.append(f"export const {plural(name)} = {literal(words, '[]')} as const;")
    lights = ", ".join(f'{kind}: "{kind.capitalize()}Light"' for kind in table["Light"]["kinds"])
    lines += ["/** The classes of the kinds of lights. */", f"export const LIGHTS = {{ {lights} }} as const;"]
    most = rows_of(table)["Scene"]["width"]["limits"][1]
    # apart from FIELDS, which scripts leave out that need no more
    lines += ["/** The most pixels a side of a picture. */", f"export const MAX_SIDE = {most};", ""]
    lines += block("export interface Plain {", "Of each class, the fields with a kind, checked.", table, plain)
    lines += block("export interface InFile {", "Of each class, the keys of files that are no fields.", table, in_file)
    lines += block("export const FIELDS = {", "All fields, and keys of scene files.", table, as_object)
    return "\n".join([*lines[:-1], "} as const;", ""])


def block(head: str, text: str, table: Table, line: Callable[[str, Row], str]) -> list[str]:
    """Return an object of TypeScript, in which each class has the lines of its fields."""
    lines = ["// prettier-ignore", f"/** {text} */", head]
    for name, _, rows in web_rows(table):
        if inside := [f"        {shown}" for key, row in rows.items() if (shown := line(key, row))]:
            lines += [f"    {name}: {{", *inside, "    },"]
    return [*lines, "}"]


def plain(key: str, row: Row) -> str:
    """Return the type of a field with a kind."""
    absent = "" if row.get("needed") or "default" in row else " | undefined"
    return f"{key}: {type_of(row, 1)}{absent};" if "kind" in row and row.get("only") != "file" else ""


def in_file(key: str, row: Row) -> str:
    """Return the type of a key that is no field."""
    return f"{key}: {type_of(row, 1)};" if "kind" in row and row.get("only") == "file" else ""


def as_object(key: str, row: Row) -> str:
    """Return what is known of a field."""
    inside = ", ".join(f"{name}: {value}" for name, value in described(row, "[]", "needed", "only"))
    return f"{key}: {{ {inside} }}," if inside else f"{key}: {{}},"


# ---- both ----


def constants(table: Table, title: str, line: str, brackets: str, remark: Callable[[str], list[str]]) -> str:
    """Return the file of the numbers."""
    lines = [title]
    for part in table["numbers"]:
        for name, value, text in part["rows"]:
            fixed = " as const" if brackets == "[]" and isinstance(value, list) else ""
            lines += [*remark(text), line.format(name, literal(value, brackets) + fixed)]
    return "\n".join([*lines, ""])


# ---- documentation ----


def keys(table: Table) -> dict[str, str]:
    """Return the tables of the keys of classes by their marks; that of a scene has classes without marks, too."""
    classes, found = rows_of(table), {}
    inside = {name.lower(): rows for name, rows in classes.items() if "page" not in table[name]}
    for name, rows in classes.items():
        if "page" not in table[name]:
            continue
        lines = ["| key | value | default |", "|---|---|---|"]
        for key, row in rows.items():
            if row.get("only") != "class":
                own = inside.get(key, {}) if name == "Scene" else {}
                lines += [key_row(key, row), *(key_row(f"{key}.{each}", more) for each, more in own.items())]
        found[table[name]["page"]] = "\n".join(lines)
    return found


def key_row(key: str, row: Row) -> str:
    """Return the row of a key."""
    usual = f"`{json.dumps(row['default'])}`" if "default" in row else "none"
    if row.get("needed"):
        usual = "required for these kinds" if "lights" in row else "required"
    return f"| `{key}` | {ranged(row, '{} to {}', '{} or more')} | {row.get('usual', usual)} |"


def files() -> dict[Path, str]:
    """Return the text of every file that is made of the table."""
    table = tomllib.loads(TABLE.read_text("utf-8"))
    title = f"Numbers by which scenes are prepared. {MADE}"
    return {
        PACKAGE / "_fields.py": python(table),
        PACKAGE / "_constants.py": constants(table, f'"""{title}"""\n', "{} = {}", "()", python_comment),
        WEB / "types.ts": types(table),
        WEB / "fields.ts": fields(table),
        WEB / "constants.ts": constants(table, f"// {title}\n", "export const {} = {};", "[]", comment),
        PAGE: filled(PAGE, keys(table).get),
    }
