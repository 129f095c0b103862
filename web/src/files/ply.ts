// PLY, the Stanford polygon format. PLYLoader of three.js loses polygons of more than four corners, alpha and dark colours.

import { InputError } from "../errors.js";
import { pictureBeside } from "./images.js";
import { GREY, PLAIN, ofCorners, toByte, type Triangles } from "./parts.js";
import { cut } from "./polygons.js";
import { numberOf, plural, textOf, withPoints, type Source } from "./source.js";

const SIZES = { Int8: 1, Uint8: 1, Int16: 2, Uint16: 2, Int32: 4, Uint32: 4, Float32: 4, Float64: 8 };
type Kind = keyof typeof SIZES;
const KINDS: Record<string, Kind | undefined> = {
    ...{ char: "Int8", uchar: "Uint8", short: "Int16", ushort: "Uint16", int: "Int32", uint: "Uint32" },
    ...{ int8: "Int8", uint8: "Uint8", int16: "Int16", uint16: "Uint16", int32: "Int32", uint32: "Uint32" },
    ...{ float: "Float32", double: "Float64", float32: "Float32", float64: "Float64" },
};
/** Names of colours, and of texture coordinates, which go to the right and up. */
const COLORS = ["red green blue alpha", "red green blue", "diffuse_red diffuse_green diffuse_blue", "r g b a", "r g b"];
const COORDINATES = ["s t", "u v", "texture_u texture_v"];

/** values: of all rows; of lists one after the other, of so many each as sizes tell. length: the kind of these. */
interface Property {
    name: string;
    kind: Kind;
    length: Kind | undefined;
    values: number[];
    sizes: number[];
}

class Element {
    readonly properties: Property[] = [];
    readonly used = new Set<string>();

    constructor(
        readonly name: string,
        public count: number,
    ) {}

    /** Leave out all rows from one on. */
    cutAt(row: number): void {
        this.count = row;
        for (const each of this.properties) {
            each.sizes = each.sizes.slice(0, row);
            each.values = each.values.slice(0, each.length ? each.sizes.reduce((sum, size) => sum + size, 0) : row);
        }
    }

    /** Return the properties of the first names of which none is missing; they are lists, or not. */
    find(names: readonly string[], areLists = false): Property[] | undefined {
        for (const each of names.map((words) => words.split(" "))) {
            const found = this.properties.filter(({ name, length }) => each.includes(name) && !length !== areLists);
            if (found.length < each.length) continue;
            for (const { name } of found) this.used.add(name);
            return each.map((name) => found.find((property) => property.name === name) as Property);
        }
        return undefined;
    }

    /** Return the values of properties, those of a row side by side. */
    table(...names: string[]): Float64Array | undefined {
        const found = this.find(names);
        const width = found?.length ?? 0;
        if (!found) return undefined;
        const value = (_: unknown, at: number): number => found[at % width].values[Math.floor(at / width)];
        return Float64Array.from({ length: width * this.count }, value);
    }

    /** Return four bytes for each row; undefined if there are no colours. */
    colors(): Uint8Array | undefined {
        const found = this.count ? this.find(COLORS) : undefined;
        const areOne = found?.every(
            ({ kind, values }) => kind.startsWith("Float") && values.every((level) => level <= 1),
        );
        const colors = new Uint8Array(4 * this.count).fill(255);
        found?.forEach(({ kind, values }, channel) => {
            const largest = areOne ? 1 : kind === "Uint16" ? 65535 : 255;
            values.forEach((level, row) => (colors[4 * row + channel] = toByte(level, largest)));
        });
        return found && colors;
    }
}

/** Return the triangles of a PLY file, which has a texture at most. */
export async function readPly(source: Source): Promise<Triangles> {
    const { tell } = source;
    const { elements, textures } = elementsOf(source);
    const [vertex, face] = ["vertex", "face"].map(
        (name) => elements.find((each) => each.name === name) ?? new Element(name, 0),
    );
    const positions = vertex.table("x y z");
    const lists = face.find(["vertex_indices", "vertex_index"], true);
    if (!positions || !lists || !face.count) {
        const has = elements.map(({ name, count }) => `${count.toLocaleString("en")} of ${name}`).join(", ") || "none";
        throw new InputError(
            `a mesh needs elements vertex with x, y and z, and elements face with a list vertex_indices; this file has ${has}`,
        );
    }
    const [{ sizes, values }] = lists;
    const { faces, corners, polygon } = cut(positions, sizes, values);
    const [ofFaces, ofVertices, normals] = [face.colors(), vertex.colors(), vertex.table("nx ny nz")];
    // of faces, unless all have the same one beside colours of vertices
    const areFaces = ofFaces && (!ofVertices || ofFaces.some((level, at) => level !== ofFaces[at % 4]));
    if (areFaces && ofVertices) tell("the colours of its vertices are left out, for its faces have colours");
    const colors = new Uint8Array(4 * faces.length);
    faces.forEach((number, corner) => {
        const row = 4 * (areFaces ? polygon[Math.floor(corner / 3)] : number);
        colors.set((areFaces ? ofFaces : ofVertices)?.subarray(row, row + 4) ?? [...GREY, 255], 4 * corner);
    });
    const found: Triangles = { positions, faces, colors, surfaces: [PLAIN] };
    if (normals) found.normals = ofCorners(normals, 3, faces, "normals", source);
    if (textures.length) {
        const list = face.find(["texcoord"], true)?.[0].values;
        const isWhole = list?.length === 2 * values.length;
        const places = isWhole ? list : vertex.table(...COORDINATES);
        const picture = places && (await pictureBeside(source, textures[0]));
        if (!places) tell("its texture is left out, for it has no texture coordinates");
        if (textures.length > 1) tell(`left out: ${plural(textures.length - 1, "texture")} but the first`);
        if (picture) {
            found.uvs = ofCorners(places, 2, isWhole ? corners : faces, "texture coordinates", source).map((x, at) =>
                at % 2 ? 1 - x : x,
            );
            found.surfaces = [{ ...PLAIN, picture }];
            colors.fill(255);
        }
    }
    const left = elements.flatMap(({ name, count, used, properties }) => {
        if (!used.size) return count ? [`${name} (${count.toLocaleString("en")})`] : [];
        return properties.filter((each) => !used.has(each.name)).map((each) => `${each.name} of ${name}`);
    });
    if (left.length) tell(`of its elements are left out: ${left.join(", ")}`);
    return found;
}

