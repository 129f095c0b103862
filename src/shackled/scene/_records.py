"""The kinds of the records of Scene.extensions. Written by tools/layout.py from contracts/layout.toml."""

SPOT = 1
OPACITY_OF = 2
ANTIALIAS = 3
HEMISPHERE = 4
RIM = 5
FOG = 6
TONE = 7
TEXTURE_OF = 8
OPACITIES_OF = 9
SHADOW = 10
GROUND = 11
EMISSION_OF = 12
ALPHA_OF = 13

TONE_FILMIC = 1
TONE_GAMMA = 2
TEXTURE_BILINEAR = 1
TEXTURE_CLAMP = 2
SHADOWS_ALL = 1
SHADOWS_BACK_FACES = 2
SHADOWS_FRONT_FACES = 3

#: The first kind whose size is given in words of 32 bytes, not in bytes.
LONG_KINDS = 8
#: Bytes of a record before its content.
RECORD_HEADER = 5
#: The flags of a tone, by its fields.
TONE_FLAGS = {"filmic": TONE_FILMIC, "gamma": TONE_GAMMA}
#: Bytes of its content; None for any number of words.
SIZES: dict[int, int | None] = {
    SPOT: 40,
    OPACITY_OF: 4,
    ANTIALIAS: 0,
    HEMISPHERE: 6,
    RIM: 4,
    FOG: 19,
    TONE: 5,
    TEXTURE_OF: None,
    OPACITIES_OF: None,
    SHADOW: 32,
    GROUND: 32,
    EMISSION_OF: 32,
    ALPHA_OF: None,
}
