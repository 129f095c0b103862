// What a worker does: the contracts draw, count and encode scenes of documents.

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
    return {
        draw: async ({ doc, bmp, ...options }) => host.draw(await host.sceneOf(doc, options), bmp),
        count: async ({ doc }) => {
            const call = withFunction(await host.callOf(doc), "renderCounted");
            const { triangles = 0, litPixels = 0 } = drawCall(host.evm, call);
            return { triangles, pixels: litPixels };
        },
        call: async ({ doc }) => new Uint8Array(await host.callOf(doc)),
        suffices: async ({ doc, gas }) => host.suffices(await host.callOf(doc), gas),
        stages: async ({ doc }) => stagesOf(host, await host.sceneOf(doc)),
        profile: async ({ doc }) => {
            if (!host.given.stages) throw new InputError("The worker has no stages");
            return host.evm.profile(await host.callOf(doc), host.given.stages);
        },
        file: async ({ doc, ...how }) => fileOf(host, await host.sceneOf(doc), how),
        path: async ({ doc, frames }) => pathOf(await host.sceneOf(doc), frames),
        frame: async ({ doc, path, degrees }) => host.draw(seenFrom(await host.sceneOf(doc), path, degrees)),
        gif: gifOf,
        genesis: ({ seed }) => genesisOf(host, seed),
        ids: async ({ doc }) => idsOf(host, await host.sceneOf(doc)),
        quote: async ({ doc, terms }) => quoteOf(host, await host.sceneOf(doc), terms),
        fits: async ({ doc, limit, terms }) => fitsIn(host, await host.sceneOf(doc), limit, terms),
    };
}
