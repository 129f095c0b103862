"""Make contracts/src/building/Glyphs.sol: the letters of `Lettering.sol`.

The letters are drawn for Shackled. Each is a list of strokes, and a stroke the points of its middle line, x from 0 to
11 and y from -3 to 12: capitals are 10 high, small letters 7. A stroke of one point is a dot; one that ends where it
began is closed.
"""

from __future__ import annotations

from pathlib import Path

FILE = Path(__file__).resolve().parent.parent / "contracts" / "src" / "building" / "Glyphs.sol"

#: What a glyph ends with, and a stroke that is not its last. x is never 15.
END_OF_GLYPH, END_OF_STROKE = 0xFF, 0xFE
#: The lowest y.
LOWEST = -3

LETTERS = {
    "!": "0,10 0,4 | 0,0",
    '"': "0,10 0,8 | 3,10 3,8",
    "#": "2,0 3,10 | 5,0 6,10 | 0,3 7,3 | 1,7 8,7",
    "$": "6,10 2,10 0,8 0,7 2,5 4,5 6,3 6,2 4,0 0,0 | 3,12 3,-2",
    "%": "0,0 7,10 | 0,8 0,10 2,10 2,8 0,8 | 5,0 5,2 7,2 7,0 5,0",
    "&": "7,0 1,8 1,9 2,10 4,10 5,9 5,8 0,3 0,2 2,0 4,0 7,4",
    "'": "0,10 0,8",
    "(": "2,12 0,9 0,1 2,-2",
    ")": "0,12 2,9 2,1 0,-2",
    "*": "2,8 2,4 | 0,7 4,5 | 0,5 4,7",
    "+": "3,8 3,2 | 0,5 6,5",
    ",": "1,0 0,-2",
    "-": "0,5 4,5",
    ".": "0,0",
    "/": "0,-1 5,11",
    "0": "2,0 4,0 6,2 6,8 4,10 2,10 0,8 0,2 2,0 | 2,3 4,7",
    "1": "2,10 2,0 | 0,8 2,10 | 0,0 4,0",
    "2": "0,8 2,10 4,10 6,8 6,7 0,1 0,0 6,0",
    "3": "0,10 4,10 6,8 6,7 4,5 1,5 | 4,5 6,3 6,2 4,0 0,0",
    "4": "5,0 5,10 4,10 0,4 0,3 7,3",
    "5": "6,10 0,10 0,6 4,6 6,4 6,2 4,0 0,0",
    "6": "5,10 2,10 0,8 0,2 2,0 4,0 6,2 6,4 4,6 0,6",
    "7": "0,10 6,10 6,9 2,0",
    "8": "2,5 0,7 0,8 2,10 4,10 6,8 6,7 4,5 2,5 | 2,5 0,3 0,2 2,0 4,0 6,2 6,3 4,5",
    "9": "1,0 4,0 6,2 6,8 4,10 2,10 0,8 0,6 2,4 6,4",
    ":": "0,0 | 0,6",
    ";": "1,0 0,-2 | 1,6",
    "<": "5,9 0,5 5,1",
    "=": "0,3 6,3 | 0,7 6,7",
    ">": "0,9 5,5 0,1",
    "?": "0,8 2,10 4,10 6,8 6,7 3,4 3,3 | 3,0",
    "@": "8,0 2,0 0,2 0,8 2,10 6,10 8,8 8,3 3,3 3,7 5,7 5,3",
    "A": "0,0 3,10 4,10 7,0 | 1,3 6,3",
    "B": "0,0 0,10 4,10 6,8 6,7 4,5 0,5 | 4,5 6,3 6,2 4,0 0,0",
    "C": "6,10 2,10 0,8 0,2 2,0 6,0",
    "D": "0,0 0,10 4,10 6,8 6,2 4,0 0,0",
    "E": "6,10 0,10 0,0 6,0 | 0,5 5,5",
    "F": "6,10 0,10 0,0 | 0,5 5,5",
    "G": "6,10 2,10 0,8 0,2 2,0 6,0 6,5 3,5",
    "H": "0,0 0,10 | 6,0 6,10 | 0,5 6,5",
    "I": "0,0 0,10",
    "J": "5,10 5,2 3,0 2,0 0,2",
    "K": "0,0 0,10 | 6,10 0,4 | 2,6 6,0",
    "L": "0,10 0,0 5,0",
    "M": "0,0 0,10 1,10 4,4 7,10 8,10 8,0",
    "N": "0,0 0,10 1,10 6,0 7,0 7,10",
    "O": "2,0 4,0 6,2 6,8 4,10 2,10 0,8 0,2 2,0",
    "P": "0,0 0,10 4,10 6,8 6,6 4,4 0,4",
    "Q": "2,0 4,0 6,2 6,8 4,10 2,10 0,8 0,2 2,0 | 4,3 7,-1",
    "R": "0,0 0,10 4,10 6,8 6,6 4,4 0,4 | 3,4 6,0",
    "S": "6,10 2,10 0,8 0,7 2,5 4,5 6,3 6,2 4,0 0,0",
    "T": "0,10 6,10 | 3,10 3,0",
    "U": "0,10 0,2 2,0 4,0 6,2 6,10",
    "V": "0,10 3,0 4,0 7,10",
    "W": "0,10 2,0 3,0 5,7 6,7 8,0 9,0 11,10",
    "X": "0,0 6,10 | 0,10 6,0",
    "Y": "0,10 3,5 6,10 | 3,5 3,0",
    "Z": "0,10 6,10 6,9 0,1 0,0 6,0",
    "[": "2,12 0,12 0,-2 2,-2",
    "\\": "0,11 5,-1",
    "]": "0,12 2,12 2,-2 0,-2",
    "^": "0,7 3,10 6,7",
    "_": "0,-2 6,-2",
    "`": "0,11 2,9",
    "a": "5,2 3,0 2,0 0,2 0,5 2,7 3,7 5,5 | 5,7 5,0",
    "b": "0,10 0,0 | 0,5 2,7 3,7 5,5 5,2 3,0 2,0 0,2",
    "c": "5,7 2,7 0,5 0,2 2,0 5,0",
    "d": "5,10 5,0 | 5,2 3,0 2,0 0,2 0,5 2,7 3,7 5,5",
    "e": "0,4 5,4 5,5 3,7 2,7 0,5 0,2 2,0 5,0",
    "f": "5,10 4,10 2,8 2,0 | 0,7 4,7",
    "g": "5,2 3,0 2,0 0,2 0,5 2,7 3,7 5,5 | 5,7 5,-1 3,-3 0,-3",
    "h": "0,10 0,0 | 0,5 2,7 3,7 5,5 5,0",
    "i": "0,7 0,0 | 0,10",
    "j": "2,7 2,-1 0,-3 | 2,10",
    "k": "0,10 0,0 | 5,7 0,2 | 2,4 5,0",
    "l": "0,10 0,2 2,0",
    "m": "0,7 0,0 | 0,5 2,7 3,7 4,6 4,0 | 4,5 6,7 7,7 8,6 8,0",
    "n": "0,7 0,0 | 0,5 2,7 3,7 5,5 5,0",
    "o": "2,0 3,0 5,2 5,5 3,7 2,7 0,5 0,2 2,0",
    "p": "0,7 0,-3 | 0,5 2,7 3,7 5,5 5,2 3,0 2,0 0,2",
    "q": "5,7 5,-3 | 5,2 3,0 2,0 0,2 0,5 2,7 3,7 5,5",
    "r": "0,7 0,0 | 0,5 2,7 4,7",
    "s": "5,7 1,7 0,6 0,5 1,4 4,4 5,3 5,1 4,0 0,0",
    "t": "2,10 2,2 4,0 5,0 | 0,7 4,7",
    "u": "0,7 0,2 2,0 3,0 5,2 | 5,7 5,0",
    "v": "0,7 2,0 3,0 5,7",
    "w": "0,7 2,0 3,0 4,5 5,5 6,0 7,0 9,7",
    "x": "0,0 5,7 | 0,7 5,0",
    "y": "0,7 0,2 2,0 5,0 | 5,7 5,-1 3,-3 0,-3",
    "z": "0,7 5,7 5,6 0,1 0,0 5,0",
    "{": "3,12 2,12 1,11 1,6 0,5 1,4 1,-1 2,-2 3,-2",
    "|": "0,12 0,-2",
    "}": "0,12 1,12 2,11 2,6 3,5 2,4 2,-1 1,-2 0,-2",
    "~": "0,4 2,6 5,4 7,6",
}


