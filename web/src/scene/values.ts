// Values of which scenes are made.

/** Rows of three numbers, as arrays or one after the other. */
export type Rows = ArrayLike<number> | readonly ArrayLike<number>[];

/** x, y, z. */
export type Vector3 = readonly [number, number, number];

/**
 * Red, green and blue in whole numbers 0..255, or in fractions 0..1 of which one at least is not whole; "#rgb",
 * "#rrggbb", or the CSS name of a colour. `Mesh.colors` also takes an alpha, "#rgba" or "#rrggbbaa".
 */
export type Color = readonly [number, number, number] | string;

/** Three angles in degrees about the axes x, then y, then z; or a quaternion x, y, z, w of any length but zero. */
export type Rotation = Vector3 | readonly [number, number, number, number];

/** A part of the canvas, in pixels from the top left corner. */
export interface Rectangle {
    x: number;
    y: number;
    width: number;
    height: number;
}
