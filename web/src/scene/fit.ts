// Conversion of scenes to the number ranges of the contracts, without a change of the picture.
// src/shackled/scene/_in_range.py, whose numbers these are, says how and why.

import { InputError } from "../errors.js";
import {
    add,
    boundsOf,
    clamped,
    cross,
    dot,
    exponentOf,
    largest,
    length,
    powerOfTwo,
    rint,
    rotation,
    rowOf,
    subtract,
    times,
    unit,
    type Quaternion,
    type Vector,
} from "./arithmetic.js";
import {
    worldPositions,
    type Camera,
    type Fog,
    type Light,
    type Mesh,
    type Scene,
    type SceneObject,
} from "./checked.js";
import * as constant from "./constants.js";
import { withGround } from "./ground.js";
import { remembered } from "./memory.js";
import { MAX_SHORT, MAX_WIDE, fits, isIntegral, vertexNormals } from "./mesh.js";

/** A scene whose camera has a near plane. */
export type FittedScene = Scene & { camera: { near: number } };

/** Return the scene in the number ranges of the contracts, with integer coordinates and a near plane. */
export function fit(scene: Scene): FittedScene {
    checkView(scene.camera);
    const prepared = { ...scene, objects: withGround(scene).map(prepare), ground: undefined };
    let { camera, lights, objects, fog } = prepared;
    let near: number;
    if (isExact(prepared)) {
        near = nearPlane(prepared, 1, 1);
    } else {
        const factor = factorOf(prepared);
        near = nearPlane(prepared, factor, constant.MAX_COORDINATE);
        camera = moveCamera(camera, factor);
        lights = lights.map((light) => moveLight(light, scene.camera.eye, factor));
        objects = objects.map((object) => moveObject(object, prepared, factor, near));
        fog = fog && moveFog(fog, factor);
    }
    return {
        ...prepared,
        camera: { ...camera, up: direction(camera.up), near },
        lights: lights.map(pointed),
        fog,
        objects: objects.map((object) => ({ ...object, rotation: direction(object.rotation) })),
    };
}

function pointed(light: Light): Light {
    if (light.kind === "directional") return { ...light, vector: direction(light.vector) };
    return light.cone ? { ...light, cone: { ...light.cone, direction: direction(light.cone.direction) } } : light;
}

function checkView({ eye, target, up }: Camera): void {
    const forward = subtract(target, eye);
    if (!forward.some((x) => x)) {
        throw new InputError(`the camera's eye and target are the same point, (${eye.join(", ")})`);
    }
    if (!up.some((x) => x)) throw new InputError("the camera's up must not be (0, 0, 0)");
    if (length(cross(unit(forward), unit(up))) < 1e-9) {
        throw new InputError(`the camera looks along its up direction, (${up.join(", ")}); choose another up`);
    }
}

/** Return the object without unused vertices, and with the normals that smooth shading needs. */
function prepare(object: SceneObject): SceneObject {
    return { ...object, mesh: preparedMesh(object.mesh, object.material.shading === "smooth") };
}

const preparedMesh = remembered((mesh: Mesh, isSmooth: boolean): Mesh => {
    const count = mesh.positions.length / 3;
    const normals = isSmooth ? (mesh.normals ?? computedNormals(mesh)) : undefined;
    const numbers = new Int32Array(count).fill(-1);
    for (const vertex of mesh.faces) numbers[vertex] = 0;
    let used = 0;
    for (let vertex = 0; vertex < count; vertex++) if (numbers[vertex] === 0) numbers[vertex] = used++;
    if (used === count) return { ...mesh, normals };
    const kept = <T extends Float64Array | Uint8Array>(table: T, width = 3): T =>
        table.filter((_, index) => numbers[Math.floor(index / width)] >= 0) as T;
    const opacities = mesh.opacities && kept(mesh.opacities, 1);
    return {
        positions: kept(mesh.positions),
        faces: mesh.faces.map((vertex) => numbers[vertex]),
        colors: kept(mesh.colors),
        normals: normals && kept(normals),
        uvs: mesh.uvs && kept(mesh.uvs, 2),
        opacities: opacities?.some((each) => each < 1) ? opacities : undefined,
    };
});

function computedNormals(mesh: Mesh): Float64Array {
    const { center, radius } = factsOf(mesh);
    // of any size: squares of its lengths stay within floats
    const shape = mesh.positions.map((x, index) => (x - center[index % 3]) / (radius || 1));
    return vertexNormals(shape, mesh.faces);
}

/** The size of a mesh, in its own units. */
interface Facts {
    /** Whether a packed mesh can hold its coordinates, and whether 16 bits can. */
    isIntegral: boolean;
    isShort: boolean;
    /** The largest coordinate, without its sign. */
    reach: number;
    /** The middle of the bounding box, and the largest distance from it along an axis. */
    center: Vector;
    radius: number;
}

