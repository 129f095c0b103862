"""What pictures cost in gas: the snapshot that tests compare with, and the tables of `python -m benchmarks`."""
