// Compression of meshes and structs for storage; the formats are those of contracts/src/mesh/CompactMesh.sol and of solady's LibZip.

import { FACE, HEADER, NORMALS, WIDE, unpackedPositions } from "../../scene/mesh.js";

const COMPACT = 0x10;
/** Recent edges and vertices that a face may refer to. */
const EDGES = 15;
const RECENT = 14;
const NO_EDGE = 15;
const EXPLICIT = 15;
/** An explicit index is a distance from the newest vertex in a byte, or this byte and the number in two. */
const FAR = 255;

/** Faces in the order in which they are stored: their codes, explicit indices, and the old numbers of vertices in the new order. */
interface Order {
    codes: number[];
    explicit: number[];
    order: number[];
}

interface Parts {
    format: number;
    count: number;
    /** The fields of a vertex: three coordinates from 0, its colour, its normal. */
    fields: (vertex: number) => [number, number, number, number, number];
    faces: Uint16Array;
}

/** Return a packed mesh without loss in half its size or less. */
export function compact(packed: Uint8Array): Uint8Array {
    const parts = split(packed);
    const { codes, explicit, order } = ordered(parts.faces, parts.count);
    const rows = order.map(parts.fields);
    const column = (at: number): number[] => rows.map((row) => row[at]);
    const axes = [0, 1, 2].map(column);
    const low = axes.map((values) => (values.length ? values.reduce((a, b) => Math.min(a, b)) : 0));
    const widths = axes.map((values, at) => bitLength(values.reduce((a, b) => Math.max(a, b), low[at]) - low[at]));
    const colors = column(3);
    let palette = [...new Set(colors)].sort((a, b) => a - b);
    let colorBits = bitLength(palette.length - 1);
    if (24 * palette.length + colorBits * colors.length >= 24 * colors.length || palette.length > 0xffff) {
        [palette, colorBits] = [[], 24];
    }
    const index = new Map(palette.map((color, number) => [color, number]));
    const normalBits = parts.format & NORMALS ? 10 : 0;
    const sizes = [...widths, colorBits, normalBits, normalBits, normalBits];
    const bits = rows.map((row) => {
        const normals = [22, 12, 2].map((shift) => ((row[4] >>> shift) & 1023) ^ 512);
        const values = [row[0] - low[0], row[1] - low[1], row[2] - low[2], index.get(row[3]) ?? row[3], ...normals];
        return sizes.map((size, at) => (size ? values[at].toString(2).padStart(size, "0") : "")).join("");
    });
    return Uint8Array.from([
        ...[COMPACT, parts.format],
        ...[order.length, parts.faces.length / 3, explicit.length].flatMap(two),
        ...[...widths, ...low.flatMap(three), ...two(palette.length), colorBits, normalBits, ...palette.flatMap(three)],
        ...[...codes, ...explicit, ...bytesOfBits(bits.join(""))],
    ]);
}

/** Return the numbers that vertices had before `compact`, in their order after it. */
export function vertexOrder(faces: ArrayLike<number>, count: number): number[] {
    return ordered(Uint16Array.from(faces), count).order;
}

/** Compress like LibZip.cdCompress of solady: runs of 0x00 and 0xff in two bytes, the first four bytes negated. */
export function compressZeros(data: Uint8Array): Uint8Array {
    const found: number[] = [];
    for (let at = 0; at < data.length;) {
        const value = data[at];
        const most = value === 0 ? 128 : value === 255 ? 32 : 1;
        let end = at + 1;
        while (end < data.length && end - at < most && data[end] === value) end++;
        if (most === 1) found.push(value);
        else found.push(0, (value & 128) + end - at - 1);
        at = end;
    }
    return Uint8Array.from(found, (byte, at) => (at < 4 ? byte ^ 255 : byte));
}

function split(packed: Uint8Array): Parts {
    const { positions, triangles } = unpackedPositions(packed);
    const view = new DataView(packed.buffer, packed.byteOffset, packed.byteLength);
    const [format, count] = [packed[0], positions.length / 3];
    const facesAt = packed.length - FACE * triangles;
    const half = format & WIDE ? 2 ** 23 : 2 ** 15;
    return {
        format,
        count,
        fields: (vertex) => {
            const [x, y, z] = positions.subarray(3 * vertex, 3 * vertex + 3);
            const end = HEADER + ((vertex + 1) * (facesAt - HEADER)) / count;
            const normal = format & NORMALS ? view.getUint32(end - 4) : 0;
            const color = view.getUint32(end - (format & NORMALS ? 8 : 4)) & 0xffffff;
            return [x + half, y + half, z + half, color, normal];
        },
        faces: Uint16Array.from({ length: 3 * triangles }, (_, corner) => view.getUint16(facesAt + 2 * corner)),
    };
}

