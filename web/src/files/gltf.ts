// glTF and GLB, by three.js: meshes in the pose at rest, of skins and morph targets, compressed or not.

import { DoubleSide, LoadingManager, Texture, type Mesh, type MeshStandardMaterial } from "three";
import { GLTFLoader, type GLTFParser } from "three/examples/jsm/loaders/GLTFLoader.js";
import { MeshoptDecoder } from "meshoptimizer/decoder";
import { InputError, show } from "../errors.js";
import { clamped } from "../scene/arithmetic.js";
import { dracoLoader } from "./draco.js";
import { hides, imageOf, type Picture } from "./images.js";
import { GREY, toLinear, toSrgb, type Surface, type Triangles } from "./parts.js";
import { baseOf, fileBeside, plural, textOf, type Image, type Source } from "./source.js";
import { checkAmount, trianglesOf, type Shown } from "./three.js";

/** What JSON holds. */
type Json = any; // eslint-disable-line @typescript-eslint/no-explicit-any

/** A document; leaveOut: counts what is left out, for notes. */
interface Gltf {
    json: Json;
    buffers: Uint8Array[];
    pictures: Map<string, Picture>;
    source: Source;
    leaveOut: (one: string, several?: string, count?: number) => void;
}

/** Extensions that are read, have notes of their own, or are without effect on what is drawn. */
const KNOWN = new RegExp(
    "_(mesh_gpu_instancing|texture_(webp|avif)|draco_mesh_compression|lights_punctual|mesh_quantization|meshopt_compression" +
        "|node_visibility|texture_transform|materials_(emissive_strength|pbrSpecularGlossiness|unlit))$",
);
const SIZES: Record<number | string, number> = {
    ...{ 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 },
    ...{ SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT2: 4, MAT3: 9, MAT4: 16 },
};
/** The most elements of an accessor; an eighth of the most bytes of what is unpacked. */
const MOST = 1 << 26;
/** The most bytes of all views and accessors, meshes in places, and nodes that hang on one another. */
const [MOST_BYTES, MOST_PARTS, MOST_LEVELS] = [1 << 28, 1 << 16, 2000];
/** Of samplers, by their numbers in OpenGL. */
const [NEAREST, CLAMP, MIRROR] = [9728, 33071, 33648];

/** Return the triangles of a glTF or GLB file: those of its scene, or else its first one, with all nodes in their places. */
export async function readGltf(source: Source): Promise<Triangles> {
    const { json, binary } = containerOf(source.bytes);
    const leftOut = new Map<string, [number, string | undefined]>();
    const leaveOut: Gltf["leaveOut"] = (one, several, count = 1) => {
        if (count) leftOut.set(one, [(leftOut.get(one)?.[0] ?? 0) + count, several]);
    };
    const buffers: Uint8Array[] = (json.buffers ?? []).map(({ uri }: Json, number: number) => {
        // the fallback of meshopt has no bytes, and is not read
        if (uri === undefined) return (!number && binary) || new Uint8Array();
        return resource(uri, source);
    });
    const size = [...new Set(buffers)].reduce((sum, { length }) => sum + length, source.bytes.length);
    checkLengths(json, size);
    const gltf: Gltf = { json, buffers, pictures: new Map(), source, leaveOut };
    check(gltf);
    prepare(gltf);
    checkAmounts(gltf, size);
    // all that a document names is read here; the loader asks for nothing
    const manager = new LoadingManager().setURLModifier((url) => {
        throw new InputError(`it names ${baseOf(url).slice(0, 60)} where files are not read`);
    });
    const loader = new GLTFLoader(manager)
        .setMeshoptDecoder(MeshoptDecoder as never)
        .setDRACOLoader(dracoLoader(source));
    let parser: GLTFParser | undefined;
    loader.register((found) => {
        const loadBuffer = (number: number): Promise<ArrayBuffer> => Promise.resolve(buffers[number].slice().buffer);
        parser = Object.assign(found, { loadBuffer });
        return { name: "files", loadTexture: (number) => textureOf(number, gltf) };
    });
    const { scene } = await loader.parseAsync(json, "");
    const looks = new Map<string, Shown | undefined>();
    const triangles = trianglesOf(scene, size, (material, { geometry: { attributes } }) => {
        const own = json.materials?.[parser?.associations.get(material)?.materials ?? -1];
        const key = `${material.uuid} ${Object.keys(attributes).join(" ")}`;
        if (!looks.has(key)) looks.set(key, lookOf(material as MeshStandardMaterial, own, attributes, gltf));
        return looks.get(key);
    });
    const notes = [...leftOut].map(([one, [count, several]]) => `left out: ${plural(count, one, several)}`);
    const unknown = json.extensionsUsed.filter((name: string) => !KNOWN.test(name)).sort();
    const extensions = unknown.length > 1 ? "extensions" : "extension";
    if (unknown.length) notes.push(`left out: what ${extensions} ${unknown.join(", ")} would change`);
    if (!triangles.faces.length) throw new InputError(["it has no triangles that are shown", ...notes].join("; "));
    notes.forEach(source.tell);
    return triangles;
}

