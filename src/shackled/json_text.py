"""JSON of strangers."""

from __future__ import annotations

import json
import re
from typing import Any

#: Brackets within brackets.
MAX_NESTING = 200
#: Strings, whole or cut off, and brackets outside of them.
TOKENS = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"?|[\[\]{}]', re.DOTALL)


def read_json(text: str, **options: Any) -> Any:
    """As `json.loads`. ValueError too where brackets are nested too deep.

    Some packages raise Python's limit of recursion so far that such a text would end the process.
    """
    depth = 0
    for match in TOKENS.finditer(text):
        token = match[0]
        depth += (token in ("[", "{")) - (token in ("]", "}"))
        if depth > MAX_NESTING:
            raise ValueError(f"its brackets are nested more than {MAX_NESTING} deep")
    return json.loads(text, **options)
