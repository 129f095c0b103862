"""The command `shackled`."""

from .app import main

__all__ = ["main"]
