// From the meshes that loaders of three.js make to triangles.

import { Matrix4, Vector3, Vector4, type InstancedMesh, type Material, type Matrix3 } from "three";
import type { Mesh, Object3D, SkinnedMesh } from "three";
import { InputError } from "../errors.js";
import { clamped } from "../scene/arithmetic.js";
import { rowsOf } from "../scene/topology.js";
import { toSrgb, type Surface, type Triangles } from "./parts.js";
import { plural } from "./source.js";

/** How many triangles are read, each mesh as often as it is shown; of files with less than eight bytes for each, fewer. */
const [MAX_TRIANGLES, OF_SMALL] = [1 << 23, 1 << 20];
/** The number of a vertex that does not exist, whose triangles are left out. */
const NOWHERE = 2 ** 32 - 1;

/** How a material looks. factor: linear, of colours of vertices. blended: whether their alpha counts. channel, matrix: of uvs. */
export interface Shown {
    surface: Surface;
    factor: readonly number[];
    blended?: boolean;
    channel?: number;
    matrix?: Matrix3 | undefined;
}

type AnyMesh = Mesh & Partial<InstancedMesh> & Partial<SkinnedMesh>;

/** A part of a mesh with one material: so many vertices from the first one, and corners of its triangles. */
interface Piece {
    mesh: AnyMesh;
    look: Shown;
    first: number;
    many: number;
    corners: Uint32Array;
    instances: number;
}

/** Check how much a file of so many bytes shows, before it is made. */
export function checkAmount(triangles: number, vertices: number, bytes: number): void {
    const most = clamped(bytes / 8, OF_SMALL, MAX_TRIANGLES);
    if (triangles <= most && vertices <= 3 * most) return;
    const what = triangles > most ? "triangles" : "vertices";
    const limit = plural(Math.floor(most), "triangle");
    throw new InputError(
        `it shows more ${what} than a file of this size may: up to ${limit}, each as often as it is shown`,
    );
}

/**
 * Return the triangles of all meshes that are visible, where they are. bytes: of the file. shown: of a material; undefined
 * to leave it out.
 */
export function trianglesOf(
    root: Object3D,
    bytes: number,
    shown: (material: Material, mesh: Mesh) => Shown | undefined,
): Triangles {
    const pieces: Piece[] = [];
    const surfaces = new Map<Surface, number>();
    let [total, vertices] = [0, 0];
    root.updateMatrixWorld(true);
    root.traverseVisible((object) => {
        const mesh = object as AnyMesh;
        if (!mesh.isMesh) return;
        const { attributes, index, groups } = mesh.geometry;
        const size = attributes.position.count;
        const instances = mesh.isInstancedMesh ? (mesh.count as number) : 1;
        const whole = [{ start: 0, count: index?.count ?? size, materialIndex: 0 }];
        for (const { start, count, materialIndex = 0 } of groups.length ? groups : whole) {
            const look = shown([mesh.material].flat()[materialIndex], mesh);
            if (!look) continue;
            surfaces.set(look.surface, surfaces.get(look.surface) ?? surfaces.size);
            // without an index, a group has the vertices of its own range
            const [first, many] = index ? [0, size] : [start, count - (count % 3)];
            total += instances * (count - (count % 3));
            vertices += instances * many;
            checkAmount(total / 3, vertices, bytes);
            const corner = (_: unknown, at: number): number => (index ? index.getX(start + at) : at);
            const corners = Uint32Array.from({ length: count - (count % 3) }, corner);
            if (first + many > size) throw new InputError(`a mesh names a vertex beyond its ${size}`);
            pieces.push({ mesh, look, first, many, corners, instances });
        }
    });
    const [positions, normals, uvs] = [3 * vertices, 3 * total, 2 * total].map((length) => new Float64Array(length));
    const [faces, surface] = [total, total / 3].map((length) => new Uint32Array(length));
    const colors = new Uint8Array(4 * total);
    let [corner, vertex] = [0, 0];
    for (const { mesh, look, first, many, corners, instances } of pieces) {
        for (let instance = 0; instance < instances; instance++) {
            const own = new Matrix4();
            if (mesh.isInstancedMesh) mesh.getMatrixAt?.(instance, own);
            const place = own.premultiply(mesh.matrixWorld);
            // the front of a mirrored mesh stays its front
            const steps = place.determinant() < 0 ? [0, 1, -1] : [0, 0, 0];
            const order = corners.map((_, at) => corners[at + steps[at % 3]]);
            const of = verticesOf(mesh, place, look, first, many);
            positions.set(of.positions, 3 * vertex);
            const vertices = order.map((each) => (each < many ? vertex + each : NOWHERE));
            faces.set(vertices, corner);
            colors.set(rowsOf(of.colors, order, 4), 4 * corner);
            normals.set(rowsOf(of.normals, order), 3 * corner);
            uvs.set(rowsOf(of.uvs, order, 2), 2 * corner);
            surface.fill(surfaces.get(look.surface) as number, corner / 3, (corner + order.length) / 3);
            corner += order.length;
            vertex += many;
        }
    }
    return { positions, faces, colors, normals, uvs, surface, surfaces: [...surfaces.keys()] };
}

/** Return what vertices of a mesh have, in the world: zeros for normals and coordinates that are not there. */
function verticesOf(
    mesh: AnyMesh,
    place: Matrix4,
    { factor, blended, channel, matrix }: Shown,
    first: number,
    count: number,
) {
    const { attributes, morphAttributes } = mesh.geometry;
    const { normal, color, [channel ? `uv${channel}` : "uv"]: uv } = attributes;
    const [positions, normals, uvs] = [3, 3, 2].map((width) => new Float64Array(width * count));
    const colors = new Uint8Array(4 * count).fill(255);
    const [point, turned, added] = [new Vector3(), new Vector4(), new Vector3()];
    // the matrix of cofactors turns normals right under any scale
    const cofactors = mesh.isSkinnedMesh ? place : place.clone().invert().transpose();
    for (let row = 0; row < count; row++) {
        const vertex = first + row;
        mesh.getVertexPosition(vertex, point)
            .applyMatrix4(place)
            .toArray(positions, 3 * row);
        if (normal) {
            point.fromBufferAttribute(normal, vertex);
            for (const [target, each] of morphAttributes.normal?.entries() ?? []) {
                const weight = mesh.morphTargetInfluences?.[target] ?? 0;
                point.addScaledVector(added.fromBufferAttribute(each, vertex), weight);
            }
            turned.set(point.x, point.y, point.z, 0);
            if (mesh.isSkinnedMesh) mesh.applyBoneTransform?.(vertex, turned as unknown as Vector3);
            point.set(turned.x, turned.y, turned.z).transformDirection(cofactors);
            if (point.toArray().every(Number.isFinite)) point.toArray(normals, 3 * row);
        }
        const level = (at: number): number => (color ? clamped(color.getComponent(vertex, at), 0, 1) : 1);
        for (let at = 0; at < 3; at++) colors[4 * row + at] = toSrgb(factor[at] * level(at));
        if (blended && color?.itemSize === 4) colors[4 * row + 3] = Math.round(255 * level(3));
        point.set(uv?.getX(vertex) ?? 0, uv?.getY(vertex) ?? 0, 1);
        if (matrix) point.applyMatrix3(matrix);
        if (Number.isFinite(point.x + point.y)) uvs.set([point.x, point.y], 2 * row);
    }
    return { positions, normals, uvs, colors };
}
