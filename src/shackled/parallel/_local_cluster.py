"""A dask cluster of this machine: `python -m shackled.parallel._local_cluster WORKERS`.

It tells its address, and runs until its standard input ends. It is a process of its own, since dask runs the script of
whoever starts workers once more in each of them.
"""

from __future__ import annotations

import sys


def main() -> None:
    """Starts the cluster."""
    from distributed import LocalCluster

    with LocalCluster(  # type: ignore[no-untyped-call]
        n_workers=int(sys.argv[1]), threads_per_worker=1, host="127.0.0.1", dashboard_address="127.0.0.1:0"
    ) as cluster:
        print(cluster.scheduler_address, flush=True)
        sys.stdin.read()


if __name__ == "__main__":
    main()
