// Does what workers of the page do, with scene files in place of documents: `node work.mjs ASKED ANSWERS`, for test_work.py.

import { readFileSync, writeFileSync } from "node:fs";
import { fileOf, gifOf } from "../../web/src/creator/work/encoders.js";
import { SELECTORS } from "../../web/src/creator/work/calls.js";
import { fitsIn } from "../../web/src/creator/work/fit.js";
import { genesisOf } from "../../web/src/creator/work/genesis.js";
import { Host } from "../../web/src/creator/work/host.js";
import { pageOf } from "../../web/src/creator/work/page.js";
import type { Format } from "../../web/src/creator/work/protocol.js";
import { quoteOf } from "../../web/src/creator/work/quote.js";
import { stagesOf } from "../../web/src/creator/work/stages.js";
import { pathOf, seenFrom } from "../../web/src/creator/work/turntable.js";
import type { Document } from "../../web/src/document/document.js";
import { hashPixels } from "../../web/src/picture.js";
import { encode } from "../../web/src/scene/encode.js";
import { parseScene } from "../../web/src/scene/file.js";

const [asked, written] = process.argv.slice(2) as [string, string];
const { data, template, cases } = JSON.parse(readFileSync(asked, "utf8"));
const read = (name: string): Uint8Array<ArrayBuffer> => new Uint8Array(readFileSync(`${data}/${name}`));
const json = (name: string): never => JSON.parse(new TextDecoder().decode(read(name))) as never;

const host = new Host();
const module = await WebAssembly.compile(read("evm.wasm"));
host.keep("evm", { module, contracts: json("contracts.json") });
host.keep("more", json("more.json"));

const answers: unknown[] = [];
for (const { name, does, text, options } of cases) {
    const write = (content: Uint8Array | string, kind: string): void =>
        writeFileSync(`${data}/${name}.${kind}`, content);
    const scene = text && parseScene(text);
    const doers: Record<string, () => unknown> = {
        file: async () => write(await fileOf(host, scene, options as { format: Format }), options.format),
        gif: () => {
            const path = pathOf(scene, options.frames);
            const frames = Array.from({ length: options.frames as number }, (_, frame) =>
                host.draw(seenFrom(scene, path, (360 * frame) / options.frames)),
            );
            write(gifOf({ ...options, frames }), "gif");
        },
        page: async () => {
            const [drawn, png] = [host.draw(scene), await fileOf(host, scene, { format: "png" })];
            const assets = { bytes: async (file: string) => read(file), text: async () => template as string };
            const sha256 = await hashPixels(drawn.pixels);
            const call = new Uint8Array(encode(scene));
            write(
                await pageOf(assets as never, { doc: options as Document, drawn, png, call, sha256: sha256! }),
                "html",
            );
        },
        stages: () =>
            stagesOf(host, scene).map(({ title, detail, drawn }, number) => {
                write(new Uint8Array(drawn.pixels.buffer), String(number));
                return [title, detail];
            }),
        quote: () => {
            const quote = quoteOf(host, scene, { ...options, price: BigInt(options.price) });
            const hex = (_: string, value: unknown): unknown =>
                value instanceof Uint8Array ? Buffer.from(value).toString("hex") : value;
            return JSON.parse(JSON.stringify(quote, hex));
        },
        fits: () => fitsIn(host, scene, options.limit),
        genesis: () => write(encode(genesisOf(host, BigInt(options.seed))), "call"),
        selectors: () => SELECTORS,
    };
    try {
        answers.push({ answer: (await doers[does]!()) ?? null });
    } catch (error) {
        answers.push({ error: String(error) });
    }
}
writeFileSync(written, JSON.stringify(answers));
