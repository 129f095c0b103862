from ._collection import COUNT, find, generate, parse_seed, pieces, seed_of
from ._contract import generate_on_chain, picture_on_chain
from ._piece import GenesisPiece
from ._sheet import render_sheet

__all__ = [
    "COUNT",
    "GenesisPiece",
    "find",
    "generate",
    "generate_on_chain",
    "parse_seed",
    "picture_on_chain",
    "pieces",
    "render_sheet",
    "seed_of",
]
