// OFF, the Object File Format of Geomview, as text, with colours and normals.

import { InputError } from "../errors.js";
import { GREY, PLAIN, ofCorners, toByte, type Triangles } from "./parts.js";
import { cut } from "./polygons.js";
import { numberOf, textOf, withPoints, type Source } from "./source.js";

/** Return the triangles of an OFF file, whose header may have the letters ST, C and N in any order. */
export function readOff(source: Source): Triangles {
    const { bytes, tell } = source;
    if (/^\s*\w*OFF[ \t]+BINARY/.test(String.fromCharCode(...bytes.subarray(0, 99))))
        throw new InputError("it is binary; only text is read");
    const lines: [number, string[]][] = [];
    withPoints(textOf(bytes), source)
        .split("\n")
        .forEach((line, number) => {
            const words = line.replace(/#.*/, "").trim().split(/\s+/);
            if (words[0]) lines.push([number + 1, words]);
        });
    const header = /^((?:ST|C|N)*)OFF(\d*)$/.exec(lines[0]?.[1][0] ?? "");
    if (!header)
        throw new InputError(
            "an OFF file of three dimensions begins with OFF, or with C, N or ST before it, as in COFF or NOFF",
        );
    // the counts may follow at once
    lines[0][1].splice(0, 1, ...(header[2] ? [header[2]] : []));
    if (!lines[0][1].length) lines.shift();
    let at = 0;
    const next = (fits: (row: number[]) => boolean, what: string): number[] => {
        if (at >= lines.length) throw new InputError(`it ends before ${what}`);
        const [number, words] = lines[at++];
        const row = words.map(numberOf);
        if (!row.includes(undefined) && fits(row as number[])) return row as number[];
        throw new InputError(`line ${number} should hold ${what}, not '${words.join(" ").slice(0, 60)}'`);
    };
    const [hasNormals, hasUvs] = [header[1].includes("N"), header[1].includes("ST")];
    const least = 3 + (hasNormals ? 3 : 0) + (hasUvs ? 2 : 0);
    const areCounts = (row: number[]): boolean =>
        row.length > 1 && row.every((count) => Number.isInteger(count) && count >= 0);
    const counts = next(areCounts, "the counts of vertices and faces");
    const [vertices, polygons]: number[][][] = [[], []];
    while (vertices.length < counts[0])
        vertices.push(next(({ length }) => length >= least, `the ${least} numbers of a vertex`));
    const isFace = (row: number[]): boolean =>
        row[0] > 0 && row.length > row[0] && row.slice(0, 1 + row[0]).every(Number.isInteger);
    while (polygons.length < counts[1]) polygons.push(next(isFace, "the vertices of a face"));
    if (at < lines.length) tell(`the lines behind its faces are left out: ${(lines.length - at).toLocaleString("en")}`);
    if (hasUvs) tell("its texture coordinates are left out, for an OFF file names no texture");
    const positions = Float64Array.from(vertices.flatMap((row) => row.slice(0, 3)));
    const sizes = polygons.map(([size]) => size);
    const corners = polygons.flatMap((row) => row.slice(1, 1 + row[0]));
    const { faces, polygon } = cut(positions, sizes, corners);
    // in Geomview's CNOFF the normal comes before the colour, in MeshLab's NCOFF behind it
    const isLast = header[1].indexOf("N") < header[1].indexOf("C");
    const behind = vertices.map((row) => row.slice(3, hasUvs ? -2 : undefined));
    const normals = hasNormals ? behind.flatMap((row) => row.splice(isLast ? -3 : 0, 3)) : undefined;
    const behindFaces = polygons.map((row) => row.slice(1 + row[0]));
    const [ofVertices, ofFaces] = [colorsOf(behind, "vertices", tell), colorsOf(behindFaces, "faces", tell)];
    const colors = new Uint8Array(4 * faces.length);
    faces.forEach((vertex, corner) =>
        colors.set(ofFaces[polygon[Math.floor(corner / 3)]] ?? ofVertices[vertex] ?? [...GREY, 255], 4 * corner),
    );
    return {
        positions,
        faces,
        colors,
        normals: normals && ofCorners(normals, 3, faces, "normals", source),
        surfaces: [PLAIN],
    };
}

/** Return colours with alpha, as bytes; undefined for rows that are not of three or four numbers. */
function colorsOf(rows: number[][], what: string, tell: Source["tell"]): (number[] | undefined)[] {
    const given = rows.filter(({ length }) => length === 3 || length === 4);
    const largest = given.every((row) => row.every((level) => level <= 1)) ? 1 : 255;
    const hasAlpha = given.some((row) => row[3] > 0); // writers without transparency leave 0
    const unknown = rows.filter((row) => row.length).length - given.length;
    if (unknown) tell(`numbers behind ${what} that are no colours are left out: ${unknown.toLocaleString("en")}`);
    return rows.map((row) => {
        if (row.length !== 3 && row.length !== 4) return undefined;
        const [red, green, blue, alpha = 255] = row.map((level) => toByte(level, largest));
        return [red, green, blue, hasAlpha ? alpha : 255];
    });
}