function containerOf(bytes: Uint8Array): { json: Json; binary: Uint8Array | undefined } {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    const word = (at: number): string => String.fromCharCode(...bytes.subarray(at, at + 4));
    const found: Record<string, Uint8Array> = {};
    if (word(0) === "glTF") {
        const [version, length] = bytes.length < 20 ? [2, 20] : [view.getUint32(4, true), view.getUint32(8, true)];
        if (version !== 2) throw new InputError(`it is of version ${version} of GLB; version 2 is read`);
        if (length > bytes.length) throw new InputError(`it ends after ${bytes.length} of its ${length} bytes`);
        for (let at = 12; at + 8 <= length;) {
            const end = at + 8 + view.getUint32(at, true);
            if (end > length) throw new InputError(`its chunk at byte ${at} reaches beyond the end of the file`);
            found[word(at + 4)] ??= bytes.subarray(at + 8, end);
            at = end;
        }
        if (!found.JSON) throw new InputError("it has no JSON chunk");
    }
    const text = textOf(found.JSON ?? bytes);
    try {
        const json = JSON.parse(text);
        // the loader reads those that are declared
        const used = [...text.matchAll(/"((?:KHR|EXT)_\w+)"\s*:/g)].map(([, name]) => name);
        json.extensionsUsed = [...new Set([...(json.extensionsUsed ?? []), ...used])];
        return { json, binary: found["BIN\0"] };
    } catch (error) {
        throw new InputError(`it is not valid JSON: ${(error as Error).message}`);
    }
}

