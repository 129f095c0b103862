// The worker's side: it keeps what it is given, and answers requests.

import { errorOf, toldOf, type Message, type Reply, type Table } from "./protocol.js";

/** What a handler can ask of the page. */
export interface Asking {
    /** Return things that the page has, by their keys. InputError where it has not. */
    need(keys: readonly string[]): Promise<unknown[]>;
}

export type Handlers<R extends Table<R>> = {
    [K in keyof R]: (value: R[K][0], page: Asking) => R[K][1] | Promise<R[K][1]>;
};

/** Who waits for something that the page has. */
interface Waiting {
    resolve(value: unknown): void;
    reject(error: Error): void;
}

/** Return what does as messages say, and tells what comes of it. keep: takes what is given. */
export function answering<R extends Table<R>>(
    handlers: Handlers<R>,
    keep: (key: string, value: unknown) => void,
): (message: Message, tell: (reply: Reply) => void) => Promise<void> {
    const lacking = new Map<string, Waiting[]>();
    const wait = (key: string): Promise<unknown> =>
        new Promise((resolve, reject) => lacking.set(key, [...(lacking.get(key) ?? []), { resolve, reject }]));
    const end = (key: string, act: (one: Waiting) => void): void => {
        lacking.get(key)?.forEach(act);
        lacking.delete(key);
    };
    return async (message, tell) => {
        if ("give" in message) {
            for (const [key, value] of message.give) {
                keep(key, value);
                end(key, ({ resolve }) => resolve(value));
            }
            return;
        }
        if ("keys" in message) {
            for (const key of message.keys) end(key, ({ reject }) => reject(errorOf(message.error)));
            return;
        }
        const { id, kind, value } = message;
        const page: Asking = {
            need: (keys) => {
                const lacks = keys.filter((key) => !lacking.has(key));
                if (lacks.length) tell({ id, lacks });
                return Promise.all(keys.map(wait));
            },
        };
        try {
            tell({ id, value: await handlers[kind as keyof R](value as object, page) });
        } catch (error) {
            tell({ id, error: toldOf(error) });
        }
    };
}

/** Answer what the page asks this worker. after: is called after each answer. */
export function serve<R extends Table<R>>(
    handlers: Handlers<R>,
    keep: (key: string, value: unknown) => void = () => undefined,
    after: () => unknown = () => undefined,
): void {
    const answer = answering(handlers, keep);
    const tell = (reply: Reply): void => self.postMessage(reply, { transfer: buffersOf(reply) });
    self.onmessage = ({ data }: MessageEvent<Message>) => void answer(data, tell).then(after);
}

/** Return the buffers of an answer that are not copied but handed over. */
function buffersOf(reply: Reply): ArrayBuffer[] {
    const value = "value" in reply ? reply.value : null;
    if (value instanceof Uint8Array) return [value.buffer as ArrayBuffer];
    const { pixels, bmp } = (value ?? {}) as { pixels?: Uint8ClampedArray; bmp?: Uint8Array };
    return [pixels, bmp].flatMap((bytes) => (bytes instanceof Object ? [bytes.buffer as ArrayBuffer] : []));
}
