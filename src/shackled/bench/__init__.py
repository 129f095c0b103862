"""The experiments of the Shackled paper on the contracts of this package, and some that it could not make.

`EXPERIMENTS` in `_runner.py` names them.
"""
