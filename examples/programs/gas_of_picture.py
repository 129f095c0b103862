"""Print the gas of a picture, by stage, and the limits within which it fits."""

import shackled
from shackled.gas import limits, profile

scene = shackled.load("cube", size=32, color="teal")
image = shackled.render(scene)
assert image.gas is not None
assert image.intrinsic_gas is not None
print(f"{image.gas:,} gas of execution, {image.intrinsic_gas:,} intrinsic")

stages = profile(scene).stages()
assert sum(stages.values()) == image.gas
for name, gas in stages.items():
    print(f"{gas:10,}  {name}")

for limit in limits():
    fits = "fits" if image.gas + image.intrinsic_gas <= limit.gas else "too much"
    print(f"{limit.gas:11,}  {limit.name}: {fits}")