const factsOf = remembered(({ positions }: Mesh): Facts => {
    const bounds = boundsOf(positions);
    const [low, high] = bounds.map((each) => times(0.5, each));
    return {
        isIntegral: isIntegral(positions),
        isShort: fits(positions, MAX_SHORT),
        reach: largest(bounds.flat()),
        center: add(low, high),
        radius: Math.max(...subtract(high, low)),
    };
});

/** Return whether the contracts represent the scene exactly, well within their ranges. */
function isExact({ camera, lights, objects, fog }: Scene): boolean {
    const lengths = [...camera.eye, ...camera.target, camera.near ?? 0];
    if (camera.projection === "orthographic") lengths.push(camera.halfHeight);
    for (const light of lights) if (light.kind !== "directional") lengths.push(...light.vector);
    let reach = largest(lengths);
    for (const { mesh, scale, position } of objects) {
        const facts = factsOf(mesh);
        if (!facts.isIntegral || scale > maxScale(facts)) return false;
        lengths.push(scale, ...position);
        reach = Math.max(reach, largest(position) + scale * facts.reach);
    }
    const view = cross(unit(subtract(camera.target, camera.eye)), unit(camera.up));
    // by `moveCamera`: a scene decoded from a call must not be moved again
    const isMoved = largest(camera.eye) === 0 && (camera.near !== undefined || camera.projection === "orthographic");
    return (
        constant.EXACT_SIZES[0] <= reach &&
        (reach <= constant.EXACT_SIZES[1] || (isMoved && largest(lengths) <= constant.MAX_COORDINATE)) &&
        lengths.every((each) => each % constant.STEP === 0) &&
        (camera.projection === "perspective" || camera.halfHeight >= constant.MIN_HALF_HEIGHT) &&
        length(view) >= constant.DIRECTION_LENGTHS[0] &&
        (fog === undefined || fog.far <= constant.MAX_COORDINATE)
    );
}

/** Return the factor by which a scene is scaled, a power of two. */
function factorOf(scene: Scene): number {
    const { size, farthest } = extentOf(scene);
    let reach = farthest;
    if (scene.camera.projection === "orthographic") reach = Math.max(reach, scene.camera.halfHeight);
    for (const light of scene.lights) {
        if (light.kind !== "directional") {
            // lights far beyond the scene may be moved nearer: their direction hardly changes
            const distance = largest(subtract(light.vector, scene.camera.eye));
            reach = Math.max(reach, Math.min(distance, 1024 * reach));
        }
    }
    // what is so near to the eye is clear in fog that ends beyond
    if (scene.fog) reach = Math.max(reach, Math.min(scene.fog.far, 1024 * reach));
    let exponent = reach ? constant.REACH_EXPONENT - exponentOf(reach) : 0;
    if (size) exponent = Math.min(exponent, constant.SIZE_EXPONENT - exponentOf(size));
    return powerOfTwo(clamped(exponent, -1000, 1000));
}

/** Return half the largest side of an object, and how far any reaches from the eye along an axis. */
function extentOf({ objects, camera }: Scene): { size: number; farthest: number } {
    let [size, farthest] = [0, 0];
    for (const { mesh, scale, position, rotation: quaternion } of objects) {
        const { center, radius } = factsOf(mesh);
        const place = subtract(add(position, rotation(quaternion)(times(scale, center))), camera.eye);
        size = Math.max(size, scale * radius);
        farthest = Math.max(farthest, largest(place) + scale * radius);
    }
    if (!Number.isFinite(farthest)) {
        throw new InputError(
            "the scene is too large: its coordinates, scaled and moved, are beyond what a float holds",
        );
    }
    return { size, farthest };
}

function moveCamera(camera: Camera, factor: number): Camera {
    const forward = unit(subtract(camera.target, camera.eye));
    const up = unit(camera.up);
    let { halfHeight } = camera;
    if (camera.projection === "orthographic") {
        halfHeight *= factor;
        if (halfHeight < constant.MIN_HALF_HEIGHT) {
            throw new InputError(`the camera's halfHeight ${camera.halfHeight} is too small for the size of the scene`);
        }
    }
    return {
        ...camera,
        eye: [0, 0, 0],
        target: times(2 ** constant.SIZE_EXPONENT, forward),
        // upright on the line of sight, so that the cross product loses nothing
        up: unit(subtract(up, times(dot(up, forward), forward))),
        halfHeight,
    };
}

