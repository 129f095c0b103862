/** A value or bytes that are wrong. The message is one line: what, where, and what would be right. */
export class InputError extends Error {
    override name = "InputError";
}

/** Return `make()`, with a place before the message of an InputError. */
export function about<T>(where: string, make: () => T): T {
    try {
        return make();
    } catch (error) {
        throw error instanceof InputError && where ? new InputError(`${where}: ${error.message}`) : error;
    }
}

/** Return a value as a message shows it. */
export function show(value: unknown): string {
    let text: string | undefined;
    try {
        text = typeof value === "number" ? String(value) : JSON.stringify(value);
    } catch {
        text = undefined; // a cycle, or a bigint
    }
    return (text ?? String(value)).slice(0, 60);
}
