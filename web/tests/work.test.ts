import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import type { Document, MeshRef, StoredMesh } from "../src/document/document.js";
import { compressZeros } from "../src/creator/work/compact.js";
import { fitted } from "../src/creator/work/fit.js";
import { Host } from "../src/creator/work/host.js";
import { handlersOf } from "../src/creator/work/handlers.js";
import { idAt } from "../src/creator/work/pick.js";
import { Cancelled, Work } from "../src/creator/work/work.js";
import { CallError, InputError } from "../src/index.js";
import { Pool, type WorkerLike } from "../src/workers/pool.js";
import type { Message } from "../src/workers/protocol.js";
import { answering, type Handlers } from "../src/workers/serve.js";
import { TETRAHEDRON } from "./tetrahedron.js";

const FILES: Record<string, string> = {
    "evm.wasm": "../src/shackled/evm/evm.wasm",
    "contracts.json": "../src/shackled/web/contracts.json",
    "stages.json": "../src/shackled/web/stages.json",
};
const assets = {
    bytes: async (name: string) => new Uint8Array(readFileSync(FILES[name])),
    text: async (name: string) => readFileSync(FILES[name], "utf8"),
    json: async (name: string) => JSON.parse(readFileSync(FILES[name], "utf8")) as never,
};
const STORED = {
    mesh: {
        positions: Float64Array.from(TETRAHEDRON.positions.flat()),
        faces: Uint32Array.from(TETRAHEDRON.faces.flat()),
        colors: new Uint8Array(12).fill(200),
        ...{ normals: undefined, uvs: undefined, opacities: undefined },
    },
    ...{ closed: true, triangles: 4, vertices: 4, radius: 2, title: "", notice: "", licence: "" },
} satisfies StoredMesh;
const DOC: Document = {
    ...{ title: "Two", notice: "", licence: "", frame: { middle: [0, 0, 0], radius: 3 } },
    objects: [-1.5, 1.5].map((x, index) => ({
        ...{
            id: String(index),
            name: "",
            mesh: { file: `mesh${index}` },
            position: [x, 0, 0],
            rotation: [0, 0, 0],
            scale: 1,
        },
        material: { shading: "flat", ambient: 0.3, diffuse: 0.7, specular: 0, shininess: 1, emission: "#000000" },
        ...{ color: null, crease: null, maxTriangles: null, opacity: 1, cull: true, wireframe: false, twoSided: false },
    })),
    camera: {
        eye: [0, 0, 8],
        target: [0, 0, 0],
        up: [0, 1, 0],
        projection: "perspective",
        halfHeight: 0.5,
        near: null,
    },
    lights: [{ kind: "directional", direction: [0, 1, 1], color: "#ffffff", shadow: false }],
    ...{ lightsFollow: false, ambientLight: "#ffffff", background: { top: "#101010", bottom: "#202020" } },
    ...{ invert: false, antialias: true, hemisphere: null, rim: null, fog: null, tone: null, ground: null },
    ...{ width: 64, height: 32 },
};

function hostAnswers(): ReturnType<typeof answering> {
    const host = new Host();
    return answering(handlersOf(host), host.keep);
}

/** Workers in this thread, each of which answers after the turn in which it was asked. */
class Workers {
    readonly #answering: () => ReturnType<typeof answering>;
    readonly messages: Message[][] = [];
    ended = 0;
    #answers = 0;

    constructor(answers = hostAnswers) {
        this.#answering = answers;
    }

    readonly start = (): WorkerLike => {
        const answer = this.#answering();
        const messages: Message[] = [];
        this.messages.push(messages);
        let alive = true;
        const worker: WorkerLike = {
            onmessage: null,
            onerror: null,
            terminate: () => {
                this.ended++;
                alive = false;
            },
            postMessage: (message) => {
                messages.push(message);
                setTimeout(async () => {
                    await answer(structuredClone(message), (reply) => {
                        if (!alive) return;
                        worker.onmessage?.({ data: structuredClone(reply) });
                        this.#answers++;
                    });
                }, 5);
            },
        };
        return worker;
    };