/** Return the distance of the near plane, times the factor: the camera's own, or else a part of the farthest distance. */
function nearPlane(scene: Scene, factor: number, most: number): number {
    const { projection, near } = scene.camera;
    if (projection === "orthographic") {
        const wanted = near === undefined ? -Infinity : near * factor;
        return clamped(wanted, -constant.MAX_COORDINATE, constant.MAX_COORDINATE);
    }
    if (near !== undefined) return clamped(near * factor, constant.STEP, constant.MAX_COORDINATE);
    const { farthest } = extentOf(scene);
    return farthest ? Math.max(Math.min(farthest * factor * constant.NEAR_PART, most), constant.STEP) : 1;
}

function moveLight(light: Light, eye: Vector, factor: number): Light {
    if (light.kind === "directional") return light;
    const place = times(factor, subtract(light.vector, eye));
    // a light so far away keeps its direction
    const distance = largest(place);
    return { ...light, vector: distance ? times(Math.min(1, 2 ** constant.REACH_EXPONENT / distance), place) : place };
}

function moveFog(fog: Fog, factor: number): Fog {
    // nothing is as far away as the largest distances
    const far = clamped(fog.far * factor, constant.STEP, constant.MAX_COORDINATE);
    return { ...fog, near: Math.min(fog.near * factor, constant.MAX_COORDINATE - 1), far };
}

/** Return the object about the eye. near: the distance of the near plane, times the factor. */
function moveObject(object: SceneObject, scene: Scene, factor: number, near: number): SceneObject {
    let { mesh } = object;
    let center: Vector = [0, 0, 0];
    let step = 1;
    const facts = factsOf(mesh);
    if (!facts.isIntegral || object.scale * factor > maxScale(facts)) {
        // the radii of a fade are about the object's position, which therefore stays
        const isFixed = object.fade !== undefined;
        const box = isFixed ? { center, radius: facts.reach } : facts;
        const steps = stepsOf(object, box, scene, factor, near);
        center = box.center;
        step = box.radius / steps;
        mesh = isFixed ? onGrid(mesh, center, step) : inSteps(mesh, steps);
    }
    const turned = rotation(object.rotation)(times(object.scale, center));
    const place = subtract(add(object.position, turned), scene.camera.eye);
    const fade = object.fade && ([object.fade[0] * factor, object.fade[1] * factor] as const);
    return { ...object, mesh, position: times(factor, place), scale: object.scale * step * factor, fade };
}

/** Return the mesh with whole coordinates: the largest of its box, from the middle, is `steps`. */
const inSteps = remembered((mesh: Mesh, steps: number): Mesh => {
    const { center, radius } = factsOf(mesh);
    return onGrid(mesh, center, radius / steps);
});

function onGrid(mesh: Mesh, center: Vector, step: number): Mesh {
    return { ...mesh, positions: mesh.positions.map((x, index) => (step ? rint((x - center[index % 3]) / step) : 0)) };
}

/** Return how many steps the grid of an object has across half its largest side. */
function stepsOf(
    object: SceneObject,
    { center, radius }: { center: Vector; radius: number },
    { camera, height }: Scene,
    factor: number,
    near: number,
): number {
    const size = object.scale * radius;
    const isCoarse = (nearest: number): boolean =>
        size * (height / (2 * camera.halfHeight) / Math.max(nearest, near / factor)) <=
        constant.STEP_IN_PIXELS * MAX_SHORT;
    if (camera.projection === "orthographic") {
        if (size * (height / (2 * camera.halfHeight)) <= constant.STEP_IN_PIXELS * MAX_SHORT) return MAX_SHORT;
    } else {
        const forward = unit(subtract(camera.target, camera.eye));
        const middle = add(object.position, rotation(object.rotation)(times(object.scale, center)));
        // no vertex is nearer than the sphere about the box, whatever the rounding
        const slack = 1e-9 * (largest(middle) + largest(camera.eye) + largest(object.position) + size);
        if (isCoarse(dot(subtract(middle, camera.eye), forward) - 2 * size - slack)) return MAX_SHORT;
        const places = worldPositions([object]);
        let nearest = Infinity;
        for (let row = 0; 3 * row < places.length; row++) {
            nearest = Math.min(nearest, dot(subtract(rowOf(places, row), camera.eye), forward));
        }
        if (isCoarse(nearest)) return MAX_SHORT;
    }
    // the contract's matrix is rounded to 2^-32 units a step: with more steps that would be more than one of them
    return Math.trunc(clamped(Math.sqrt((size * factor) / constant.STEP), MAX_SHORT, MAX_WIDE));
}

/** Return the scale up to which the contracts draw a mesh of these coordinates, which depends on their bits. */
function maxScale({ isShort }: Facts): number {
    return isShort ? constant.MAX_SCALE_SHORT : constant.MAX_SCALE_WIDE;
}

export function direction<V extends Vector | Quaternion>(v: V): V {
    const size = largest(v);
    return constant.DIRECTION_LENGTHS[0] <= size && size <= constant.DIRECTION_LENGTHS[1] ? v : unit(v);
}