function elementsOf(source: Source): { elements: Element[]; textures: string[] } {
    const { bytes } = source;
    const start = new TextDecoder("latin1").decode(bytes.subarray(0, 1 << 16));
    const end = /end_header[ \t]*(\r\n|\n|\r)/.exec(start);
    if (!/^ply/i.test(start) || !end)
        throw new InputError("a PLY file begins with the line ply, and its header ends with the line end_header");
    const [elements, textures]: [Element[], string[]] = [[], []];
    let format = "";
    const lines = start.slice(0, end.index).split(/\r\n|\n|\r/);
    lines.forEach((line, number) => {
        const [keyword, ...words] = line.trim().split(/\s+/);
        const [kind, length] = words
            .slice(0, -1)
            .map((word) => KINDS[word])
            .reverse();
        const isRight = words.length === (words[0] === "list" ? 4 : 2) && (words[0] !== "list" || length);
        if (keyword === "format" && /^(ascii|binary_(little|big)_endian)$/.test(words[0])) format = words[0];
        else if (keyword === "element" && Number(words[1]) >= 0) elements.push(new Element(words[0], Number(words[1])));
        else if (keyword === "property" && elements.length && kind && isRight)
            elements.at(-1)?.properties.push({ name: words.at(-1) as string, kind, length, values: [], sizes: [] });
        else if (keyword === "comment" && words[0] === "TextureFile") textures.push(words.slice(1).join(" "));
        else if (!/^(ply|comment|obj_info|)$/i.test(keyword))
            throw new InputError(`line ${number + 1} of its header is none that is known: '${line.slice(0, 60)}'`);
    });
    if (!format) throw new InputError("its header has no line format");
    const body = bytes.subarray(end.index + end[0].length);
    const read =
        format === "ascii" ? words(withPoints(textOf(body), source)) : numbers(body, format.includes("little"));
    /** Read a row of an element; false where a number is missing. */
    const isRead = ({ properties }: Element): boolean =>
        properties.every(({ kind, length, values, sizes }) => {
            const size = length ? read(length) : 1;
            if (size === undefined || size < 0) return false;
            for (let each = 0; each < size; each++) {
                const value = read(kind);
                if (value === undefined) return false;
                values.push(value);
            }
            if (length) sizes.push(size);
            return true;
        });
    for (const [number, element] of elements.entries()) {
        const { name, count, properties } = element;
        let row = 0;
        while (properties.length && row < count && isRead(element)) row++;
        if (!properties.length || row === count) continue;
        element.cutAt(row);
        const found = elements.slice(0, number + 1);
        const why = `it ends, or has a word that is no number, in element ${row} of the ${count} elements ${name}`;
        // without all vertices and one face there is nothing to draw
        if (!found.some((each) => each.name === "face" && each.count)) throw new InputError(why);
        const lost = (count - row).toLocaleString("en");
        source.tell(`${lost} of its ${count.toLocaleString("en")} elements ${name} and all behind left out: ${why}`);
        return { elements: found, textures };
    }
    if (format === "ascii" && read("Int8") !== undefined)
        throw new InputError("it has more numbers than the elements of its header");
    return { elements, textures };
}

/** Return the function of the next number in bytes; undefined at their end. */
function numbers(bytes: Uint8Array, little: boolean): (kind: Kind) => number | undefined {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    let at = 0;
    return (kind) => {
        at += SIZES[kind];
        return at > bytes.length ? undefined : view[`get${kind}`](at - SIZES[kind], little);
    };
}

/** Return the function of the next number in a text; undefined at its end. */
function words(text: string): () => number | undefined {
    const word = /\S+/g;
    return () => numberOf(word.exec(text)?.[0] ?? "x");
}
