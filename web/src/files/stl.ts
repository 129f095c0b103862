// STL by three.js, with the colours that VisCAM, SolidView and Materialise Magics keep in binary files.

import { STLLoader } from "three/examples/jsm/loaders/STLLoader.js";
import { InputError } from "../errors.js";
import { STL_FACET as FACET, STL_HEADER as HEADER } from "./kinds.js";
import { GREY, PLAIN, type Triangles } from "./parts.js";
import { plural, textOf, withPoints, type Source } from "./source.js";

/** Bytes at random make coordinates that are mostly beyond this, or no numbers. */
const PLAUSIBLE = 1e15;

/** Return the triangles of an STL file, in light grey unless its facets have colours. */
export function readStl(source: Source): Triangles {
    const { bytes, tell } = source;
    const end = bytes.findLastIndex((byte) => byte) + 1;
    const isText = !bytes.subarray(0, end).includes(0);
    const body = bytes.length - HEADER;
    // many a writer leaves out the count, or the attribute of the last facet
    let count = Math.floor((body + 2) / FACET);
    const declared = isText || body < 0 ? 0 : new DataView(bytes.buffer, bytes.byteOffset).getUint32(HEADER - 4, true);
    if (declared > 0 && declared < count && (body - declared * FACET) % FACET) count = declared;
    let data: string | ArrayBuffer;
    if (isText) {
        let lost = 0;
        // names may be of any words
        const names = /^[ \t]*(end)?solid\b(?:(?!\bfacet[ \t]+normal\b).)*/gim;
        const text = textOf(bytes).replace(names, (_, end) => `${end ?? ""}solid `);
        data = withPoints(text, source).replace(/\bfacet\b[\s\S]*?endfacet/gi, (facet) =>
            /\b(nan|inf)|1\.#/i.test(facet) && ++lost ? "" : facet,
        );
        if (!/\bfacet\b/i.test(data))
            throw new InputError(lost ? "none of its facets has finite coordinates" : "it has no triangles");
        if (lost) tell(`facets with coordinates that are not finite numbers are left out: ${lost}`);
    } else {
        if (count < 1)
            throw new InputError(
                `it is not text, and with ${plural(bytes.length, "byte")} too short for a triangle of binary STL`,
            );
        const whole = new Uint8Array(HEADER + FACET * count);
        whole.set(bytes.subarray(0, whole.length));
        new DataView(whole.buffer).setUint32(HEADER - 4, count, true);
        data = whole.buffer;
    }
    const positions = Float64Array.from(new STLLoader().parse(data).attributes.position.array);
    if (isText && positions.length % 9) throw new InputError("it has a facet without three vertices");
    if (!isText && declared !== count) {
        const isPlausible = (_: number, facet: number): boolean =>
            positions.subarray(9 * facet, 9 * facet + 9).every((x) => Math.abs(x) < PLAUSIBLE);
        if (positions.subarray(0, count).filter(isPlausible).length < count / 2)
            throw new InputError("it is neither text nor binary STL");
        tell(`its header says ${plural(declared, "facet")}; there are ${count.toLocaleString("en")}, which are read`);
    }
    if (!isText && body > count * FACET)
        tell(`what is behind its facets is left out: ${plural(body - count * FACET, "byte")}`);
    const faces = Uint32Array.from({ length: positions.length / 3 }, (_, corner) => corner);
    const colorOf = isText ? () => [...GREY, 255] : colorsOf(source, count);
    const colors = new Uint8Array(4 * faces.length);
    for (const corner of faces) colors.set(colorOf(Math.floor(corner / 3)), 4 * corner);
    return { positions, faces, colors, surfaces: [PLAIN] };
}

/**
 * Return the function of the colours of facets, with alpha. An attribute has five bits for each of red, green and blue. Its
 * highest bit says in Magics that the facet has the colour of the header, in the other programs that it has one of its own.
 * Many programs write the colour of the header only, and 0 as all attributes.
 */
function colorsOf({ bytes, tell }: Source, count: number): (facet: number) => number[] {
    const attributes = Uint16Array.from({ length: count }, (_, facet) => {
        const at = HEADER + FACET * facet + FACET - 2;
        return (bytes[at] ?? 0) | ((bytes[at + 1] ?? 0) << 8);
    });
    const at = new TextDecoder("latin1").decode(bytes.subarray(0, HEADER - 8)).indexOf("COLOR=") + 6;
    const isMagics = at >= 6;
    const whole = isMagics ? [...bytes.subarray(at, at + 4)] : [...GREY, 255];
    if (whole[3] === 0 || whole[3] === 32) whole[3] = 255; // of writers without transparency
    const any = attributes.some((each) => each > 0);
    const unknown = isMagics ? 0 : attributes.filter((each) => each > 0 && each < 1 << 15).length;
    if (unknown) tell(`attributes of facets that are no colours are left out: ${unknown}`);
    return (facet) => {
        const isMarked = attributes[facet] >= 1 << 15;
        if (isMagics ? isMarked || !any : !isMarked) return whole;
        const levels = [10, 5, 0].map((shift) => Math.round(((attributes[facet] >> shift) & 31) * (255 / 31)));
        return [...(isMagics ? levels.reverse() : levels), 255];
    };
}
