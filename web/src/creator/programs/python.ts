// A picture as a program in Python, which renders it, saves it, and fails if it is another one.

import type { Background, Light, Mesh, Rows, Scene, SceneObject } from "../../scene/types.js";
import { isSimplified, type Item } from "../../document/document.js";
import { rows as inRows } from "../../document/packed.js";
import { snake } from "../../scene/table.js";
import { linkLines, notices, stemOf, titleOf, type Subject } from "./subject.js";

/** Vertices of meshes that stand in the program itself. */
const MAX_INLINE = 64;

/** Return the program. Larger meshes of opened files come from the scene file, to be saved beside it. */
export function pythonProgram(subject: Subject): string {
    const { doc, scene, sha256 } = subject;
    const stem = stemOf(titleOf(doc));
    /** Variables, by what they are set to. */
    const sources = new Map<string, string>();
    const objects = doc.objects.map((item, index) => {
        const from = sourceOf(subject, item, index, sources);
        return objectOf(item, scene.objects[index] as SceneObject, from);
    });
    const loads = [...sources].map(([source, name]) => `${name} = ${source}`);
    return [
        ...notices(subject).map((line) => `# ${line}`),
        ...(sha256 ? ["import hashlib", ""] : []),
        "import shackled",
        "",
        ...loads,
        ...(loads.length ? [""] : []),
        "scene = shackled.Scene(",
        "    [",
        ...objects.map((lines) => `        ${lines},`),
        "    ],",
        ...Object.entries(settings(scene)).flatMap(([name, value]) => (value ? [`    ${name}=${python(value)},`] : [])),
        ")",
        "image = shackled.render(scene)",
        `image.save("${stem}.png")`,
        "print(image.gas)",
        ...(sha256 ? [`assert hashlib.sha256(image.pixels.tobytes()).hexdigest() == "${sha256}"`] : []),
        ...linkLines(subject.link).map((line) => `# ${line}`),
        "",
    ].join("\n");
}

/** Return the fields of a scene, without those that are as by default. */
function settings(scene: Scene): Record<string, unknown> {
    const { camera, lights = [], background, hemisphere, rim, fog, tone, ground } = scene;
    return {
        camera: camera && call("Camera", camera),
        lights: new Expression(`[${lights.map((light) => lightOf(light).code).join(", ")}]`),
        background: call("Background", background as Background),
        ambient_light: scene.ambientLight,
        invert: scene.invert,
        antialias: scene.antialias,
        hemisphere: hemisphere && [hemisphere.sky, hemisphere.ground ?? "#000000"],
        rim: rim && call("Rim", rim),
        fog: fog && call("Fog", fog),
        tone: tone && call("Tone", tone),
        ground: ground && call("Ground", ground),
        width: scene.width,
        height: scene.height,
    };
}

function lightOf({ shadow, ...light }: Light): Expression {
    const place = light.kind === "directional" ? "direction" : "position";
    const { [place]: vector, ...own } = light as Record<string, unknown>;
    return call("Light", { ...own, vector, shadow: shadow || undefined });
}

/** Return the object from which the mesh of an item is taken; null where it stands in the program. */
function sourceOf(
    { doc, scene, meshes }: Subject,
    item: Item,
    index: number,
    sources: Map<string, string>,
): string | null {
    const variable = (source: string, name: string): string => {
        const taken = [...sources.values(), "shackled", "hashlib", "scene", "image"];
        let free = name.replaceAll("-", "_").replace(/^(?=\d)/, "mesh_");
        while (taken.includes(free)) free += "_";
        const found = sources.get(source) ?? free;
        sources.set(source, found);
        return found;
    };
    if ("piece" in item.mesh && !isSimplified(item, meshes.get(item.mesh))) {
        const { piece, object } = item.mesh;
        const crease = item.crease === null ? "" : `, crease=${item.crease}`;
        const look = item.material.shading === "smooth" ? `, shading="smooth"${crease}` : "";
        return `${variable(`shackled.load("${piece}"${look}).objects`, stemOf(piece))}[${object}]`;
    }
    const { mesh, material } = scene.objects[index] as SceneObject;
    if (verticesOf(mesh) <= MAX_INLINE && !material?.texture) return null;
    return `${variable(`shackled.load("${stemOf(titleOf(doc))}.json").objects`, "stored")}[${index}]`;
}

/** Return an object as an expression. from: where its mesh is from, as it is or, of a piece, in another colour. */
function objectOf(item: Item, { mesh, material = {}, ...own }: SceneObject, from: string | null): string {
    const painted = "piece" in item.mesh && item.color !== null ? item.color : null;
    const source = from && (painted ? `shackled.replace(${from}.mesh, colors="${painted}")` : `${from}.mesh`);
    const texture = material.texture && from ? new Expression(`${from}.material.texture`) : undefined;
    const emission = material.emission === "#000000" ? undefined : material.emission;
    const { cull, wireframe, opacity, twoSided } = own;
    return call("Object", {
        mesh: source ? new Expression(source) : inline(mesh),
        ...own,
        material: call("Material", { ...material, texture, emission }),
        cull: cull === false ? false : undefined,
        wireframe: wireframe || undefined,
        opacity: opacity === 1 ? undefined : opacity,
        twoSided: twoSided || undefined,
    }).code;
}

function inline({ positions, faces, colors, normals, opacities }: Mesh): Expression {
    const all = colors === undefined || typeof colors === "string" ? colors : rowsOf(colors as Rows);
    return call("Mesh", {
        positions: rowsOf(positions),
        faces: rowsOf(faces),
        colors: all && typeof all !== "string" && new Set(all.map(String)).size === 1 ? all[0] : all,
        normals: normals && rowsOf(normals),
        // whole numbers of bytes count in 255ths
        opacities: opacities && Array.from(opacities, (each) => (opacities instanceof Uint8Array ? each / 255 : each)),
    });
}

function verticesOf({ positions }: Mesh): number {
    return typeof positions[0] === "number" ? positions.length / 3 : positions.length;
}

function rowsOf(rows: Rows): number[][] {
    if (rows.length && typeof rows[0] !== "number")
        return Array.from(rows as readonly ArrayLike<number>[], (row) => Array.from(row));
    return inRows(rows as ArrayLike<number>, 3);
}

/** Python code. */
class Expression {
    constructor(readonly code: string) {}
}

/** Return a call of a class of the package, without what is undefined; its fields have the names of Python. */
function call(name: string, values: object): Expression {
    const given = Object.entries(values).filter(([, value]) => value !== undefined && value !== null);
    return new Expression(
        `shackled.${name}(${given.map(([key, value]) => `${snake(key)}=${python(value)}`).join(", ")})`,
    );
}

function python(value: unknown): string {
    if (value instanceof Expression) return value.code;
    if (typeof value === "boolean") return value ? "True" : "False";
    if (typeof value === "string") return JSON.stringify(value);
    if (typeof value === "number") return String(value);
    const parts = Array.from(value as ArrayLike<unknown>, python);
    return `(${parts.join(", ")}${parts.length === 1 ? "," : ""})`;
}