def strokes(letter: str) -> list[list[tuple[int, int]]]:
    """Return the strokes of a letter as lists of points (x, y)."""
    return [
        [(int(x), int(y)) for x, y in (point.split(",") for point in stroke.split())]
        for stroke in LETTERS[letter].split("|")
    ]


def files() -> dict[Path, str]:
    """Return the text of the file, by its path."""
    data, starts = b"", []
    for code in range(0x21, 0x7F):
        starts.append(len(data))
        each = [bytes(x << 4 | y - LOWEST for x, y in stroke) for stroke in strokes(chr(code))]
        data += bytes([END_OF_STROKE]).join(each) + bytes([END_OF_GLYPH])
    source = (
        "// SPDX-License-Identifier: MIT\npragma solidity ^0.8.25;\n\n"
        "// Generated by tools/lettering.py, which has the letters in readable form.\n\n"
        "// The points of the strokes of the characters 0x21 to 0x7e, one byte each: x in the upper four bits, y + 3\n"
        "// in the lower four; 0xfe separates strokes, and 0xff ends a character.\n"
        f"bytes constant STROKES =\n{_literal(data)};\n\n"
        "// Offset of each character in STROKES, in two bytes.\n"
        f"bytes constant STARTS =\n{_literal(b''.join(start.to_bytes(2, 'big') for start in starts))};\n"
    )
    return {FILE: source}


def _literal(data: bytes) -> str:
    return "\n".join(f'    hex"{data[at : at + 60].hex()}"' for at in range(0, len(data), 60))
