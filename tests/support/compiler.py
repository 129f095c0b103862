"""The Solidity compiler, without which some tests are skipped."""

from __future__ import annotations

from pathlib import Path

import pytest

SOLC = Path(__file__).resolve().parents[2] / "contracts" / "node_modules" / "solc"
MISSING = "the compiler is not installed: npm ci in contracts/"
needs_compiler = pytest.mark.skipif(not SOLC.is_dir(), reason=MISSING)
