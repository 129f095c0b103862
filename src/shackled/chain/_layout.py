"""Registers, packed words and modes. Written by tools/layout.py from contracts/layout.toml."""

# frame
FRAME_BEGIN = 0x800
FRAME_IS_ANTIALIASED = 0x820
EFFECTS_OFFSET = 0x840
OBJECT_COUNT = 0xB20
OBJECTS_BEGIN = 0xBA0

# object
OBJECT_BYTES = 0x1260
OBJECT_MODE = 0x1280
OBJECT_FLAGS = 0x12A0

# mode
IS_SMOOTH = 16
IS_QUADRATIC = 0x200
IS_SPOT_LIT = 0x4000
IS_BLENDED = 0x8000

# of pipeline/Pipeline.sol
BAND_PIXELS = 0x4000
