// Checked access to tables of a JSON document; every message says where the error is.

import { InputError, show } from "../errors.js";
import type { Vector } from "./arithmetic.js";
import * as check from "./checks.js";

/**
 * A table of a document, with its place for messages.
 *
 * known: the keys that it may have; any where it is left out.
 */
export class Table {
    readonly values: Readonly<Record<string, unknown>>;

    constructor(
        value: unknown,
        readonly where: string,
        known?: readonly string[],
    ) {
        if (typeof value !== "object" || value === null || Array.isArray(value)) {
            const keys = known ? ` with keys of ${known.join(", ")}` : "";
            throw new InputError(`${where || "a scene"} must be a table${keys}, not ${show(value)}`);
        }
        this.values = { ...value } as Record<string, unknown>;
        const unknown = Object.keys(this.values).find((key) => known && !known.includes(key));
        if (known && unknown !== undefined) {
            const place = where && ` in ${where}`;
            throw new InputError(`unknown key ${show(unknown)}${place}; known are ${known.join(", ")}`);
        }
    }

    place(key: string): string {
        return this.where ? `${this.where}.${key}` : key;
    }

    has(key: string): boolean {
        return Object.hasOwn(this.values, key);
    }

    get(key: string): unknown {
        return this.has(key) ? this.values[key] : undefined;
    }

    /** Return the value as `read` gives it, undefined where there is none. */
    read<T>(key: string, read: (value: unknown, where: string) => T): T | undefined {
        return this.has(key) ? read(this.get(key), this.place(key)) : undefined;
    }

    number(key: string, low?: number, high?: number): number | undefined {
        return this.read(key, (value, where) => check.number(value, where, low, high));
    }

    table(key: string, known?: readonly string[]): Table {
        return new Table(this.has(key) ? this.get(key) : {}, this.place(key), known);
    }

    list(key: string): unknown[] {
        const value = this.has(key) ? this.get(key) : [];
        if (Array.isArray(value)) return value as unknown[];
        throw new InputError(`${this.place(key)} must be a list, not ${show(value)}`);
    }

    /** Return a list of rows of three numbers. */
    rows(key: string): Vector[] {
        return this.list(key).map((row, index) => check.vector(row, `${this.place(key)}[${index}]`));
    }
}

/** Return a name of JavaScript as scene files have it. */
export function snake(name: string): string {
    return name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
}
