"""An EVM with the contracts of the package, for the tests of a file."""

from __future__ import annotations

import pytest
from tools.ledger import World


@pytest.fixture(scope="module")
def world() -> World:
    return World()
