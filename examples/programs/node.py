"""Render on a node, without deploying anything. SHACKLED_RPC has its address; start one with `anvil`."""

import os

import shackled

node = shackled.Nodes(os.environ.get("SHACKLED_RPC", "http://127.0.0.1:8545"), timeout=60)
try:
    image = shackled.render("cube", size=32, on=node)
except shackled.ChainError as error:
    raise SystemExit(f"the node cannot render: {error}") from None
assert image.gas == shackled.render("cube", size=32).gas
print(f"{image.gas:,} gas, {image.made_by}")
