"""Pixels of a band in which a contract draws. Written by tools/layout.py from Pipeline.sol."""

BAND_PIXELS = 16384
