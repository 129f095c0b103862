// The worker of a view as the page sees it: started when needed, ended when it takes too long.

import script from "worker:view/worker.ts";
import type { Assets } from "../evm/assets.js";
import type { Kind, Reply, Request, Requests } from "./protocol.js";

/** What a worker says that a page asked for: a wrong scene, a call that failed or took too long. */
export class ViewError extends Error {
    override name = "ViewError";
}

/** An answer that nobody waits for any more. */
export class Interrupted extends Error {
    override name = "Interrupted";

    constructor() {
        super("the scene changed");
    }
}

interface Waiting {
    resolve(value: Requests[Kind][1]): void;
    reject(error: Error): void;
    timer: number;
}

let scriptUrl: string | null = null;

export class Client {
    /** What a new worker begins with. */
    call: Uint8Array | null = null;
    readonly #assets: () => Promise<Assets>;
    readonly #waiting = new Map<number, Waiting>();
    #worker: Promise<Worker> | null = null;
    #last = 0;
    #stops = 0;

    constructor(assets: () => Promise<Assets>) {
        this.#assets = assets;
    }

    /** Return the worker's answer. ViewError for its refusal, or after so many milliseconds, which end the worker. */
    async ask<K extends Kind>(kind: K, value: Requests[K][0], milliseconds: number): Promise<Requests[K][1]> {
        const starting = (this.#worker ??= this.#start());
        let worker: Worker;
        try {
            worker = await starting;
        } catch (error) {
            // what could not be loaded may be there later
            if (starting === this.#worker) this.#worker = null;
            throw error;
        }
        if (starting !== this.#worker) throw new Interrupted();
        return this.#post(worker, kind, value, milliseconds);
    }

    /** End the worker, with all that it was asked; the next question starts another. */
    stop(reason: Error = new Interrupted()): void {
        this.#stops++;
        void this.#worker?.then((worker) => worker.terminate()).catch(() => undefined);
        this.#worker = null;
        for (const { reject, timer } of this.#waiting.values()) {
            clearTimeout(timer);
            reject(reason);
        }
        this.#waiting.clear();
    }

    async #start(): Promise<Worker> {
        const stops = this.#stops;
        const { module, contracts } = await this.#assets();
        if (stops !== this.#stops) throw new Interrupted();
        scriptUrl ??= URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
        const worker = new Worker(scriptUrl);
        worker.onmessage = ({ data }: MessageEvent<Reply>) => {
            const waiting = this.#waiting.get(data.id);
            if (!waiting) return;
            this.#waiting.delete(data.id);
            clearTimeout(waiting.timer);
            if ("error" in data) waiting.reject(new ViewError(data.error));
            else waiting.resolve(data.value);
        };
        worker.onerror = (event) => {
            event.preventDefault();
            this.stop(
                new ViewError(
                    `the worker failed: ${event.message || "this page does not allow it (worker-src blob:)"}`,
                ),
            );
        };
        void this.#post(worker, "start", { module, contracts, call: this.call }, START).catch(() => undefined);
        return worker;
    }

    #post<K extends Kind>(
        worker: Worker,
        kind: K,
        value: Requests[K][0],
        milliseconds: number,
    ): Promise<Requests[K][1]> {
        const id = ++this.#last;
        return new Promise((resolve, reject) => {
            const timer = window.setTimeout(() => {
                const seconds = (milliseconds / 1000).toLocaleString("en");
                this.stop(new ViewError(`the contracts took longer than ${seconds} s, and were stopped`));
            }, milliseconds);
            this.#waiting.set(id, { resolve: resolve as Waiting["resolve"], reject, timer });
            worker.postMessage({ id, kind, value } satisfies Request<K>);
        });
    }
}

/** Milliseconds in which a worker must have started. */
const START = 60_000;
