// Makes the calls that lines ask for: node calls.mjs ASKED ANSWERS, both JSON; see tests/support/node_scripts.py.
//
// A line has the `text` of a scene file or a `scene`, and perhaps the `name` of a function, a `tile`, and a `turn`; or a
// `call`, of whose scene the call is made.

import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [asked, written] = process.argv.slice(2);
const { bundle, lines } = JSON.parse(readFileSync(asked, "utf8"));
const { decodeCall, encode, parseScene, turnCall } = await import(pathToFileURL(bundle));

function made({ call, text, scene, name, tile, turn }) {
    try {
        const found = call ? decodeCall(new Uint8Array(Buffer.from(call, "hex"))) : (scene ?? parseScene(text));
        const made = encode(found, name, tile);
        return { call: Buffer.from(turn ? turnCall(made, turn) : made).toString("hex") };
    } catch (error) {
        return { error: error.name === "InputError" ? `InputError: ${error.message}` : error.stack };
    }
}

writeFileSync(written, JSON.stringify(lines.map(made)));
