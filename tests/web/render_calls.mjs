// Draws calls of the Renderer, or takes the gas of their stages: node render_calls.mjs ASKED ANSWERS, for test_web_render.py.

import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [asked, written] = process.argv.slice(2);
const { does, package: folder, calls } = JSON.parse(readFileSync(asked, "utf8"));
const path = (name) => pathToFileURL(`${folder}/${name}`);
const { profile, render } = await import(path("web/shackled.js"));
const [evm, contracts, stages] = ["evm/evm.wasm", "web/contracts.json", "web/stages.json"].map(path);
const assets = { evm, contracts: readFileSync(contracts), stages };
const doers = {
    profile: async (call) => {
        const found = await profile(call, { assets });
        return { stages: Object.fromEntries(found.map(({ stage, gas }) => [stage, gas])) };
    },
    render: async (call) => {
        const { bmp, gas } = await render(call, { assets });
        return { gas, sha256: createHash("sha256").update(bmp).digest("hex") };
    },
};
const answers = [];
for (const call of calls) {
    const found = doers[does](Uint8Array.from(Buffer.from(call, "hex")));
    answers.push(await found.catch(({ name, message }) => ({ name, message })));
}
writeFileSync(written, JSON.stringify(answers));
