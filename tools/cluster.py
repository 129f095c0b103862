"""Run a dask cluster on this machine, in a process of its own, since dask runs the main script again in each worker.

`python -m tools.cluster WORKERS` starts one, prints its address, and ends with its standard input.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tools.children import child


@contextmanager
def cluster(workers: int) -> Iterator[tuple[str, subprocess.Popen[str]]]:
    """Yield the address of a new cluster, and its process, which ends with the context."""
    command = [sys.executable, "-m", "tools.cluster", str(workers)]
    place = Path(__file__).parents[1]
    with child(*command, cwd=place, stdin=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        assert process.stdout is not None
        try:
            yield process.stdout.readline().strip(), process
        finally:
            # the end of its input: it ends its own processes then
            process.communicate(timeout=60)


if __name__ == "__main__":
    from distributed import LocalCluster

    with LocalCluster(  # type: ignore[no-untyped-call]
        n_workers=int(sys.argv[1]), threads_per_worker=1, host="127.0.0.1", dashboard_address="127.0.0.1:0"
    ) as started:
        print(started.scheduler_address, flush=True)
        sys.stdin.read()