    async answered(count: number): Promise<void> {
        while (this.#answers < count) await new Promise((resolve) => setTimeout(resolve, 5));
    }

    given(): string[] {
        return this.messages
            .flat()
            .flatMap((message) => ("give" in message ? message.give.map(([key]) => key) : []))
            .filter((key) => key.startsWith("mesh"));
    }
}

const store = {
    get: (ref: MeshRef) => {
        if ("file" in ref && ref.file.startsWith("mesh")) return STORED;
        throw new InputError("it is not there");
    },
};

function working(size = 2): { work: Work; workers: Workers } {
    const workers = new Workers();
    return { work: new Work(assets, store, workers.start, size), workers };
}

test("a worker keeps meshes, of which a movement sends none", async () => {
    const { work, workers } = working();
    const drawn = await work.draw(DOC, { bmp: true });
    assert.deepEqual([drawn.width, drawn.height, drawn.pixels.length, drawn.triangles], [64, 32, 8192, 8]);
    assert.ok(drawn.gas > 100_000 && drawn.calldata > 1000 && drawn.milliseconds > 0);
    assert.equal(String.fromCharCode(...drawn.bmp!.subarray(0, 2)), "BM");
    const small = await work.draw(
        { ...DOC, camera: { ...DOC.camera, eye: [1, 0, 8] } },
        { width: 16, height: 8, antialias: false },
    );
    assert.deepEqual([small.width, small.height, small.bmp], [16, 8, undefined]);
    assert.deepEqual(workers.given(), ["mesh0", "mesh1"]);
    assert.equal(workers.messages.length, 1);
    // the reserve is given them, too
    await workers.answered(3);
    assert.deepEqual([workers.messages.length, workers.given().length], [2, 4]);
});

test("figures", async () => {
    const { work, workers } = working(3);
    const [counts, call, profile, enough, little] = await Promise.all([
        work.count(DOC),
        work.call(DOC),
        work.profile(DOC),
        work.suffices(DOC, 10_000_000),
        work.suffices(DOC, 50_000),
    ]);
    const drawn = await work.draw(DOC, { lane: "background" });
    assert.ok(counts.triangles >= 4 && counts.pixels > 50);
    assert.equal(call.length, drawn.calldata);
    assert.equal(
        profile.reduce((sum, { gas }) => sum + gas, 0),
        drawn.gas,
    );
    assert.deepEqual([enough, little], [true, false]);
    assert.equal(workers.messages.length, 2);
});

test("what is under a point", async () => {
    const { work } = working();
    const found = await Promise.all([0.4, 0.6, 0.02].map((x) => work.pick(DOC, x, 0.5)));
    assert.deepEqual(found, [0, 1, -1]);
    const ids = { width: 3, height: 1, ids: Int32Array.of(-1, -1, 4) };
    assert.deepEqual(
        [0.1, 0.5, 0.9, 1].map((x) => idAt(ids, x, 0)),
        [-1, 4, 4, 4],
    );
});

test("errors keep their kind", async () => {
    const { work } = working();
    const lost = { ...DOC, objects: [{ ...DOC.objects[0], mesh: { file: "lost" } }] };
    await assert.rejects(work.draw(lost), { name: "InputError", message: "it is not there" });
    await assert.rejects(work.draw({ ...DOC, camera: { ...DOC.camera, eye: [0, 0, 0] } }), InputError);
    await assert.rejects(work.suffices({ ...DOC, width: 0 }, 1000), InputError);
    const far = { ...DOC.camera, projection: "orthographic" as const, halfHeight: 1e9 };
    await work.draw({ ...DOC, camera: far }).catch((error: unknown) => assert.ok(error instanceof CallError));
    assert.equal((await work.draw(DOC)).width, 64);
});

test("what is cancelled ends, and nothing else", async () => {
    const { work, workers } = working();
    const [first, queued] = [new AbortController(), new AbortController()];
    const background = work.count(DOC, { signal: first.signal });
    const waiting = work.count(DOC, { signal: queued.signal });
    const last = work.count(DOC);
    queued.abort();
    await assert.rejects(waiting, Cancelled);
    assert.equal(workers.ended, 0);
    await new Promise((resolve) => setTimeout(resolve, 2));
    first.abort();
    await assert.rejects(background, Cancelled);
    assert.ok((await last).triangles);
    await assert.rejects(work.count(DOC, { signal: AbortSignal.abort() }), Cancelled);
    const all = [work.draw(DOC), work.count(DOC), work.count(DOC)];
    work.cancelAll();
    for (const each of all) await assert.rejects(each, Cancelled);
    assert.equal((await work.draw(DOC)).width, 64);
});

test("the reserve takes over", async () => {
    const { work, workers } = working();
    await work.draw(DOC);
    await workers.answered(2);
    const stopped = new AbortController();
    const drawing = work.draw(DOC, { signal: stopped.signal });
    await new Promise((resolve) => setTimeout(resolve, 2));
    stopped.abort();
    await assert.rejects(drawing, Cancelled);
    await work.draw(DOC);
    assert.deepEqual([workers.messages.length, workers.ended, workers.given().length], [2, 1, 4]);
});

test("the largest canvas that fits, then the most triangles", async () => {
    const doc = { ...DOC, width: 512, height: 256 };
    const large = { get: () => ({ ...STORED, triangles: 1000 }) };
    const parts: number[] = [];
    const onProgress = (part: number): void => void parts.push(part);
    const of = (fits: (doc: Document) => boolean): Promise<Document> =>
        fitted(doc, large, (changed) => Promise.resolve(fits(changed)), { onProgress });
    assert.equal(await of(() => true), doc);
    const smaller = await of(({ width }) => width <= 300);
    assert.deepEqual([smaller.width, smaller.height, smaller.objects], [296, 148, doc.objects]);
    assert.ok(parts.length > 3 && parts.every((part) => part >= 0 && part < 1));
    const fewer = await of(({ objects }) => (objects[0].maxTriangles ?? 1000) <= 200);
    assert.deepEqual([fewer.width, fewer.antialias, fewer.objects[0].maxTriangles], [128, true, 197]);
    assert.equal((await of(({ antialias, width }) => !antialias && width < 100)).width, 96);
    await assert.rejects(
        of(() => false),
        InputError,
    );
    const signal = AbortSignal.abort();
    await assert.rejects(
        fitted(doc, large, () => Promise.resolve(true), { signal }),
        Cancelled,
    );
});

test("runs of zeros", () => {
    const bytes = Uint8Array.of(...new Array<number>(130).fill(0), 7, 255, 255, 9);
    assert.deepEqual([...compressZeros(bytes)], [255, 128, 255, 254, 7, 0, 129, 9]);
});

interface Questions {
    sum: [{ of: string[] }, number];
    sleep: [object, null];
}

function asking(): { pool: Pool<Questions, "one">; workers: Workers; asked: string[] } {
    const asked: string[] = [];
    const handlers: Handlers<Questions> = {
        sum: async ({ of }, { need }) => {
            const [found, again] = await Promise.all([need(of), need(of)]);
            assert.deepEqual(found, again);
            return (found as number[]).reduce((a, b) => a + b, 0);
        },
        sleep: () => new Promise(() => undefined),
    };
    const workers = new Workers(() => answering(handlers, () => undefined));
    const supplies = async (lacks: readonly string[]): Promise<Map<string, unknown>> => {
        asked.push(...lacks);
        if (lacks.includes("x")) throw new InputError("there is no x");
        return new Map(lacks.map((key) => [key, Number(key)]));
    };
    const pool = new Pool<Questions, "one">({ start: async () => workers.start(), supplies }, { one: 1 });
    return { pool, workers, asked };
}

test("a worker asks for what it lacks", async () => {
    const { pool, asked, workers } = asking();
    assert.equal(await pool.ask("sum", { of: ["1", "2"] }, "one"), 3);
    assert.deepEqual(asked, ["1", "2"]);
    await assert.rejects(pool.ask("sum", { of: ["x"] }, "one"), { name: "InputError", message: "there is no x" });
    assert.equal(await pool.ask("sum", { of: ["4"] }, "one"), 4);
    assert.equal(workers.ended, 0);
});

test("what takes too long ends, and so does what is ended before its worker has started", async () => {
    const { pool, workers } = asking();
    await assert.rejects(pool.ask("sleep", {}, "one", { limit: 30 }), /took longer than 0.03 s, and were stopped/);
    assert.equal(workers.ended, 1);
    const stop = new AbortController();
    const asleep = pool.ask("sleep", {}, "one", { signal: stop.signal });
    stop.abort();
    await assert.rejects(asleep, Cancelled);
    assert.equal(await pool.ask("sum", { of: ["5"] }, "one"), 5);
    pool.stop();
    assert.equal(workers.ended, workers.messages.length);
});
