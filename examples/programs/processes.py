"""Render tiles of a picture in two threads, and check that they equal the whole."""

import shackled

whole = shackled.render("icosphere", size=64)
tiled = shackled.render("icosphere", size=64, tile=32, on=shackled.Processes(2))
assert (tiled.pixels == whole.pixels).all()
print(f"{tiled.calls} calls, {tiled.gas:,} gas; the whole takes {whole.gas:,}")
