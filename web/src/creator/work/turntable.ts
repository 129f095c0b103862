// Frames of a full turn: the camera and the lights go around the objects, which looks as if the objects turned.

import {
    add,
    boundsOf,
    cross,
    dot,
    fromAxisAngle,
    rotation,
    subtract,
    times,
    unit,
    type Vector,
} from "../../scene/arithmetic.js";
import { checkedScene, worldPositions, type Camera } from "../../scene/checked.js";
import type { Light, Scene, Vector3 } from "../../scene/types.js";
import type { Path } from "./protocol.js";

/** The share of the half width and half height of the picture that may be filled. */
const FILLED = 0.92;

/**
 * Return the camera for all frames of a turn, so far back that what is completely in the picture stays in it, as
 * src/shackled/scene/_turning.py places it.
 */
export function pathOf(scene: Scene, frames: number): Path {
    const checked = checkedScene(scene);
    const { camera, objects, width, height } = checked;
    const points = worldPositions(objects);
    const middle = points.length ? times(0.5, add(...boundsOf(points))) : ([0, 0, 0] as Vector);
    return { camera: points.length ? held(camera, points, middle, frames, width / height) : camera, middle };
}

/** Return the scene in which the objects have turned by so many degrees, counter-clockwise as seen from above. */
export function seenFrom(scene: Scene, { camera, middle }: Path, degrees: number): Scene {
    const turn = rotation(fromAxisAngle([0, 1, 0], -degrees));
    const about = (point: Vector3): Vector => add([...middle], turn(subtract([...point], [...middle])));
    const { eye = [0, 0, 0], target = [0, 0, -1], up = [0, 1, 0] } = camera;
    const lights = scene.lights?.map((light): Light => ({
        ...light,
        ...("position" in light ? { position: about(light.position) } : {}),
        ...("direction" in light ? { direction: turn([...light.direction]) } : {}),
    }));
    return { ...scene, camera: { ...camera, eye: about(eye), target: about(target), up: turn([...up]) }, lights };
}

function held(camera: Camera, points: Float64Array, middle: Vector, frames: number, aspect: number): Camera {
    const forward = unit(subtract(camera.target, camera.eye));
    const right = unit(cross(forward, camera.up));
    const axes = [times(1 / aspect, right), cross(right, forward), forward] as const;
    const perspective = camera.projection === "perspective";
    /** Return how far points are beside the line of sight, in halves of the picture at distance 1, and how deep. */
    const reach = (degrees: number): [number, number][] => {
        const turn = rotation(fromAxisAngle([0, 1, 0], degrees));
        return Array.from({ length: points.length / 3 }, (_, at) => {
            const point = subtract([points[3 * at], points[3 * at + 1], points[3 * at + 2]], middle);
            const away = subtract(add(middle, turn(point)), camera.eye);
            const [x, y, z] = axes.map((axis) => dot(away, axis)) as Vector;
            return [Math.max(Math.abs(x), Math.abs(y)) / camera.halfHeight, perspective ? z : 1];
        });
    };
    const first = reach(0);
    if (first.some(([beside, depth]) => depth <= 0 || beside > depth)) return camera;
    const share = first.reduce((most, [beside, depth]) => Math.max(most, beside / depth), FILLED);
    let [most, back] = [0, 0];
    for (let frame = 0; frame < frames; frame++) {
        for (const [beside, depth] of reach((360 * frame) / frames)) {
            most = Math.max(most, beside);
            back = Math.max(back, beside / share - depth);
        }
    }
    if (!perspective) return { ...camera, halfHeight: camera.halfHeight * Math.max(1, most / share) };
    const farthest = first.reduce((far, [, depth]) => Math.max(far, depth), 0);
    if (back <= 1e-9 * farthest) return camera;
    return { ...camera, eye: subtract(camera.eye, times(back, forward)) };
}
