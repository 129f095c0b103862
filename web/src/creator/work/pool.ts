// Workers: one for the picture, the others for all else; started when needed, ended to cancel what they do. The picture has a
// second one in reserve, which takes over at once where the first is ended.

import { InputError } from "../../errors.js";
import type { Document } from "../../document/document.js";
import {
    Cancelled,
    NEEDS,
    errorOf,
    keyOf,
    type Kind,
    type Message,
    type Reply,
    type Requests,
    type Supplies,
} from "./protocol.js";

export type Lane = "picture" | "background";

/** What a pool needs of a `Worker`. */
export interface WorkerLike {
    postMessage(message: Message): void;
    terminate(): void;
    onmessage: ((event: { data: Reply }) => void) | null;
    onerror: ((event: { message?: string; preventDefault?(): void }) => void) | null;
}

/** Where workers and what they keep come from. */
export interface Source {
    start(): WorkerLike;
    supply(name: "evm" | "more" | "stages"): Promise<Supplies>;
    /** The meshes of a document by their keys; loads what is missing. */
    meshes(doc: Document): Promise<Map<string, NonNullable<Supplies["meshes"]>[number][1]>>;
}

interface Job {
    /** 0 for what the reserve does. */
    id: number;
    kind: Kind;
    value: object;
    resolve(value: unknown): void;
    reject(error: unknown): void;
}

/** A worker, what it was given, what it does, and the number of its last job; -1 for none that was started. */
interface Hand {
    worker: WorkerLike | null;
    given: Set<string>;
    job: Job | null;
    last: number;
}

/** Milliseconds of rest after which the reserve is prepared, and the side of the picture that it draws then. */
const REST = 400;
const SMALL = 16;
/** Meshes that a worker keeps. */
const MOST_KEPT = 200;

export class Pool {
    readonly #source: Source;
    readonly #lanes: Record<Lane, { hands: Hand[]; queue: Job[] }>;
    #last = 0;
    #timer: ReturnType<typeof setTimeout> | undefined;

    /** Take the number of workers, at least two. */
    constructor(source: Source, size: number) {
        this.#source = source;
        const hands = (count: number): Hand[] =>
            Array.from({ length: count }, () => ({ worker: null, given: new Set<string>(), job: null, last: -1 }));
        this.#lanes = {
            picture: { hands: hands(2), queue: [] },
            background: { hands: hands(Math.max(1, size - 1)), queue: [] },
        };
    }

    /** Return the answer of a worker. Cancelled after `signal`, which ends the worker if it works on this already. */
    ask<K extends Kind>(kind: K, value: Requests[K][0], lane: Lane, signal?: AbortSignal): Promise<Requests[K][1]> {
        return new Promise((resolve, reject) => {
            const job: Job = { id: ++this.#last, kind, value, resolve: resolve as Job["resolve"], reject };
            if (signal?.aborted) {
                reject(new Cancelled());
                return;
            }
            signal?.addEventListener("abort", () => this.#cancel(job, lane), { once: true });
            this.#lanes[lane].queue.push(job);
            this.#next(lane);
        });
    }

    /** End all that was asked. */
    cancelAll(): void {
        for (const lane of ["picture", "background"] as const) {
            const { hands, queue } = this.#lanes[lane];
            for (const job of [...queue, ...hands.flatMap(({ job }) => job ?? [])]) this.#cancel(job, lane);
        }
    }

    #cancel(job: Job, lane: Lane): void {
        const { hands, queue } = this.#lanes[lane];
        const place = queue.indexOf(job);
        if (place >= 0) queue.splice(place, 1);
        const hand = hands.find((each) => each.job === job);
        if (hand) this.#end(hand);
        job.reject(new Cancelled());
        this.#next(lane);
    }

    /** End a worker; the next job starts another. */
    #end(hand: Hand): void {
        hand.worker?.terminate();
        Object.assign(hand, { worker: null, given: new Set(), job: null, last: -1 } satisfies Hand);
    }

    #next(lane: Lane): void {
        const { hands, queue } = this.#lanes[lane];
        // what was used last remembers most
        for (const hand of hands.filter(({ job }) => !job).sort((a, b) => b.last - a.last)) {
            const job = queue.shift();
            if (job) this.#give(hand, job, lane);
        }
    }

    #give(hand: Hand, job: Job, lane: Lane): void {
        hand.job = job;
        this.#run(hand, job, lane).catch((error: unknown) => {
            job.reject(error);
            this.#free(hand, job, lane);
        });
    }

    /** Let the reserve draw a small picture of new meshes, so that it remembers them. */
    #prepare({ value }: Job): void {
        clearTimeout(this.#timer);
        this.#timer = setTimeout(() => {
            const reserve = this.#lanes.picture.hands.reduce((a, b) => (a.last < b.last ? a : b));
            const { doc } = value as { doc: Document };
            if (reserve.job || doc.objects.every(({ mesh }) => reserve.given.has(keyOf(mesh)))) return;
            const small = { doc, width: SMALL, height: SMALL, antialias: false };
            const nothing = (): void => undefined;
            const job: Job = { id: 0, kind: "draw", value: small, resolve: nothing, reject: nothing };
            this.#give(reserve, job, "picture");
        }, REST);
    }

    async #run(hand: Hand, job: Job, lane: Lane): Promise<void> {
        const needs = ["evm" as const, NEEDS[job.kind] ?? []].flat();
        const supplies = await Promise.all(needs.map(async (name) => [name, await this.#source.supply(name)] as const));
        const meshes =
            "doc" in job.value ? await this.#source.meshes(job.value.doc as Document) : new Map<string, never>();
        // it may have been cancelled meanwhile
        if (hand.job !== job) return;
        // a worker that would keep too much is replaced
        if (hand.given.size + meshes.size > MOST_KEPT) this.#end(hand);
        hand.job = job;
        hand.worker ??= this.#start(hand, lane);
        const give = supplies.filter(([name]) => !hand.given.has(name));
        const missing = [...meshes].filter(([key]) => !hand.given.has(key));
        if (give.length || missing.length) {
            hand.worker.postMessage({
                give: Object.assign({ meshes: missing }, ...give.map(([, supply]) => supply)) as Supplies,
            });
            for (const [key] of [...give, ...missing]) hand.given.add(key);
        }
        hand.last = job.id;
        hand.worker.postMessage({ id: job.id, kind: job.kind, value: job.value });
    }

    #start(hand: Hand, lane: Lane): WorkerLike {
        const worker = this.#source.start();
        worker.onmessage = ({ data }) => {
            const { job } = hand;
            if (job?.id !== data.id) return;
            if ("error" in data) job.reject(errorOf(data.error));
            else job.resolve(data.value);
            this.#free(hand, job, lane);
        };
        worker.onerror = (event) => {
            event.preventDefault?.();
            const { job } = hand;
            this.#end(hand);
            job?.reject(
                new InputError(
                    `The worker failed: ${event.message ?? "this page does not allow it (worker-src blob:)"}`,
                ),
            );
            this.#next(lane);
        };
        return worker;
    }

    #free(hand: Hand, job: Job, lane: Lane): void {
        if (hand.job === job) hand.job = null;
        this.#next(lane);
        if (lane === "picture") this.#prepare(job);
    }
}

/** Return the meshes of a document by their keys. */
export function meshesOf<T>(doc: Document, get: (ref: Document["objects"][number]["mesh"]) => T): Map<string, T> {
    return new Map(doc.objects.map(({ mesh }) => [keyOf(mesh), get(mesh)]));
}
