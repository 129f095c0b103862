"""Untrusted text: JSON, TOML, and lines for a terminal."""

from __future__ import annotations

import json
import re
import tomllib
from typing import Any

#: Levels of brackets within brackets, and parts of a dotted key.
MAX_NESTING = 200
#: Strings, complete or not, and brackets outside of them.
JSON_TOKENS = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"?|[\[\]{}]', re.DOTALL)
#: A part of a dotted key of TOML.
TOML_PART = r"""(?: [A-Za-z0-9_-]+ | " [^"\\\n]* (?: \\. [^"\\\n]* )* " | ' [^'\n]* ' )"""
#: The same tokens for TOML, which has other strings and comments, and dotted keys of three parts or more; no number has
#: two dots.
TOML_TOKENS = re.compile(
    rf"""
    \"{{3}} [^"\\]* (?: (?: \\. | "(?!"") ) [^"\\]* )* (?: "{{3,5}} | \Z )
    | '{{3}} .*? (?: '{{3,5}} | \Z )
    | (?<! [\w.-] ) (?P<key> {TOML_PART} (?: [ \t]* \. [ \t]* {TOML_PART} ){{2,}} )
    | " [^"\\\n]* (?: \\. [^"\\\n]* )* "?
    | ' [^'\n]* '?
    | \# [^\n]*
    | [\[\]{{}}]
    """,
    re.DOTALL | re.VERBOSE,
)


def read_json(text: str, **options: Any) -> Any:
    """Parse JSON as `json.loads` does. ValueError also where brackets are nested too deep.

    Some packages raise Python's recursion limit so far that such a text would crash the process.
    """
    _check_nesting(text, JSON_TOKENS)
    return json.loads(text, **options)


def read_toml(text: str) -> dict[str, Any]:
    """Parse TOML as `tomllib.loads` does. ValueError also where brackets or tables are nested too deep.

    The same where a key has too many parts, for which tomllib would take quadratic time.
    """
    _check_nesting(text, TOML_TOKENS)
    document = tomllib.loads(text)
    level: list[Any] = [document]
    for _ in range(MAX_NESTING):
        tables = (each.values() if isinstance(each, dict) else each for each in level if isinstance(each, dict | list))
        level = [value for table in tables for value in table]
    if level:
        raise ValueError(f"its tables are nested more than {MAX_NESTING} deep")
    return document


def plain(text: str) -> str:
    """Return the text with a question mark for every character that could be a command to a terminal."""
    return "".join(letter if letter.isprintable() else "?" for letter in text)


def _check_nesting(text: str, tokens: re.Pattern[str]) -> None:
    depth = 0
    for match in tokens.finditer(text):
        token = match[0]
        depth += (token in ("[", "{")) - (token in ("]", "}"))
        if match.lastgroup == "key" and len(re.findall(TOML_PART, token, re.VERBOSE)) > MAX_NESTING:
            raise ValueError(f"one of its keys has more than {MAX_NESTING} parts")
        if depth > MAX_NESTING:
            raise ValueError(f"its brackets are nested more than {MAX_NESTING} deep")
