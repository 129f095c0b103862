"""JSON and TOML of strangers."""

from __future__ import annotations

import json
import re
import tomllib
from typing import Any

#: Brackets within brackets.
MAX_NESTING = 200
#: Strings, whole or cut off, and brackets outside of them.
JSON_TOKENS = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"?|[\[\]{}]', re.DOTALL)
#: The same with the other strings of TOML, and with comments.
TOML_TOKENS = re.compile(
    r"""
    \"{3} [^"\\]* (?: (?: \\. | "(?!"") ) [^"\\]* )* (?: "{3,5} | \Z )
    | '{3} .*? (?: '{3,5} | \Z )
    | " [^"\\\n]* (?: \\. [^"\\\n]* )* "?
    | ' [^'\n]* '?
    | \# [^\n]*
    | [\[\]{}]
    """,
    re.DOTALL | re.VERBOSE,
)


def read_json(text: str, **options: Any) -> Any:
    """As `json.loads`. ValueError too where brackets are nested too deep.

    Some packages raise Python's limit of recursion so far that such a text would end the process.
    """
    _check_nesting(text, JSON_TOKENS)
    return json.loads(text, **options)


def read_toml(text: str) -> dict[str, Any]:
    """As `tomllib.loads`. ValueError too where brackets or tables are nested too deep."""
    _check_nesting(text, TOML_TOKENS)
    document = tomllib.loads(text)
    level: list[Any] = [document]
    for _ in range(MAX_NESTING):
        tables = (each.values() if isinstance(each, dict) else each for each in level if isinstance(each, dict | list))
        level = [value for table in tables for value in table]
    if level:
        raise ValueError(f"its tables are nested more than {MAX_NESTING} deep")
    return document


def _check_nesting(text: str, tokens: re.Pattern[str]) -> None:
    depth = 0
    for match in tokens.finditer(text):
        token = match[0]
        depth += (token in ("[", "{")) - (token in ("]", "}"))
        if depth > MAX_NESTING:
            raise ValueError(f"its brackets are nested more than {MAX_NESTING} deep")
