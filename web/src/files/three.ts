// From the meshes that loaders of three.js make to triangles.

import { Matrix4, Vector3, Vector4, type InstancedMesh, type Material, type Matrix3 } from "three";
import type { Mesh, Object3D, SkinnedMesh } from "three";
import { InputError } from "../errors.js";
import { rowsOf } from "../scene/topology.js";
import { toSrgb, type Surface, type Triangles } from "./parts.js";

/** How many triangles are read, each mesh as often as it is shown. */
const MAX_TRIANGLES = 1 << 23;

/** How a material looks. factor: linear, of colours of vertices. blended: whether their alpha counts. channel, matrix: of uvs. */
export interface Shown {
    surface: Surface;
    factor: readonly number[];
    blended?: boolean;
    channel?: number;
    matrix?: Matrix3 | undefined;
}

type AnyMesh = Mesh & Partial<InstancedMesh> & Partial<SkinnedMesh>;
type Chunk = Pick<Triangles, "positions" | "faces" | "colors"> &
    Record<"normals" | "uvs", Float64Array> & { surface: Uint32Array };

/** Return the triangles of all meshes that are visible, where they are. shown: of a material; undefined to leave it out. */
export function trianglesOf(root: Object3D, shown: (material: Material, mesh: Mesh) => Shown | undefined): Triangles {
    const chunks: Chunk[] = [];
    const surfaces = new Map<Surface, number>();
    let [total, vertices] = [0, 0];
    root.updateMatrixWorld(true);
    root.traverseVisible((object) => {
        const mesh = object as AnyMesh;
        if (!mesh.isMesh) return;
        const { attributes, index, groups } = mesh.geometry;
        const size = attributes.position.count;
        const whole = [{ start: 0, count: index?.count ?? size, materialIndex: 0 }];
        for (const { start, count, materialIndex = 0 } of groups.length ? groups : whole) {
            const look = shown([mesh.material].flat()[materialIndex], mesh);
            if (!look) continue;
            const number = surfaces.get(look.surface) ?? surfaces.size;
            surfaces.set(look.surface, number);
            // without an index, a group has the vertices of its own range
            const [first, many] = index ? [0, size] : [start, count - (count % 3)];
            const corner = (_: unknown, at: number): number => (index ? index.getX(start + at) : at);
            const corners = Uint32Array.from({ length: count - (count % 3) }, corner);
            if (first + many > size || corners.some((each) => each >= many))
                throw new InputError(`a mesh names a vertex beyond its ${size}`);
            for (let instance = 0; instance < (mesh.isInstancedMesh ? (mesh.count as number) : 1); instance++) {
                total += corners.length / 3;
                if (total > MAX_TRIANGLES) throw new InputError(`it shows more than ${MAX_TRIANGLES} triangles`);
                const own = new Matrix4();
                if (mesh.isInstancedMesh) mesh.getMatrixAt?.(instance, own);
                const place = own.premultiply(mesh.matrixWorld);
                // the front of a mirrored mesh stays its front
                const steps = place.determinant() < 0 ? [0, 1, -1] : [0, 0, 0];
                const order = corners.map((_, at) => corners[at + steps[at % 3]]);
                const { positions, colors, normals, uvs } = verticesOf(mesh, place, look, first, many);
                const faces = order.map((each) => vertices + each);
                const surface = new Uint32Array(order.length / 3).fill(number);
                const table = {
                    colors: rowsOf(colors, order, 4),
                    normals: rowsOf(normals, order),
                    uvs: rowsOf(uvs, order, 2),
                };
                chunks.push({ positions, faces, surface, ...table });
                vertices += many;
            }
        }
    });
    /** Return tables of the chunks one after the other. empty: one of their kind. */
    const joined = <T extends Float64Array | Uint8Array | Uint32Array>(tableOf: (chunk: Chunk) => T, empty: T): T => {
        const tables = chunks.map(tableOf);
        const size = tables.reduce((sum, { length }) => sum + length, 0);
        const found = new (empty.constructor as new (size: number) => T)(size);
        tables.reduce((at, table) => (found.set(table, at), at + table.length), 0);
        return found;
    };
    const [floats, bytes, integers] = [new Float64Array(), new Uint8Array(), new Uint32Array()];
    return {
        positions: joined((chunk) => chunk.positions, floats),
        faces: joined((chunk) => chunk.faces, integers),
        colors: joined((chunk) => chunk.colors, bytes),
        normals: joined((chunk) => chunk.normals, floats),
        uvs: joined((chunk) => chunk.uvs, floats),
        surface: joined((chunk) => chunk.surface, integers),
        surfaces: [...surfaces.keys()],
    };
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
        const level = (at: number): number => (color ? Math.min(Math.max(color.getComponent(vertex, at), 0), 1) : 1);
        for (let at = 0; at < 3; at++) colors[4 * row + at] = toSrgb(factor[at] * level(at));
        if (blended && color?.itemSize === 4) colors[4 * row + 3] = Math.round(255 * level(3));
        point.set(uv?.getX(vertex) ?? 0, uv?.getY(vertex) ?? 0, 1);
        if (matrix) point.applyMatrix3(matrix);
        if (Number.isFinite(point.x + point.y)) uvs.set([point.x, point.y], 2 * row);
    }
    return { positions, normals, uvs, colors };
}
