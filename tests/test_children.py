"""Processes that tests start: they react to Ctrl-C and are ended, whatever happens."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

import pytest
from tools.children import child

ROOT = Path(__file__).resolve().parent.parent
WAITS = "print('ready', flush=True); import time; time.sleep(600)"


@pytest.fixture
def _ignored() -> object:
    """As under nohup, or in the background of a script."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("_ignored")
def test_it_is_interrupted_also_where_tests_are_not() -> None:
    with child(sys.executable, "-c", WAITS) as process:
        assert process.stdout is not None
        process.stdout.readline()
        process.send_signal(signal.SIGINT)
        assert "KeyboardInterrupt" in process.communicate(timeout=60)[1]
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN


def test_it_is_ended_with_a_test_that_fails() -> None:
    with pytest.raises(AssertionError, match="so"), child(sys.executable, "-c", WAITS) as process:
        raise AssertionError("so")
    assert process.returncode == -signal.SIGKILL


def test_a_test_that_hangs_fails(tmp_path: Path) -> None:
    (tmp_path / "test_it.py").write_text(
        "import sys\nfrom tools.children import child\n"
        f"def test_it():\n    with child(sys.executable, '-c', {WAITS!r}) as process:\n        process.wait()\n"
    )
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "--timeout", "3", "test_it.py"]
    with child(*command, cwd=tmp_path, env=os.environ | {"PYTHONPATH": str(ROOT)}) as process:
        assert "Failed: Timeout" in process.communicate(timeout=120)[0]
    assert process.returncode == 1


def test_every_process_of_a_test_is_such_a_child() -> None:
    files = [path for path in (ROOT / "tests").rglob("*.py") if "node_modules" not in path.parts]
    assert not [path for path in files if f"subprocess.{'Popen'}(" in path.read_text("utf-8")]
