// A picture of the result of each stage of the pipeline, as src/shackled/stages.py draws them: docs/explain.md.

import { add, boundsOf, clamped, cross, dot, rint, subtract, unit, type Vector } from "../../scene/arithmetic.js";
import { drawCall, withFunction } from "../../picture.js";
import { checkedMesh, checkedScene, worldPositions } from "../../scene/checked.js";
import { encode } from "../../scene/encode.js";
import { fit, type FittedScene } from "../../scene/fit.js";
import type { Material, Scene, SceneObject } from "../../scene/types.js";
import type { Host } from "./host.js";
import type { Stage } from "./protocol.js";

/** The two greys of the checkerboard, and the side of its squares at 128 pixels. */
const CHECKS = [46, 54];
const CHECK_SIDE = 8;
const UNLIT: Material = { shading: "unlit" };
/** Multiples of the golden ratio, modulo 1, are evenly distributed for any count. */
const GOLDEN = (Math.sqrt(5) - 1) / 2;
const DARKEST = 0.45;

type Picture = Stage["drawn"];
/** A point on the canvas, in pixels from the upper left corner; points of the highest order are drawn last. */
interface Dot {
    x: number;
    y: number;
    order: number;
    color: Uint8Array;
}

/** Return the six stages in their order. */
export function stagesOf(host: Host, scene: Scene): Stage[] {
    const sent = fit(checkedScene(scene));
    const points = pointsOf(sent);
    const faces = sent.objects.reduce((sum, { mesh }) => sum + mesh.faces.length / 3, 0);
    const inside = projected(sent, points);
    const drawn = host.draw(scene);
    const counts = drawCall(host.evm, withFunction(encode(scene), "renderCounted"));
    const plain: Scene = { ...scene, invert: false, antialias: false };
    const [wires, shades] = [edges, filled].map((change) => ({ ...plain, objects: plain.objects.map(change) }));
    const say = (count: number | undefined): string => (count ?? 0).toLocaleString("en");
    const stage = (title: string, detail: string, picture: Picture): Stage => ({ title, detail, drawn: picture });
    return [
        stage(
            "Vertex specification",
            `${say(points.length)} points, ${say(faces)} faces`,
            withDots(sent, specified(sent, points)),
        ),
        stage("Vertex shader", `${say(inside.length)} points on the canvas`, withDots(sent, inside)),
        stage("Primitive assembly", `${say(counts.triangles)} triangles left`, overNothing(host, wires)),
        stage("Rasterization", `${say(counts.litPixels)} pixels covered`, overNothing(host, shades)),
        stage("Fragment shader", lightsOf(scene), overNothing(host, plain)),
        stage("Compositing", `${drawn.width} x ${drawn.height} pixels, ${say(drawn.gas)} gas`, drawn),
    ];
}

// ---- points ----

function pointsOf(sent: FittedScene): { place: Vector; color: Uint8Array }[] {
    const world = worldPositions(sent.objects);
    const colors = sent.objects.flatMap(({ mesh }) =>
        Array.from({ length: mesh.positions.length / 3 }, (_, at) => mesh.colors.subarray(3 * at, 3 * at + 3)),
    );
    return colors.map((color, at) => ({ place: [...world.subarray(3 * at, 3 * at + 3)] as Vector, color }));
}

/** Return the vertices in world space, from the front (+z), without a camera, filling the canvas. */
function specified(sent: FittedScene, points: ReturnType<typeof pointsOf>): Dot[] {
    if (!points.length) return [];
    const [low, high] = boundsOf(worldPositions(sent.objects));
    const { width, height } = sent;
    const unit = Math.max((high[0] - low[0]) / (0.75 * width), (high[1] - low[1]) / (0.75 * height)) || 1;
    const [x, y] = add(low, high);
    return points.map(({ place, color }) => ({
        x: (place[0] - x / 2) / unit + width / 2,
        y: -(place[1] - y / 2) / unit + height / 2,
        order: place[2],
        color,
    }));
}

/** Return the vertices on the canvas that the near plane does not clip. */
function projected({ camera, width, height }: FittedScene, points: ReturnType<typeof pointsOf>): Dot[] {
    const forward = unit(subtract(camera.target, camera.eye));
    const right = unit(cross(forward, camera.up));
    const up = unit(cross(right, forward));
    const pixels = height / (2 * camera.halfHeight);
    const dots = points.map(({ place, color }) => {
        const away = subtract(place, camera.eye);
        const distance = dot(away, forward);
        // nothing is seen behind the eye
        const scale = camera.projection === "orthographic" ? pixels : distance > 0 ? pixels / distance : 0;
        return {
            x: dot(away, right) * scale + width / 2,
            y: -dot(away, up) * scale + height / 2,
            order: -distance,
            color,
        };
    });
    return dots.filter(({ x, y, order }) => -order >= camera.near && x >= 0 && y >= 0 && x < width && y < height);
}

