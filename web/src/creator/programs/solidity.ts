// A picture as a contract in Solidity, which holds the scene and calls the renderer with it.

import { toHex } from "../../bytes.js";
import { PROJECTIONS, SHADINGS } from "../../scene/fields.js";
import { WORD } from "../../scene/encode.js";
import { OBJECT_WORDS, Reader } from "../../scene/reader.js";
import { capital } from "../../document/fields.js";
import { linkLines, notices, oneLine, originOf, stemOf, titleOf, type Subject } from "./subject.js";

/** Bytes of meshes and extensions that a contract holds beside its code (EIP-170: 24,576), and what each object adds. */
const MAX_CONSTANT = 18_000;
const PER_OBJECT = 400;
/** Hexadecimal digits of a string literal on one line. */
const DIGITS = 120;
/** Of the contract without meshes. */
const OWN = "MIT";
/** SPDX identifiers of permissive licences, by the names that sources of meshes use. */
const FREE: Record<string, string> = { MIT: "MIT", CC0: "CC0-1.0", "CC0-1.0": "CC0-1.0" };
const UNLICENSED = "UNLICENSED";
const KINDS = ["directional", "point or spot"];
const IMPORTED = ["Background", "Camera", "Canvas", "Fixed", "IRenderer", "Light", "Material", "Object", "Picture"];
const TAKEN = [...IMPORTED, "Quaternion", "Scene", "Vector"];

/**
 * Return a source that compiles with the npm package "shackled-contracts".
 *
 * Meshes and extensions that do not fit into a contract become parameters. most: the bytes that fit.
 */
export function solidityProgram(subject: Subject, most = MAX_CONSTANT): string {
    const { doc, scene, call } = subject;
    const read = readScene(call);
    const size = read.objects.reduce((sum, { mesh }) => sum + mesh.length, read.extensions.length);
    const inside = size + PER_OBJECT * read.objects.length <= most;
    const kinds = inside
        ? []
        : ["bytes[] calldata meshes", ...(read.extensions.length ? ["bytes calldata extensions"] : [])];
    const names = kinds.map((kind) => kind.split(" ").at(-1)).join(", ");
    // a ground, the last object, is no object of the document, and nobody's work
    const origins = read.objects.map((_, index) => doc.objects[index] && originOf(subject, doc.objects[index]));
    // what others wrote stands in plain comments, since an @ has a meaning in the others
    const notes = [...notices(subject), ...linkLines(subject.link)].map((line) => `// ${line}`);
    const about = [
        `@notice ${read.words[0]} x ${read.words[1]} pixels, ${count(subject.triangles)} triangles, ${count(subject.gas)} gas.`,
        ...(subject.sha256 ? [`SHA-256 of the pixels: ${subject.sha256}`] : []),
        ...(inside ? [] : [`@dev The caller passes ${names}, of ${count(size)} bytes, too many for a contract.`]),
    ].map((line) => `/// ${line}`);
    const parameters = kinds.join(", ");
    const licences = scene.objects.map((_, index) => licenceLines(origins[index]));
    const body = bodyOf(read, inside, licences);
    return `\
// SPDX-License-Identifier: ${inside ? spdxOf(origins.flatMap((origin) => (origin ? [origin.licence] : []))) : OWN}
pragma solidity ^0.8.25;

import {IRenderer} from "shackled-contracts/interfaces/IRenderer.sol";
import {Fixed} from "shackled-contracts/math/Fixed.sol";
import {Quaternion} from "shackled-contracts/math/Quaternion.sol";
import {Vector} from "shackled-contracts/math/Vector.sol";
import {Background, Camera, Canvas, Light, Material, Object, Scene} from "shackled-contracts/scene/Scene.sol";

${[...notes, ...about].join("\n")}
contract ${contractName(stemOf(titleOf(doc)))} {
    IRenderer public immutable renderer;

    constructor(IRenderer renderer_) {
        renderer = renderer_;
    }

    /// @notice An SVG that shows the picture at any size, for web pages. Marketplaces that resize pictures show it
    /// empty: for a token, let PngEncoder or Studio make a PNG of \`scene\`.
    function svg(${parameters}) external view returns (string memory) {
        return renderer.renderSVG(scene(${names}));
    }

    /// @notice A bitmap of 24 bits a pixel.
    function bitmap(${parameters}) external view returns (bytes memory) {
        return renderer.render(scene(${names}));
    }

    /// @notice Lengths are Q32 fixed-point numbers: value * 2^32.
    function scene(${parameters}) public pure returns (Scene memory s) {
${body.map((line) => (line ? `        ${line}` : "")).join("\n")}
    }

    function fixed_(int256 raw) private pure returns (Fixed) {
        return Fixed.wrap(raw);
    }

    function vector(int256 x, int256 y, int256 z) private pure returns (Vector memory) {
        return Vector(Fixed.wrap(x), Fixed.wrap(y), Fixed.wrap(z));
    }
}
`;
}

