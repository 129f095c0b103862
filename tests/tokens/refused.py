"""Transactions that a contract refuses."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from tools.tokens.world import Refused


@contextmanager
def refused(name: str, *values: Any) -> Iterator[None]:
    """Expect an error of a contract by its name, with these values if any are given."""
    with pytest.raises(Refused) as caught:
        yield
    assert caught.value.name == name, caught.value
    if values:
        assert caught.value.values == values
