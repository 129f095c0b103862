// Which points, edges and parts of triangles are the same: what src/shackled/scene/_mesh.py and NumPy's `unique` find.

/** The number of each row of a table, from 0 in the order of their first rows, and the places of these. */
export interface Numbered {
    numbers: Uint32Array;
    firsts: Uint32Array;
}

const FREE = -1;

/** Give equal rows of `width` numbers, none of which is -0, the same number. */
export function numbered(rows: Float64Array, width: number): Numbered {
    const words = new Uint32Array(rows.buffer, rows.byteOffset, 2 * rows.length);
    const [count, size] = [rows.length / width, 2 * width];
    const numbers = new Uint32Array(count);
    const firsts = new Uint32Array(count);
    const table = new Int32Array(2 ** (33 - Math.clz32(count))).fill(FREE);
    let found = 0;
    for (let row = 0; row < count; row++) {
        const begin = row * size;
        let hash = 0;
        for (let word = begin; word < begin + size; word++) hash = mixed(hash, words[word]);
        let slot = Math.imul(hash, 0x85ebca6b) >>> Math.clz32(table.length - 1);
        for (; table[slot] !== FREE; slot = (slot + 1) & (table.length - 1)) {
            const other = firsts[table[slot]] * size;
            let word = 0;
            while (word < size && words[other + word] === words[begin + word]) word++;
            if (word === size) break;
        }
        if (table[slot] === FREE) {
            firsts[found] = row;
            table[slot] = found++;
        }
        numbers[row] = table[slot];
    }
    return { numbers, firsts: firsts.slice(0, found) };
}

/** Return the number of the point of each vertex: vertices at one place are one point. */
export function pointsOf(positions: Float64Array): Numbered {
    // + 0: no -0
    const points = positions.map((x) => x + 0);
    return numbered(points, 3);
}

/** Return rows of a table. */
export function rowsOf<T extends Float64Array | Uint8Array | Uint32Array>(table: T, rows: Uint32Array, width = 3): T {
    const found = new (table.constructor as new (size: number) => T)(width * rows.length);
    for (let row = 0, at = 0; row < rows.length; row++) {
        for (let from = width * rows[row], end = from + width; from < end;) found[at++] = table[from++];
    }
    return found;
}

/** Return the faces of several meshes, whose vertices are numbered one mesh after the other. */
export function facesOfAll(meshes: readonly { positions: Float64Array; faces: Uint32Array }[]): Uint32Array {
    const all = new Uint32Array(meshes.reduce((sum, { faces }) => sum + faces.length, 0));
    let [at, begin] = [0, 0];
    for (const { positions, faces } of meshes) {
        for (const vertex of faces) all[at++] = begin + vertex;
        begin += positions.length / 3;
    }
    return all;
}

/** Return tables of `count` rows as one, whose rows, of `width` numbers, are theirs one after the other. */
export function beside(
    tables: readonly (Float64Array | Uint8Array | undefined)[],
    count: number,
): { rows: Float64Array; width: number } {
    const given = tables.filter((table) => table !== undefined);
    const width = given.reduce((sum, table) => sum + table.length / count, 0);
    const rows = new Float64Array(width * count);
    let column = 0;
    for (const table of given) {
        const own = table.length / count;
        // + 0: no -0
        for (let row = 0, from = 0, to = column; row < count; row++, to += width - own) {
            for (let at = 0; at < own; at++) rows[to++] = table[from++] + 0;
        }
        column += own;
    }
    return { rows, width };
}

/** The edge of each side of the faces, -1 for one without a length; the sides follow each other: a to b, b to c, c to a. */
export interface Edges {
    edges: Int32Array;
    count: number;
}

/** Give sides with the same two ends, in any order, the same number. corners: three for each face. */
export function edgesOf(corners: Uint32Array): Edges {
    const ends = new Float64Array(2 * corners.length);
    corners.forEach((begin, side) => {
        const end = corners[next(side)];
        ends[2 * side] = Math.min(begin, end);
        ends[2 * side + 1] = Math.max(begin, end);
    });
    const { numbers, firsts } = numbered(ends, 2);
    const edges = Int32Array.from(numbers, (edge, side) => (ends[2 * side] === ends[2 * side + 1] ? -1 : edge));
    return { edges, count: firsts.length };
}

/** Return whether each edge is as often a side in one direction as in the other. corners: three points of each face. */
export function isBalanced(corners: Uint32Array): boolean {
    return balances(corners, edgesOf(corners)).every((balance) => balance === 0);
}

/** Return how much more often each edge is a side in one direction than in the other. */
export function balances(corners: Uint32Array, { edges, count }: Edges): Int32Array {
    const found = new Int32Array(count);
    for (let side = 0; side < corners.length; side++) {
        if (edges[side] >= 0) found[edges[side]] += corners[side] < corners[next(side)] ? 1 : -1;
    }
    return found;
}

/** Return the corner at the end of a side, whose number is that of the corner where it begins. */
export function next(side: number): number {
    return side % 3 === 2 ? side - 2 : side + 1;
}

/** Things that are joined to parts; a part has the least of their numbers. */
export class Parts {
    readonly #parents: Uint32Array;

    constructor(count: number) {
        this.#parents = Uint32Array.from({ length: count }, (_, index) => index);
    }

    of(thing: number): number {
        const parents = this.#parents;
        while (parents[thing] !== thing) {
            parents[thing] = parents[parents[thing]];
            thing = parents[thing];
        }
        return thing;
    }

    join(one: number, other: number): void {
        const [a, b] = [this.of(one), this.of(other)];
        this.#parents[Math.max(a, b)] = Math.min(a, b);
    }
}

function mixed(hash: number, word: number): number {
    const product = Math.imul(hash ^ word, 0x9e3779b1);
    return product ^ (product >>> 15);
}
