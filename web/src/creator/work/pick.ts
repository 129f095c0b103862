// Which object is where: a picture in which each object has a colour of its own, drawn by the contracts.

import type { Scene } from "../../scene/types.js";
import type { Host } from "./host.js";

/** The longest side of the picture. */
const SIDE = 128;

interface Ids {
    width: number;
    height: number;
    /** The index of the object of each pixel, rows from the top; -1 for none. */
    ids: Int32Array<ArrayBuffer>;
}

export function idsOf(host: Host, scene: Scene): Ids {
    const { width = SIDE, height = SIDE, camera = {} } = scene;
    const part = Math.min(1, SIDE / Math.max(width, height));
    const objects = scene.objects.map(({ mesh, position, rotation, scale, cull }, index) => ({
        mesh: { positions: mesh.positions, faces: mesh.faces, colors: colorOf(index + 1) },
        material: { shading: "unlit" as const },
        ...{ position, rotation, scale, cull },
    }));
    const small = { width: Math.max(1, Math.round(width * part)), height: Math.max(1, Math.round(height * part)) };
    const drawn = host.draw({ objects, camera, lights: [], background: "#000000", ...small });
    const rgb = new DataView(drawn.pixels.buffer);
    const ids = Int32Array.from({ length: drawn.pixels.length / 4 }, (_, at) => (rgb.getUint32(4 * at) >>> 8) - 1);
    return { width: drawn.width, height: drawn.height, ids };
}

/** Return the object at a fraction of the canvas, or else the next one within a pixel; -1 for none. */
export function idAt({ width, height, ids }: Ids, x: number, y: number): number {
    const [column, row] = [Math.floor(x * width), Math.floor(y * height)];
    const around = [0, -1, 1].flatMap((down) => [0, -1, 1].map((right) => [column + right, row + down] as const));
    for (const [at, line] of around) {
        if (at < 0 || at >= width || line < 0 || line >= height) continue;
        const id = ids[line * width + at];
        if (id >= 0) return id;
    }
    return -1;
}

function colorOf(number: number): [number, number, number] {
    return [number >> 16, (number >> 8) & 255, number & 255];
}