/** Return what a URI of a document holds. */
function resource(uri: Json, source: Source): Uint8Array {
    const text = String(uri);
    const [head, data] = [text.slice(0, text.indexOf(",")), text.slice(text.indexOf(",") + 1)];
    try {
        const bytes = (): string => (head.endsWith(";base64") ? atob(data) : decodeURIComponent(data));
        if (head.startsWith("data:")) return Uint8Array.from(bytes(), (each) => each.charCodeAt(0));
    } catch {
        throw new InputError("a data URI in it does not hold valid base64");
    }
    const file = fileBeside(source, text);
    if (file) return file.bytes;
    const name = baseOf(text.replace(/[?#].*/, "")).slice(0, 60);
    throw new InputError(`it needs ${name}, which was not given: choose or drop both files, or a ZIP file of them`);
}

/** Check all that could keep the loader from ending, or let it fail without saying why. */
function check({ json, buffers }: Gltf): void {
    const { asset, extensionsRequired = [], bufferViews = [], accessors = [] } = json;
    const { nodes = [], skins = [], meshes = [], materials = [] } = json;
    if (!asset) throw new InputError("it is no glTF file: asset, with the version of glTF, is missing");
    if (!/^2\./.test(`${asset.version}`) || !/^(2\.0|undefined)$/.test(`${asset.minVersion}`))
        throw new InputError(`its version is ${show(asset.minVersion ?? asset.version)}; glTF 2.0 is read`);
    const unread = extensionsRequired.find((name: string) => !KNOWN.test(name) && !/^KHR_materials_/.test(name));
    if (unread) throw new InputError(`it requires the extension ${unread}, which is not read; export it without`);
    bufferViews.forEach(({ extensions = {}, ...plain }: Json, number: number) => {
        const packed = extensions.EXT_meshopt_compression ?? extensions.KHR_meshopt_compression;
        const { buffer, byteOffset = 0, byteLength } = packed ?? plain;
        const [size, end] = [buffers[buffer]?.length ?? 0, byteOffset + byteLength];
        if (!(byteOffset >= 0 && byteLength >= 0 && end <= size) || packed?.count * packed?.byteStride > 8 * MOST)
            throw new InputError(`its bufferViews[${number}] needs ${end} bytes of a buffer that has ${size}`);
    });
    accessors.forEach(({ bufferView, byteOffset = 0, count, componentType, type }: Json, number: number) => {
        const [size, view] = [SIZES[componentType] * SIZES[type], bufferViews[bufferView]];
        const end = byteOffset + (count - 1) * (view?.byteStride || size) + size;
        const fits = bufferView === undefined || (view && (!count || end <= view.byteLength));
        if (!(count >= 0 && count < MOST && size > 0 && fits))
            throw new InputError(`its accessors[${number}] needs ${end} bytes, of ${view?.byteLength ?? 0}`);
    });
    const need = (kind: string, number: Json): void => {
        const count = json[kind]?.length ?? 0;
        if (number !== undefined && !(Number.isInteger(number) && number >= 0 && number < count))
            throw new InputError(`it names number ${show(number)} of its ${kind}, of which there are ${count}`);
    };
    for (const { mesh, skin } of nodes) {
        need("meshes", mesh);
        need("skins", skin);
    }
    for (const { joints = [], inverseBindMatrices } of skins) {
        for (const joint of joints) need("nodes", joint);
        need("accessors", inverseBindMatrices);
    }
    for (const { primitives } of meshes)
        for (const { attributes = {}, indices, material } of primitives) {
            for (const accessor of [...Object.values(attributes), indices]) need("accessors", accessor);
            need("materials", material);
        }
    for (const { pbrMetallicRoughness: keys, emissiveTexture } of materials)
        for (const texture of [keys?.baseColorTexture, emissiveTexture]) need("textures", texture?.index);
}

/** Take what is not drawn out of a document, with notes. */
function prepare({ json, leaveOut }: Gltf): void {
    const { nodes = [], scenes = [], meshes = [], materials = [], textures = [], animations = [] } = json;
    const children = new Set<number>(nodes.flatMap((node: Json) => node.children ?? []));
    const roots: number[] =
        scenes[json.scene ?? 0]?.nodes ?? [...nodes.keys()].filter((number) => !children.has(number));
    const waiting = roots.map((number): [number, boolean, number] => [number, true, 1]);
    const [seen, shown] = [new Set<number>(), new Set<Json>()];
    for (let next; (next = waiting.pop());) {
        const [number, isAbove, depth] = next;
        const node = nodes[number];
        if (!node) throw new InputError(`it names node ${show(number)}, but there are ${nodes.length}`);
        if (seen.has(number)) throw new InputError(`its nodes[${number}] hangs on several nodes, or on itself`);
        if (depth > MOST_LEVELS)
            throw new InputError(`its nodes hang on one another in more than ${MOST_LEVELS} levels; join some of them`);
        seen.add(number);
        const isShown = isAbove && node.extensions?.KHR_node_visibility?.visible !== false;
        if (isShown && node.camera !== undefined) leaveOut("camera");
        if (isShown && node.extensions?.KHR_lights_punctual) leaveOut("light");
        if (isShown) shown.add(meshes[node.mesh]);
        else delete node.mesh;
        for (const child of node.children ?? []) waiting.push([child, isShown, depth + 1]);
    }
    for (const [number, node] of nodes.entries()) {
        if (!seen.has(number)) delete node.mesh;
        delete node.camera;
        delete node.extensions?.KHR_lights_punctual;
    }
    for (const mesh of meshes) {
        const isDrawn = ({ mode = 4, attributes }: Json): boolean => mode > 3 && attributes?.POSITION !== undefined;
        const drawn: Json[] = mesh.primitives.filter(isDrawn);
        const lost = mesh.primitives.length - drawn.length;
        const more = drawn.filter(({ attributes }) => attributes.JOINTS_1);
        leaveOut("primitive of points or lines", "primitives of points or lines", shown.has(mesh) ? lost : 0);
        leaveOut("set of joints beyond four of a vertex", "sets of joints beyond four of a vertex", more.length);
        mesh.primitives = drawn;
    }
    for (const texture of textures) {
        // images in the order of preference, not of the extensions of the loader, which ask for addresses
        const { EXT_texture_webp: webp, EXT_texture_avif: avif } = texture.extensions ?? {};
        texture.sources = [webp?.source, texture.source, avif?.source].filter((each) => each !== undefined);
        delete texture.extensions;
    }
    for (const material of materials) {
        const older = material.extensions?.KHR_materials_pbrSpecularGlossiness;
        if (older) {
            const { diffuseFactor, diffuseTexture, glossinessFactor = 1, specularGlossinessTexture } = older;
            material.pbrMetallicRoughness = {
                ...{ baseColorFactor: diffuseFactor, baseColorTexture: diffuseTexture, metallicFactor: 0 },
                ...{ roughnessFactor: 1 - glossinessFactor, metallicRoughnessTexture: specularGlossinessTexture },
            };
        }
        const keys = (material.pbrMetallicRoughness ??= {});
        if (material.normalTexture) leaveOut("normal texture");
        if (material.occlusionTexture) leaveOut("occlusion texture");
        if (keys.metallicRoughnessTexture) leaveOut("texture of roughness", "textures of roughness");
        if (keys.metallicRoughnessTexture) delete keys.roughnessFactor;
        for (const key of ["normalTexture", "occlusionTexture"]) delete material[key];
        delete keys.metallicRoughnessTexture;
    }
    // of which the loader makes nothing but warnings where they are missing
    for (const accessor of json.accessors ?? []) Object.assign(accessor, { min: [0, 0, 0], max: [0, 0, 0] });
    leaveOut("other scene", undefined, Math.max(scenes.length - 1, 0));
    leaveOut("animation", undefined, animations.length);
    json.scenes = [{ nodes: roots }];
    for (const key of ["scene", "animations", "cameras"]) delete json[key];
}

/** Check to how many bytes a document unpacks, whose files have so many. */
function checkLengths({ bufferViews = [], accessors = [] }: Json, size: number): void {
    const made = ({ bufferView, sparse, count, componentType, type }: Json): number =>
        bufferView === undefined || sparse ? count * SIZES[componentType] * SIZES[type] : 0;
    const lengths = [...bufferViews.map(({ byteLength }: Json) => byteLength), ...accessors.map(made)];
    const total = lengths.reduce((sum, length) => sum + (Number(length) || 0), 0);
    if (total > Math.max(MOST_BYTES, 4 * size))
        throw new InputError(`it unpacks to ${plural(total, "byte")}, too many for a file of this size`);
}

/** Check how much of a document is shown, before anything of it is made. */
function checkAmounts({ json }: Gltf, size: number): void {
    const { nodes = [], meshes = [], accessors = [] } = json;
    let [parts, triangles, vertices, moves] = [0, 0, 0, 0];
    for (const { mesh, extensions } of nodes) {
        const places = extensions?.EXT_mesh_gpu_instancing?.attributes ?? {};
        const instances = accessors[Object.values<number>(places)[0]]?.count ?? 1;
        for (const { attributes, indices, mode = 4, targets = [] } of meshes[mesh]?.primitives ?? []) {
            const { count } = accessors[attributes.POSITION];
            const corners = accessors[indices]?.count ?? count;
            triangles += instances * Math.max(mode === 4 ? Math.floor(corners / 3) : corners - 2, 0);
            vertices += instances * count;
            moves += instances * count * targets.length;
            if (++parts > MOST_PARTS)
                throw new InputError(`it shows more than ${MOST_PARTS} meshes, each as often as it has nodes`);
            // to move a vertex is an eighth of the work of another one
            checkAmount(triangles, Math.max(vertices, moves / 8), size);
        }
    }
}

/** Return a texture whose name is that of its picture. */
async function textureOf(number: number, gltf: Gltf): Promise<Texture> {
    const { json, pictures, leaveOut } = gltf;
    const { sampler, sources } = json.textures[number];
    const { magFilter, wrapS, wrapT } = json.samplers?.[sampler] ?? {};
    const texture = Object.assign(new Texture(), { name: `textures[${number}]` });
    const image = await firstImage(sources, texture.name, gltf);
    if (!image) return texture;
    if ([wrapS, wrapT].includes(MIRROR)) leaveOut("mirroring of a texture", "mirrorings of textures");
    const wraps = [wrapS === CLAMP ? "clamp" : "repeat", wrapT === CLAMP ? "clamp" : "repeat"] as const;
    const filter = magFilter === NEAREST ? "nearest" : "bilinear";
    pictures.set(texture.name, { image, name: texture.name, hasAlpha: false, filter, wraps, cutoff: 0 });
    return texture;
}

/** Return the first of some images that can be read; undefined, with a note of why the first cannot, if there is none. */
async function firstImage(
    numbers: number[],
    name: string,
    { json, buffers, source }: Gltf,
): Promise<Image | undefined> {
    const notes: string[] = [];
    for (const number of numbers) {
        const image = json.images?.[number] ?? {};
        const { buffer, byteOffset = 0, byteLength } = json.bufferViews?.[image.bufferView] ?? {};
        try {
            // the same bytes for all textures, so that they are decoded once
            image.bytes ??=
                buffers[buffer]?.subarray(byteOffset, byteOffset + byteLength) ?? resource(image.uri, source);
            const found = await imageOf(image.bytes, name, { ...source, tell: (note) => notes.push(note) });
            if (found) return found;
        } catch (error) {
            notes.push(`the texture ${name} is left out: ${(error as Error).message}`);
        }
    }
    source.tell(notes[0] ?? `the texture ${name} is left out: it names no image`);
    return undefined;
}

/** Return how meshes with a material, and these attributes, look; undefined if nothing of them is seen. own: as the document has it. */
function lookOf(
    material: MeshStandardMaterial,
    own: Json,
    attributes: Mesh["geometry"]["attributes"],
    gltf: Gltf,
): Shown | undefined {
    const plain = attributes.color ? 1 : toLinear(GREY[0] / 255);
    let [factor, map, emission] = [own ? material.color.toArray() : [plain, plain, plain], material.map, [0, 0, 0]];
    let unlit = "isMeshBasicMaterial" in material;
    if (own && !unlit) emission = material.emissive.toArray().map((level) => level * material.emissiveIntensity);
    if (own?.emissiveTexture && !unlit) {
        // all that is seen of a black surface is what it emits
        if (emission.some(Boolean) && !factor.some(Boolean))
            [factor, map, unlit] = [emission, material.emissiveMap, true];
        else if (emission.some(Boolean)) gltf.leaveOut("emissive texture");
        emission = [0, 0, 0];
    }
    const { transparent: blended, opacity } = material;
    const cutoff = own?.alphaMode === "MASK" ? material.alphaTest : 0;
    if (opacity < cutoff) return undefined;
    const surface: Surface = {
        opacity: blended ? clamped(opacity, 0, 1) : 1,
        emission: emission.map(toSrgb) as unknown as Surface["emission"],
        unlit,
        twoSided: material.side === DoubleSide,
    };
    // a roughness that is left out, of 1 by the specification, is often not meant
    if (own?.pbrMetallicRoughness.roughnessFactor !== undefined)
        surface.gloss = [material.roughness, material.metalness];
    const picture = gltf.pictures.get(map?.name ?? "");
    if (!map || !picture) return { surface, factor, blended };
    if (!attributes[map.channel ? `uv${map.channel}` : "uv"]) {
        gltf.leaveOut("texture of a primitive without coordinates", "textures of primitives without coordinates");
        return { surface, factor, blended };
    }
    if (map.matrixAutoUpdate) map.updateMatrix();
    const hasAlpha = (blended || cutoff > 0) && hides(picture.image);
    const level = clamped(Math.ceil((255 * cutoff) / Math.max(opacity, 1e-9) - 1e-6), 1, 255);
    surface.picture = { ...picture, hasAlpha, cutoff: hasAlpha && cutoff ? level : 0 };
    return { surface, factor, blended, channel: map.channel, matrix: map.matrix };
}
