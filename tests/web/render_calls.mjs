// Draws calls of the Renderer, one line of hexadecimal digits each, and prints what came of each as a line of JSON.
//
//   node render_calls.mjs BUNDLE EVM CONTRACTS STAGES CALLS [profile]
//
// With "profile", the gas of each stage in place of the picture.

import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [bundle, evm, contracts, stages, calls, what] = process.argv.slice(2);
const { profile, render } = await import(pathToFileURL(bundle));
const assets = { evm: pathToFileURL(evm), contracts: readFileSync(contracts), stages: pathToFileURL(stages) };
for (const line of readFileSync(calls, "utf8").trim().split("\n")) {
    const call = Uint8Array.from(Buffer.from(line, "hex"));
    try {
        if (what === "profile") {
            const found = await profile(call, { assets });
            console.log(JSON.stringify({ stages: Object.fromEntries(found.map(({ stage, gas }) => [stage, gas])) }));
            continue;
        }
        const { bmp, gas } = await render(call, { assets });
        console.log(JSON.stringify({ gas, sha256: createHash("sha256").update(bmp).digest("hex") }));
    } catch ({ name, message }) {
        console.log(JSON.stringify({ name, message }));
    }
}
