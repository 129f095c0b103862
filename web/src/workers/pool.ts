// The page's side: workers in lanes, started when needed, and ended to cancel what they do. A lane of several workers has one
// in reserve, which takes over at once where another is ended.

import { InputError } from "../errors.js";
import { Cancelled, errorOf, toldOf, type Message, type Reply, type Table } from "./protocol.js";

/** What a pool needs of a `Worker`. */
export interface WorkerLike {
    postMessage(message: Message): void;
    terminate(): void;
    onmessage: ((event: { data: Reply }) => void) | null;
    onerror: ((event: { message?: string; preventDefault?(): void }) => void) | null;
}

/** Where workers and what they keep come from. */
export interface Source<R> {
    start(): WorkerLike | Promise<WorkerLike>;
    /** Return what a request needs, by keys, of which a worker is given each once; or only what the worker says that it lacks. */
    supplies(lacks: readonly string[], kind: keyof R, value: object): Promise<ReadonlyMap<string, unknown>>;
}

/** limit: milliseconds that the answer may take. */
export interface AskOptions {
    signal?: AbortSignal | undefined;
    limit?: number;
}

interface Job<R> extends AskOptions {
    /** 0 for what the reserve does. */
    id: number;
    kind: keyof R;
    value: object;
    timer?: ReturnType<typeof setTimeout>;
    resolve(value: unknown): void;
    reject(error: unknown): void;
}

/** A worker, what it was given, what it does, and the number of its last job; -1 for none that was started. */
interface Hand<R> {
    worker: WorkerLike | null;
    given: Set<string>;
    job: Job<R> | null;
    last: number;
}

/** The workers of a lane, and what waits for one. */
interface Queue<R> {
    hands: Hand<R>[];
    queue: Job<R>[];
}

/** What a worker keeps at most. */
const MOST_KEPT = 200;

const urls = new Map<string, string>();

/** Start a worker of a script. place: of another frame. */
export function started(script: string, place: typeof globalThis = globalThis): WorkerLike {
    const known = place === globalThis ? urls.get(script) : undefined;
    const url = known ?? place.URL.createObjectURL(new place.Blob([script], { type: "text/javascript" }));
    if (place === globalThis) urls.set(script, url);
    return new place.Worker(url) as WorkerLike;
}

export class Pool<R extends Table<R>, L extends string> {
    readonly #source: Source<R>;
    readonly #lanes: Record<L, Queue<R>>;
    #last = 0;

    /** Take the number of workers of each lane. */
    constructor(source: Source<R>, lanes: Record<L, number>) {
        this.#source = source;
        const hands = (length: number): Hand<R>[] =>
            Array.from({ length }, () => ({ worker: null, given: new Set<string>(), job: null, last: -1 }));
        const made = Object.entries<number>(lanes).map(([lane, count]) => [lane, { hands: hands(count), queue: [] }]);
        this.#lanes = Object.fromEntries(made) as Record<L, Queue<R>>;
    }

