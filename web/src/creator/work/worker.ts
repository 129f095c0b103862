// The worker: it keeps contracts and meshes, and answers one request after the other.

import { Machine } from "./machine.js";
import type { Message, Reply } from "./protocol.js";

const machine = new Machine();
/** Requests are answered in their order, as one may wait for a library that simplifies. */
let last = Promise.resolve();

self.onmessage = ({ data }: MessageEvent<Message>) => {
    last = last.then(async () => {
        const reply = await machine.reply(data);
        if (reply) self.postMessage(reply, { transfer: buffersOf(reply) });
        void machine.compile();
    });
};

/** Return the buffers of an answer that are not copied but handed over. */
function buffersOf(reply: Reply): ArrayBuffer[] {
    const value = "value" in reply ? reply.value : null;
    if (value instanceof Uint8Array) return [value.buffer as ArrayBuffer];
    const { pixels, bmp } = (value ?? {}) as { pixels?: Uint8ClampedArray; bmp?: Uint8Array };
    return [pixels, bmp].flatMap((bytes) => (bytes instanceof Object ? [bytes.buffer as ArrayBuffer] : []));
}
