"""Make a piece of Genesis from a seed, print its traits, and render it."""

import hashlib

import shackled
from shackled.datasets import genesis

piece = genesis.generate(genesis.seed_of(12))
print(piece.structure, piece.chroma, piece.pseudosymmetry, piece.prisms, "prisms")
shackled.render(piece.scene(), size=64).save("genesis-12.png")

seed = hashlib.sha256(b"any text").hexdigest()
image = shackled.render(f"genesis/{seed}", size=64)
image.save("my-piece.png")
print(image)
