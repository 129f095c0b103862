"""`python -m shackled` is the command `shackled`."""

from .cli import main

main()
