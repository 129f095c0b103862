from ._collection import COUNT, find, parse_seed, pieces, render_sheet, seed_of
from ._contract import GenesisPiece, generate, generate_on_chain, picture_on_chain

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
