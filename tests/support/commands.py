"""Commands that tests run, and what they print."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Said:
    """What a command printed. code: with which it ended."""

    code: int
    out: str
    err: str

    @property
    def error(self) -> str:
        """The last line on stderr."""
        return self.err.strip().splitlines()[-1]

    @property
    def json(self) -> Any:
        """The document on stdout."""
        return json.loads(self.out)


#: Runs a command of the package.
Shackled = Callable[..., Said]
