// The kinds of the records of Scene.extensions. Written by tools/layout.py from contracts/layout.toml.

export const SPOT = 1;
export const OPACITY_OF = 2;
export const ANTIALIAS = 3;
export const HEMISPHERE = 4;
export const RIM = 5;
export const FOG = 6;
export const TONE = 7;
export const TEXTURE_OF = 8;
export const OPACITIES_OF = 9;
export const SHADOW = 10;
export const GROUND = 11;
export const EMISSION_OF = 12;
export const ALPHA_OF = 13;

export const TONE_FILMIC = 1;
export const TONE_GAMMA = 2;
export const TEXTURE_BILINEAR = 1;
export const TEXTURE_CLAMP = 2;
export const SHADOWS_ALL = 1;
export const SHADOWS_BACK_FACES = 2;
export const SHADOWS_FRONT_FACES = 3;

/** The first kind whose size is given in words of 32 bytes, not in bytes. */
export const LONG_KINDS = 8;
/** Bytes of a record before its content. */
export const RECORD_HEADER = 5;
/** The fields and the flags of a tone. */
export const TONE_FLAGS = [
    ["filmic", TONE_FILMIC],
    ["gamma", TONE_GAMMA],
] as const;
/** Bytes of the content, for kinds of one size. */
export const SIZES = {
    [SPOT]: 40,
    [OPACITY_OF]: 4,
    [ANTIALIAS]: 0,
    [HEMISPHERE]: 6,
    [RIM]: 4,
    [FOG]: 19,
    [TONE]: 5,
    [SHADOW]: 32,
    [GROUND]: 32,
    [EMISSION_OF]: 32,
} as const;
