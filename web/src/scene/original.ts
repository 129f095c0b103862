// Scenes of the original Shackled contracts. src/shackled/scene/_files/original.py says what of them is exact.

import { InputError } from "../errors.js";
import { clamped, dot, largest, rint, type Vector } from "./arithmetic.js";
import { MAX_SIDE } from "./fields.js";
import * as check from "./checks.js";
import { Table } from "./table.js";
import type * as given from "./types.js";

/** Half of what the original's orthographic camera spans, in world units for each pixel of the canvas. */
const ORTHOGRAPHIC_UNITS = 500;

/** Return whether a document is a scene of the original. */
export function isOriginal(document: unknown): document is object {
    return typeof document === "object" && document !== null && "canvasDim" in document;
}

/** Return the scene of the original's JSON, whose parameters stand at the top level or under `renderParams`. */
export function originalScene(document: object): given.Scene {
    const parameters = new Table(document, "").table("renderParams").values;
    const keys = new Table({ ...parameters, ...document }, "");
    for (const key of ["verts", "faces"]) if (!keys.has(key)) throw new InputError(`${key} is missing`);
    const side = check.whole(keys.get("canvasDim"), "canvasDim", 1, MAX_SIDE);
    const { material, lights } = lightOf(keys.table("lightingParams"));
    const scale = keys.number("objScale") ?? 1;
    const mesh = meshOf(keys, scale < 0 ? -1 : 1);
    const object = {
        position: keys.read("objPosition", check.vector),
        rotation: keys.read("rotation", check.vector),
        scale: Math.abs(scale),
        material,
        cull: keys.read("backfaceCulling", check.flag),
        wireframe: keys.read("wireframe", check.flag),
    };
    const isOrthographic = keys.read("perspCamera", check.flag) === false;
    return {
        objects: mesh ? [{ mesh, ...object }] : [],
        camera: isOrthographic ? { projection: "orthographic", halfHeight: ORTHOGRAPHIC_UNITS * side } : {},
        lights,
        background: backgroundOf(keys),
        invert: keys.read("invert", check.flag),
        width: side,
        height: side,
    };
}

/** Return the mesh, its positions times `sign`; undefined without faces. */
function meshOf(keys: Table, sign: number): given.Mesh | undefined {
    const [positions, faces] = [keys.rows("verts"), keys.rows("faces")];
    if (!faces.length) return undefined;
    const mesh = { positions: positions.map((row) => row.map((x) => sign * x)), faces };
    if (!keys.has("cols")) return mesh;
    const colors = keys.rows("cols");
    const last = faces.reduce((most, face) => Math.max(most, ...face), 0);
    if (positions.length > last && last >= colors.length) {
        throw new InputError(`cols has ${colors.length} colours, but a face uses vertex ${last}, which needs one`);
    }
    return { ...mesh, colors: positions.map((_, index): Vector => colors[index] ?? [0, 0, 0]) };
}

function lightOf(lighting: Table): { material: given.Material; lights: given.Light[] } {
    if (lighting.read("applyLighting", check.flag) !== true) return { material: { shading: "unlit" }, lights: [] };
    const direction = lighting.read("lightPos", check.vector) ?? [0, 0, 0];
    const square = dot(direction, direction);
    if (square === 0) {
        throw new InputError(
            `${lighting.place("lightPos")} must not be the origin: it is the direction toward the light`,
        );
    }
    const [diffuseColor, specularColor] = [lightColor(lighting, "lightColDiff"), lightColor(lighting, "lightColSpec")];
    const diffuse = (lighting.number("lightDiffPower") ?? 0) / square;
    const specular = (lighting.number("lightSpecPower") ?? 0) / square;
    // one light has one colour: that of the highlight where there is one
    const color = specular > 0 && largest(specularColor) > 0 ? specularColor : diffuseColor;
    const most = largest(color);
    const hue: Vector = most > 0 ? (color.map((x) => rint((x * 255) / most)) as Vector) : [255, 255, 255];
    const material = {
        shading: "flat",
        ambient: 1,
        diffuse: clamped(diffuse * (mean(diffuseColor) / mean(hue)), 0, 4),
        specular: clamped(specular * (largest(specularColor) / 255), 0, 4),
        shininess: rint(clamped(lighting.number("inverseShininess") ?? 1, 1, 128)),
    } as const;
    return { material, lights: [{ kind: "directional", direction, color: hue }] };
}

/** Return red, green and blue, of any size: the original's powers may be in them. */
function lightColor(lighting: Table, key: string): Vector {
    const color = lighting.read(key, check.vector) ?? [255, 255, 255];
    if (color.every((x) => x >= 0)) return color;
    throw new InputError(`${lighting.place(key)} must not be negative`);
}

function mean([x, y, z]: Vector): number {
    return (x + y + z) / 3;
}

function backgroundOf(keys: Table): given.Background {
    if (!keys.has("backgroundColor")) return {};
    const [top, bottom, ...more] = keys.rows("backgroundColor");
    if (top && bottom && !more.length) return { top, bottom };
    throw new InputError("backgroundColor must be two colours, the top one and the bottom one");
}
