// What a worker does: the contracts draw, count and encode scenes of documents.

import { prepare } from "../../document/document.js";
import { InputError } from "../../errors.js";
import { drawCall, withFunction } from "../../picture.js";
import { fileOf, gifOf } from "./encoders.js";
import { fitsIn } from "./fit.js";
import { genesisOf } from "./genesis.js";
import { Host } from "./host.js";
import { idsOf } from "./pick.js";
import type { Kind, Message, Reply, Requests } from "./protocol.js";
import { quoteOf } from "./quote.js";
import { stagesOf } from "./stages.js";
import { pathOf, seenFrom } from "./turntable.js";

export class Machine extends Host {
    /** Do what a message asks. */
    async reply(message: Message): Promise<Reply | null> {
        if ("give" in message) {
            this.keep(message.give);
            return null;
        }
        const { id, kind, value } = message;
        try {
            return { id, value: await this.answer(kind, value as Requests[Kind][0]) };
        } catch (error) {
            const { name, message } = error instanceof Error ? error : new Error(String(error));
            return { id, error: { name, message } };
        }
    }

    async answer<K extends Kind>(kind: K, value: Requests[K][0]): Promise<Requests[K][1]> {
        if ("doc" in value) await prepare(value.doc, this);
        return this.#handlers[kind](value);
    }

    readonly #handlers: { [K in Kind]: (value: Requests[K][0]) => Requests[K][1] | Promise<Requests[K][1]> } = {
        draw: ({ doc, bmp, ...options }) => this.draw(this.sceneOf(doc, options), bmp),
        count: ({ doc }) => {
            const { triangles = 0, litPixels = 0 } = drawCall(
                this.evm,
                withFunction(this.callOf(doc), "renderCounted"),
            );
            return { triangles, pixels: litPixels };
        },
        call: ({ doc }) => new Uint8Array(this.callOf(doc)),
        suffices: ({ doc, gas }) => this.suffices(this.callOf(doc), gas),
        stages: ({ doc }) => stagesOf(this, this.sceneOf(doc)),
        profile: ({ doc }) => {
            if (!this.given.stages) throw new InputError("The worker has no stages");
            return this.evm.profile(this.callOf(doc), this.given.stages);
        },
        file: ({ doc, ...how }) => fileOf(this, this.sceneOf(doc), how),
        path: ({ doc, frames }) => pathOf(this.sceneOf(doc), frames),
        frame: ({ doc, path, degrees }) => this.draw(seenFrom(this.sceneOf(doc), path, degrees)),
        gif: gifOf,
        genesis: ({ seed }) => genesisOf(this, seed),
        ids: ({ doc }) => idsOf(this, this.sceneOf(doc)),
        quote: ({ doc, terms }) => quoteOf(this, this.sceneOf(doc), terms),
        fits: ({ doc, limit, terms }) => fitsIn(this, this.sceneOf(doc), limit, terms),
    };
}