    /**
     * Return the answer of a worker. Cancelled after `signal`, which ends the worker if it works on this already, as
     * `limit` does.
     */
    ask<K extends keyof R>(kind: K, value: R[K][0], lane: L, options: AskOptions = {}): Promise<R[K][1]> {
        return new Promise((resolve, reject) => {
            const own = { resolve: resolve as Job<R>["resolve"], reject };
            const job: Job<R> = { ...options, ...own, id: ++this.#last, kind, value };
            if (job.signal?.aborted) {
                reject(new Cancelled());
                return;
            }
            job.signal?.addEventListener("abort", () => this.#cancel(job, lane), { once: true });
            this.#lanes[lane].queue.push(job);
            this.#next(lane);
        });
    }

    /** Let the reserve of a lane do something that nobody waits for, unless it was given all of this already. */
    prepare<K extends keyof R>(kind: K, value: R[K][0], lane: L, keys: readonly string[]): void {
        const reserve = this.#lanes[lane].hands.reduce((a, b) => (a.last < b.last ? a : b));
        if (reserve.job || keys.every((key) => reserve.given.has(key))) return;
        const nothing = (): void => undefined;
        this.#give(reserve, { id: 0, kind, value, resolve: nothing, reject: nothing }, lane);
    }

    /** End all workers, and all that was asked. */
    stop(): void {
        for (const lane of Object.keys(this.#lanes) as L[]) {
            const { hands, queue } = this.#lanes[lane];
            for (const job of [...queue, ...hands.flatMap(({ job }) => job ?? [])]) this.#cancel(job, lane);
            for (const hand of hands) this.#end(hand);
        }
    }

    #cancel(job: Job<R>, lane: L, reason: Error = new Cancelled()): void {
        const { hands, queue } = this.#lanes[lane];
        const place = queue.indexOf(job);
        if (place >= 0) queue.splice(place, 1);
        const hand = hands.find((each) => each.job === job);
        if (hand) this.#end(hand);
        job.reject(reason);
        this.#next(lane);
    }

    /** End a worker; the next job starts another. */
    #end(hand: Hand<R>): void {
        hand.worker?.terminate();
        clearTimeout(hand.job?.timer);
        Object.assign(hand, { worker: null, given: new Set(), job: null, last: -1 } satisfies Hand<R>);
    }

    #next(lane: L): void {
        const { hands, queue } = this.#lanes[lane];
        // what was used last remembers most
        for (const hand of hands.filter(({ job }) => !job).sort((a, b) => b.last - a.last)) {
            const job = queue.shift();
            if (job) this.#give(hand, job, lane);
        }
    }

    #give(hand: Hand<R>, job: Job<R>, lane: L): void {
        hand.job = job;
        this.#run(hand, job, lane).catch((error: unknown) => {
            job.reject(error);
            this.#free(hand, job, lane);
        });
    }

    async #run(hand: Hand<R>, job: Job<R>, lane: L): Promise<void> {
        const { id, kind, value, limit } = job;
        const supplies = await this.#source.supplies([], kind, value);
        // it may have been cancelled meanwhile
        if (hand.job !== job) return;
        // a worker that would keep too much is replaced
        if (hand.given.size + supplies.size > MOST_KEPT) this.#end(hand);
        hand.job = job;
        const worker = hand.worker ?? (await this.#source.start());
        if (hand.job !== job) return worker.terminate();
        if (!hand.worker) this.#listen(hand, worker, lane);
        const give = [...supplies].filter(([key]) => !hand.given.has(key));
        if (give.length) worker.postMessage({ give });
        for (const [key] of give) hand.given.add(key);
        hand.last = id;
        worker.postMessage({ id, kind: String(kind), value });
        if (!limit) return;
        const words = `the contracts took longer than ${(limit / 1000).toLocaleString("en")} s, and were stopped`;
        job.timer = setTimeout(() => this.#cancel(job, lane, new InputError(words)), limit);
    }

    #listen(hand: Hand<R>, worker: WorkerLike, lane: L): void {
        hand.worker = worker;
        worker.onmessage = ({ data }) => {
            const { job } = hand;
            if (job?.id !== data.id) return;
            if ("lacks" in data) return void this.#supply(worker, job, data.lacks);
            if ("error" in data) job.reject(errorOf(data.error));
            else job.resolve(data.value);
            this.#free(hand, job, lane);
        };
        worker.onerror = (event) => {
            event.preventDefault?.();
            const { job } = hand;
            const why = event.message || "this page does not allow it (worker-src blob:)";
            if (job) this.#cancel(job, lane, new InputError(`The worker failed: ${why}`));
            else this.#end(hand);
        };
    }

    async #supply(worker: WorkerLike, { kind, value }: Job<R>, keys: readonly string[]): Promise<void> {
        try {
            worker.postMessage({ give: [...(await this.#source.supplies(keys, kind, value))] });
        } catch (error) {
            worker.postMessage({ keys, error: toldOf(error) });
        }
    }

    #free(hand: Hand<R>, job: Job<R>, lane: L): void {
        clearTimeout(job.timer);
        if (hand.job === job) hand.job = null;
        this.#next(lane);
    }
}