/** Draw points as dots over nothing, with the ellipses of Pillow. */
function withDots({ width, height }: { width: number; height: number }, dots: Dot[]): Picture {
    const picture = nothing(width, height);
    const few = clamped(5 - 1.6 * Math.log10(Math.max(1, dots.length)), 1, 4);
    const radius = Math.max(0.5, (Math.min(width, height) / 256) * few);
    for (const { x, y, color } of dots.toSorted((a, b) => a.order - b.order)) {
        const [left, right] = [Math.trunc(x - 0.5 - radius), Math.trunc(x - 0.5 + radius)];
        const [top, bottom] = [Math.trunc(y - 0.5 - radius), Math.trunc(y - 0.5 + radius)];
        const [a, b] = [right - left, bottom - top];
        for (const [row, half] of halfWidths(a, b)) {
            for (const line of row ? [(b + row) / 2, (b - row) / 2] : [b / 2]) {
                const at = top + line;
                if (at < 0 || at >= height) continue;
                const [from, to] = [Math.max(0, left + (a - half) / 2), Math.min(width - 1, left + (a + half) / 2)];
                for (let column = from; column <= to; column++) picture.pixels.set(color, 4 * (at * width + column));
            }
        }
    }
    return picture;
}

/** Return half the width of the rows of an ellipse, by their distance from its middle, all in half pixels. */
function halfWidths(a: number, b: number): Map<number, number> {
    const rows = new Map<number, number>();
    const off = (x: number, y: number): number => Math.abs(a * a * y * y + b * b * x * x - a * a * b * b);
    let [x, y] = [a, b % 2];
    for (;;) {
        if (!rows.has(y)) rows.set(y, x);
        if (x === a % 2 && y === b) return rows;
        let [nextX, nextY] = [x, y + 2];
        if (x > 1) {
            if (off(nextX, nextY) > off(x - 2, y + 2)) nextX = x - 2;
            if (off(nextX, nextY) > off(x - 2, y)) [nextX, nextY] = [x - 2, y];
        }
        [x, y] = [nextX, nextY];
    }
}

// ---- what the contracts draw ----

function edges(object: SceneObject): SceneObject {
    return { ...object, wireframe: true, material: UNLIT };
}

/** Return an object in the colours of its vertices, with varied brightness per triangle. */
function filled(object: SceneObject): SceneObject {
    if (object.wireframe) return { ...object, material: UNLIT };
    const mesh = checkedMesh(object.mesh, "the mesh");
    const corners = [...mesh.faces];
    const of = <T extends Float64Array | Uint8Array>(table: T): number[][] =>
        corners.map((vertex) => [...table.subarray(3 * vertex, 3 * vertex + 3)]);
    const colors = of(mesh.colors).map((color, corner) => {
        const shade = DARKEST + (1 - DARKEST) * ((Math.floor(corner / 3) * GOLDEN) % 1);
        return color.map((channel) => rint(channel * shade));
    });
    const split = { positions: of(mesh.positions).flat(), faces: corners.map((_, corner) => corner), colors };
    return { ...object, mesh: split, material: UNLIT };
}

/** Draw the fragments of a scene without its background: the pixels that do not depend on it. */
function overNothing(host: Host, scene: Scene): Picture {
    const [black, white] = ["#000000", "#ffffff"].map((background) => host.draw({ ...scene, background }).pixels);
    const picture = nothing(scene.width ?? 128, scene.height ?? 128);
    for (let at = 0; at < black.length; at += 4) {
        const pixel = black.subarray(at, at + 4);
        if (pixel.every((channel, index) => channel === white[at + index])) picture.pixels.set(pixel, at);
    }
    return picture;
}

/** Return a checkerboard, which stands for transparency. */
function nothing(width: number, height: number): Picture {
    const side = Math.max(1, Math.floor((CHECK_SIDE * Math.min(width, height)) / 128));
    const pixels = new Uint8ClampedArray(4 * width * height);
    for (let at = 0; at < width * height; at++) {
        const square = Math.floor((at % width) / side) + Math.floor(Math.floor(at / width) / side);
        const grey = CHECKS[(square + 1) % 2];
        pixels.set([grey, grey, grey, 255], 4 * at);
    }
    return { width, height, pixels };
}

function lightsOf({ objects, lights = [] }: Scene): string {
    const shadings = [...new Set(objects.map(({ material }) => material?.shading ?? "flat"))].sort();
    const count = `${lights.length} light${lights.length === 1 ? "" : "s"}`;
    return shadings.length ? `${shadings.join(" and ")}, ${count}` : count;
}
