"""Results of the compiler in the cache folder of the user, so that processes and runs share them."""

from __future__ import annotations

import fcntl
import hashlib
import json
from typing import Any

from platformdirs import user_cache_path

from shackled.whole_file import write_whole
from tools import build_contracts


def compile_once(request: dict[str, Any]) -> dict[str, Any]:
    """Return the contracts that the compiler makes of a request, by source and name.

    What was compiled before is read from a file. A process that is asked for the same waits for the first.
    """
    text = build_contracts._text(request)
    compiler = (build_contracts.LIBRARIES / "solc" / "package.json").read_text("utf-8")
    key = hashlib.sha256((compiler + text).encode()).hexdigest()[:16]
    path = user_cache_path("shackled", appauthor=False) / f"solc-{key}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not path.is_file():
            write_whole(path, json.dumps(build_contracts.run_compiler(text)["contracts"]).encode())
    contracts: dict[str, Any] = json.loads(path.read_bytes())
    return contracts
