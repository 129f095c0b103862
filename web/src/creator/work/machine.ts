// What a worker does: the contracts draw, count and encode scenes of documents.

import { prepare, type Document } from "../../document/document.js";
import { InputError } from "../../errors.js";
import { drawCall, withFunction } from "../../picture.js";
import type { Handlers } from "../../workers/serve.js";
import { fileOf, gifOf } from "./encoders.js";
import { fitsIn } from "./fit.js";
import { genesisOf } from "./genesis.js";
import type { Host } from "./host.js";
import { idsOf } from "./pick.js";
import type { Requests } from "./protocol.js";
import { quoteOf } from "./quote.js";
import { stagesOf } from "./stages.js";
import { pathOf, seenFrom } from "./turntable.js";

/** Return what answers requests with what a worker has. */
export function handlersOf(host: Host): Handlers<Requests> {
    const handlers: Handlers<Requests> = {
        draw: ({ doc, bmp, ...options }) => host.draw(host.sceneOf(doc, options), bmp),
        count: ({ doc }) => {
            const { triangles = 0, litPixels = 0 } = drawCall(
                host.evm,
                withFunction(host.callOf(doc), "renderCounted"),
            );
            return { triangles, pixels: litPixels };
        },
        call: ({ doc }) => new Uint8Array(host.callOf(doc)),
        suffices: ({ doc, gas }) => host.suffices(host.callOf(doc), gas),
        stages: ({ doc }) => stagesOf(host, host.sceneOf(doc)),
        profile: ({ doc }) => {
            if (!host.given.stages) throw new InputError("The worker has no stages");
            return host.evm.profile(host.callOf(doc), host.given.stages);
        },
        file: ({ doc, ...how }) => fileOf(host, host.sceneOf(doc), how),
        path: ({ doc, frames }) => pathOf(host.sceneOf(doc), frames),
        frame: ({ doc, path, degrees }) => host.draw(seenFrom(host.sceneOf(doc), path, degrees)),
        gif: gifOf,
        genesis: ({ seed }) => genesisOf(host, seed),
        ids: ({ doc }) => idsOf(host, host.sceneOf(doc)),
        quote: ({ doc, terms }) => quoteOf(host, host.sceneOf(doc), terms),
        fits: ({ doc, limit, terms }) => fitsIn(host, host.sceneOf(doc), limit, terms),
    };
    const prepared = Object.entries(handlers).map(([kind, handle]) => [
        kind,
        async (value: { doc?: Document }) => {
            if (value.doc) await prepare(value.doc, host);
            return handle(value as never, null as never);
        },
    ]);
    return Object.fromEntries(prepared) as Handlers<Requests>;
}