/** Order faces so that most share an edge with one of the last few, and number vertices by their first use. */
function ordered(faces: Uint16Array, count: number): Order {
    const key = (a: number, b: number): number => a * 65536 + b;
    /** The faces beside an edge, each with its third corner. */
    const beyond = new Map<number, [number, number][]>();
    for (let face = 0; face < faces.length / 3; face++) {
        const [a, b, c] = faces.subarray(3 * face) as unknown as [number, number, number];
        for (const [from, to, third] of [
            [a, b, c],
            [b, c, a],
            [c, a, b],
        ] as const) {
            const found = beyond.get(key(from, to));
            if (found) found.push([face, third]);
            else beyond.set(key(from, to), [[face, third]]);
        }
    }
    const done = new Uint8Array(faces.length / 3);
    const renamed = new Int32Array(count).fill(-1);
    const result: Order = { codes: [], explicit: [], order: [] };
    const { codes, explicit, order } = result;
    let edges: [number, number][] = [];
    let vertices: number[] = [];
    const remember = (vertex: number): void => void (vertices = [vertex, ...vertices.slice(0, RECENT - 1)]);
    const addNew = (vertex: number): void => {
        renamed[vertex] = order.length;
        remember(order.length);
        order.push(vertex);
    };
    const refer = (vertex: number): void => {
        const [number, back] = [renamed[vertex], order.length - 1 - renamed[vertex]];
        explicit.push(...(back < FAR ? [back] : [FAR, ...two(number)]));
        remember(number);
    };
    const lowCode = (vertex: number): number => {
        if (renamed[vertex] < 0) return 0;
        return vertices.indexOf(renamed[vertex]) + 1 || EXPLICIT;
    };
    for (let step = 0, start = 0; step < faces.length / 3; step++) {
        let best: { cost: number; place: number; face: number; third: number } | null = null;
        edges.forEach(([a, b], place) => {
            for (const [face, third] of beyond.get(key(order[a], order[b])) ?? []) {
                if (done[face]) continue;
                const low = lowCode(third);
                const cost = low === EXPLICIT ? 2 : low === 0 ? 1 : 0;
                if (!best || cost < best.cost) best = { cost, place, face, third };
            }
        });
        let [face, corners] = [0, [0, 0, 0] as [number, number, number]];
        const found = best as { place: number; face: number; third: number } | null;
        if (found) {
            const { place, third } = found;
            const [[a, b], low] = [edges[place], lowCode(third)];
            codes.push((place << 4) | low);
            if (low === 0) addNew(third);
            else if (low === EXPLICIT) refer(third);
            face = found.face;
            corners = [b, renamed[third], a];
        } else {
            while (done[start]) start++;
            face = start;
            const olds = [...faces.subarray(3 * face, 3 * face + 3)];
            let low = 0;
            olds.forEach((vertex, bit) => {
                const known = renamed[vertex] >= 0;
                low |= Number(known) << bit;
                (known ? refer : addNew)(vertex);
            });
            codes.push((NO_EDGE << 4) | low);
            corners = olds.map((vertex) => renamed[vertex]) as [number, number, number];
        }
        done[face] = 1;
        const [a, b, c] = corners;
        edges = [[c, b], [b, a], ...edges.slice(0, EDGES - 2)] as [number, number][];
    }
    // vertices that no face uses come last
    for (let vertex = 0; vertex < count; vertex++) if (renamed[vertex] < 0) order.push(vertex);
    return result;
}

function bytesOfBits(bits: string): number[] {
    return Array.from({ length: Math.ceil(bits.length / 8) }, (_, at) =>
        Number.parseInt(bits.slice(8 * at, 8 * at + 8).padEnd(8, "0"), 2),
    );
}

function bitLength(value: number): number {
    return value > 0 ? 32 - Math.clz32(value) : 0;
}

function two(value: number): number[] {
    return [value >> 8, value & 255];
}

function three(value: number): number[] {
    return [value >> 16, (value >> 8) & 255, value & 255];
}
