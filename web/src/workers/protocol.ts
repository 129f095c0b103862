// What a page tells its workers, and what they tell it: the same for all of them.

import { InputError } from "../errors.js";
import { CallError } from "../evm/contracts.js";

/** What workers are asked, by kind: a question and its answer. */
export type Table<R> = { [K in keyof R]: [object, unknown] };

/** To a worker: things to keep, by their keys; that some cannot be had; or a request. */
export type Message =
    | { give: readonly (readonly [key: string, value: unknown])[] }
    | { keys: readonly string[]; error: Told }
    | { id: number; kind: string; value: unknown };

/** From a worker, of a request: what it lacks, its answer or an error. */
export type Reply = { id: number } & ({ lacks: readonly string[] } | { value: unknown } | { error: Told });

/** An error. */
export interface Told {
    name: string;
    message: string;
}

/** What nobody waits for any more. */
export class Cancelled extends Error {
    override name = "Cancelled";

    constructor() {
        super("it was cancelled");
    }
}

/** Return an error as it is told. */
export function toldOf(error: unknown): Told {
    const { name, message } = error instanceof Error ? error : new Error(String(error));
    return { name, message };
}

/** Return the error that was told. */
export function errorOf({ name, message }: Told): Error {
    if (name === "InputError") return new InputError(message);
    return name === "CallError" ? new CallError(message) : new Error(message);
}
