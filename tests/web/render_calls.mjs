// Draws calls of the Renderer, one line of hexadecimal digits each, and prints what came of each as a line of JSON.
//
//   node render_calls.mjs BUNDLE EVM CONTRACTS CALLS

import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [bundle, evm, contracts, calls] = process.argv.slice(2);
const { render } = await import(pathToFileURL(bundle));
const assets = { evm: pathToFileURL(evm), contracts: readFileSync(contracts) };
for (const line of readFileSync(calls, "utf8").trim().split("\n")) {
    try {
        const { bmp, gas } = await render(Uint8Array.from(Buffer.from(line, "hex")), { assets });
        console.log(JSON.stringify({ gas, sha256: createHash("sha256").update(bmp).digest("hex") }));
    } catch ({ name, message }) {
        console.log(JSON.stringify({ name, message }));
    }
}