/** Return the SPDX expression of the licences of meshes; UNLICENSED if one of them is unknown. */
export function spdxOf(licences: readonly string[]): string {
    const names = licences.map((licence) => {
        const name = licence
            .replace(/[^0-9A-Za-z.]+/g, "-")
            .slice(0, 60)
            .replace(/^[-.]+|[-.]+$/g, "");
        return FREE[licence] ?? (name ? `LicenseRef-${name}` : UNLICENSED);
    });
    if (names.includes(UNLICENSED)) return UNLICENSED;
    return [...new Set(names)].sort().join(" AND ") || OWN;
}

/** Return a name for Solidity: "icons-coin" becomes IconsCoin. */
export function contractName(stem: string): string {
    const name = stem.split("-").map(capital).join("");
    return /^[A-Z]/.test(name) && !TAKEN.includes(name) ? name : `Picture${name}`;
}

/** Return the comments beside a mesh: of whom it is, and its licence. */
function licenceLines(origin: { notice: string; licence: string } | undefined): string[] {
    if (!origin) return [];
    if (origin.licence) return [oneLine(origin.notice || `The licence of this mesh: ${origin.licence}`)];
    return [
        "The licence of this mesh is unknown: it is that of the file that was opened.",
        "Put its identifier into the first line, and do not publish the mesh without permission.",
    ];
}

/** The parts of a scene, as words of 32 bytes and as bytes. */
interface Read {
    words: bigint[];
    lights: bigint[][];
    objects: { mesh: Uint8Array; words: bigint[] }[];
    extensions: Uint8Array;
}

/** Read a call that `encode` made. */
function readScene(call: Uint8Array): Read {
    const reader = new Reader(call);
    const words = (place: number, count: number): bigint[] =>
        Array.from({ length: count }, (_, at) => reader.view.getBigInt64(place + WORD * (at + 1) - 8));
    const bytes = (place: number, size: number): Uint8Array => call.subarray(place, place + size);
    return {
        words: words(reader.field(0), 18),
        lights: reader.lights().map((place) => words(place, 5)),
        objects: reader.objects().map(({ place, mesh, size }) => ({
            mesh: bytes(mesh, size),
            words: words(place + WORD, OBJECT_WORDS - 1),
        })),
        extensions: bytes(...reader.array(reader.field(20), reader.field(0), 1)),
    };
}

/** Return the lines that make a scene. notes: comments for each mesh. */
function bodyOf({ words, lights, objects, extensions }: Read, inside: boolean, notes: readonly string[][]): string[] {
    const lines = [
        `s.canvas = Canvas(${words[0]}, ${words[1]});`,
        "s.camera = Camera({",
        `    eye: ${vector(words, 2)},`,
        `    target: ${vector(words, 5)},`,
        `    up: ${vector(words, 8)},`,
        `    projection: ${words[11]}, // ${PROJECTIONS[Number(words[11])]}`,
        `    halfHeight: fixed_(${words[12]}),`,
        `    near: fixed_(${words[13]})`,
        "});",
        `s.background = Background(${color(words[14])}, ${color(words[15])});`,
        ...(words[16] ? ["s.invert = 1;"] : []),
        `s.ambientLight = ${color(words[17])};`,
        "",
        `s.lights = new Light[](${lights.length});`,
        ...lights.map(
            (w, i) => `s.lights[${i}] = Light(${w[0]}, ${vector(w, 1)}, ${color(w[4])}); // ${KINDS[Number(w[0])]}`,
        ),
        "",
        `s.objects = new Object[](${objects.length});`,
    ];
    objects.forEach(({ mesh, words: w }, i) => {
        const literal = ["    mesh: bytes.concat(", ...hexLines(mesh), "    ),"];
        lines.push(
            `s.objects[${i}] = Object({`,
            ...(inside
                ? [...(notes[i] ?? []).map((line) => `    // ${line}`), ...literal]
                : [`    mesh: meshes[${i}],`]),
            `    position: ${vector(w, 0)},`,
            `    rotation: Quaternion(${w
                .slice(3, 7)
                .map((each) => `fixed_(${each})`)
                .join(", ")}),`,
            `    scale: fixed_(${w[7]}),`,
            "    material: Material({",
            `        shading: ${w[8]}, // ${SHADINGS[Number(w[8])]}`,
            `        ambient: fixed_(${w[9]}),`,
            `        diffuse: fixed_(${w[10]}),`,
            `        specular: fixed_(${w[11]}),`,
            `        shininess: ${w[12]}`,
            "    }),",
            `    flags: ${w[13]}`,
            "});",
        );
    });
    if (!extensions.length) return lines;
    const value = inside ? ["bytes.concat(", ...hexLines(extensions), ");"] : ["extensions;"];
    return [
        ...lines,
        "",
        "// what the structs do not hold: see Extensions.sol",
        `s.extensions = ${value[0]}`,
        ...value.slice(1),
    ];
}

/** Return bytes as literals, which the compiler concatenates. */
function hexLines(bytes: Uint8Array): string[] {
    return (toHex(bytes, "").match(new RegExp(`.{1,${DIGITS}}`, "g")) ?? [""]).map((line) => `        hex"${line}"`);
}

function vector(words: readonly bigint[], from: number): string {
    return `vector(${words.slice(from, from + 3).join(", ")})`;
}

function color(word: bigint | undefined): string {
    return `0x${(word ?? 0n).toString(16).padStart(6, "0")}`;
}

function count(value: number): string {
    return value.toLocaleString("en");
}
