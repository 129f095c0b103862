"""The tool that compiles the contracts."""

from __future__ import annotations

import builtins
import importlib.util
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent


def test_a_closed_pipe_leaves_no_old_artifacts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As `tools/build_contracts.py | head -1`: what was built is written before anything is printed."""
    spec = importlib.util.spec_from_file_location("build_contracts", ROOT / "tools" / "build_contracts.py")
    assert spec is not None
    assert spec.loader is not None
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    text = '{"contract": "Thing", "deployedBytecode": "00", "group": "calls"}\n'
    monkeypatch.setattr(tool, "ARTIFACTS", tmp_path)
    monkeypatch.setattr(tool, "build", lambda **_: {"Thing.json": text})
    monkeypatch.setattr(sys, "argv", ["build_contracts.py", "--group", "calls"])
    (tmp_path / "Old.json").write_text(text)

    def closed(*_: object, **__: object) -> None:
        raise BrokenPipeError

    monkeypatch.setattr(builtins, "print", closed)
    with pytest.raises(BrokenPipeError):
        tool.main()
    assert [path.name for path in tmp_path.iterdir()] == ["Thing.json"]
