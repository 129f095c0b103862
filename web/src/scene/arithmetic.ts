// Arithmetic whose results are the same in every engine, and in src/shackled/scene/_arithmetic.py: sums in a stated
// order, and sines by integers.

export type Vector = [number, number, number];
export type Quaternion = [number, number, number, number];

/** Bits after the point of a series. */
const BITS = 106n;

export function add(a: Vector, b: Vector): Vector {
    return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function subtract(a: Vector, b: Vector): Vector {
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function times(factor: number, v: Vector): Vector {
    return [factor * v[0], factor * v[1], factor * v[2]];
}

export function dot(a: Vector, b: Vector): number {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Vector, b: Vector): Vector {
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** Return the number of a range that is nearest to x. */
export function clamped(x: number, low: number, high: number): number {
    return Math.min(Math.max(x, low), high);
}

/** Return the length of a vector; infinite where a square is beyond what a float holds. */
export function length(v: readonly number[]): number {
    return Math.sqrt(v.map((x) => x * x).reduce((sum, square) => sum + square));
}

/** Return the largest coordinate, without its sign. */
export function largest(v: readonly number[]): number {
    return Math.max(...v.map(Math.abs));
}

/** Return the least and the largest of each coordinate of points, three numbers each; zeros without points. */
export function boundsOf(points: Float64Array): [Vector, Vector] {
    const first: Vector = points.length ? rowOf(points, 0) : [0, 0, 0];
    const [low, high]: [Vector, Vector] = [[...first], [...first]];
    for (let axis = 0; axis < 3; axis++) {
        let [least, most] = [low[axis], high[axis]];
        for (let at = axis; at < points.length; at += 3) {
            if (points[at] < least) least = points[at];
            if (points[at] > most) most = points[at];
        }
        [low[axis], high[axis]] = [least, most];
    }
    return [low, high];
}

/** Return a row of three numbers. */
export function rowOf(table: Float64Array, index: number): Vector {
    return [table[3 * index], table[3 * index + 1], table[3 * index + 2]];
}

/** Return a vector or quaternion of any length but zero as one of length 1. */
export function unit<V extends Vector | Quaternion>(v: V): V {
    const most = largest(v);
    const scaled = v.map((x) => x / most);
    const size = length(scaled);
    return scaled.map((x) => x / size) as V;
}

/** Return the function that turns points by a quaternion of any length but zero. */
export function rotation(quaternion: Quaternion): (point: Vector) => Vector {
    const [x, y, z, w] = unit(quaternion);
    const axis: Vector = [x, y, z];
    return (point) => {
        const t = times(2, cross(axis, point));
        return add(add(point, times(w, t)), cross(axis, t));
    };
}

/** Return the rotation `first`, followed by `second`. */
export function multiply(second: Quaternion, first: Quaternion): Quaternion {
    const a: Vector = [second[0], second[1], second[2]];
    const b: Vector = [first[0], first[1], first[2]];
    const v = add(add(times(second[3], b), times(first[3], a)), cross(a, b));
    return [...v, second[3] * first[3] - dot(a, b)];
}

/** Return the rotation about an axis of any length but zero, counter-clockwise seen from where the axis points. */
export function fromAxisAngle(axis: Vector, degrees: number): Quaternion {
    const half = remainder(degrees) / 2;
    return [...times(sine(half), unit(axis)), cosine(half)];
}

/** Return the rotation about the x, then the y, then the z axis of the world, each in degrees. */
export function fromEuler([x, y, z]: Vector): Quaternion {
    const aboutX = fromAxisAngle([1, 0, 0], x);
    const aboutY = fromAxisAngle([0, 1, 0], y);
    return multiply(fromAxisAngle([0, 0, 1], z), multiply(aboutY, aboutX));
}

/** Return the angle less the nearest number of whole turns, an even number of them where two are as near. */
function remainder(degrees: number): number {
    const rest = degrees % 720;
    const size = Math.abs(rest);
    return rest - Math.sign(rest) * (size >= 540 ? 720 : size > 180 ? 360 : 0);
}

/** Return the cosine of an angle. */
export function cosine(degrees: number): number {
    return toNumber(series(degrees)[0]);
}

/** Return the sine of an angle. */
export function sine(degrees: number): number {
    return toNumber(series(degrees)[1]);
}

/** Return the tangent of an angle between -90 and 90 degrees. */
export function tangent(degrees: number): number {
    const [c, s] = series(Math.abs(degrees));
    return Math.sign(degrees) * toNumber((s << BITS) / c);
}

/** Return cosine and sine, times 2^BITS, by their power series. */
function series(degrees: number): [bigint, bigint] {
    const radians = (degrees % 360) * (Math.PI / 180);
    const x = BigInt(Math.floor(Math.abs(radians) * 2 ** Number(BITS)));
    const sums: [bigint, bigint] = [0n, 0n];
    let term = 1n << BITS;
    for (let power = 0; term;) {
        sums[power % 2 ? 1 : 0] += power & 2 ? -term : term;
        power += 1;
        term = ((term * x) >> BITS) / BigInt(power);
    }
    return radians < 0 ? [sums[0], -sums[1]] : sums;
}

function toNumber(value: bigint): number {
    return Number(value) / 2 ** Number(BITS);
}

/** Return the nearest whole number, the even one where two are as near. */
export function rint(x: number): number {
    // beyond 2^52 all floats are whole numbers
    const shift = x < 0 ? -(2 ** 52) : 2 ** 52;
    return Math.abs(x) < 2 ** 52 ? x + shift - shift : x;
}

/** Return the e with 2^(e-1) <= x < 2^e; 0 where there is none. */
export function exponentOf(x: number): number {
    if (!(Math.abs(x) > 0 && Number.isFinite(x))) return 0;
    const view = new DataView(new ArrayBuffer(8));
    view.setFloat64(0, x);
    const biased = (view.getUint16(0) >> 4) & 0x7ff;
    return biased ? biased - 1022 : exponentOf(x * 2 ** 64) - 64;
}

/** Return 2^exponent, exponent from -1022 to 1023. */
export function powerOfTwo(exponent: number): number {
    const view = new DataView(new ArrayBuffer(8));
    view.setUint16(0, (exponent + 1023) << 4);
    return view.getFloat64(0);
}
