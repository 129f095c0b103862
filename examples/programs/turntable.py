"""Render a full turn of a model as a GIF and as an APNG."""

import shackled

spin = shackled.turntable("icons/diamond", frames=6, size=48, duration=120)
spin.save("spin.gif")  # at most 256 colours
spin.save("spin.png")  # an APNG with the exact pixels
print(f"{spin.pixels.shape[0]} frames, {spin.gas:,} gas")
