// Makes the calls that the lines of a file ask for, each a JSON object; writes each call, after its length, to another.
//
//   node calls.mjs BUNDLE LINES CALLS
//
// A line has the `text` of a scene file or a `scene`, and perhaps the `name` of a function, a `tile`, and a `turn`; or a
// `call`, of whose scene the call is made.

import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [bundle, lines, calls] = process.argv.slice(2);
const { decodeCall, encode, parseScene, turnCall } = await import(pathToFileURL(bundle));

function made({ call, text, scene, name, tile, turn }) {
    try {
        const found = call ? decodeCall(new Uint8Array(Buffer.from(call, "base64"))) : (scene ?? parseScene(text));
        const made = encode(found, name, tile);
        return turn ? turnCall(made, turn) : made;
    } catch (error) {
        return Buffer.from(error.name === "InputError" ? `InputError: ${error.message}` : error.stack);
    }
}

const parts = [];
for (const line of readFileSync(lines, "utf8").trimEnd().split("\n")) {
    const call = made(JSON.parse(line));
    const size = Buffer.alloc(4);
    size.writeUInt32BE(call.length);
    parts.push(size, call);
}
writeFileSync(calls, Buffer.concat(parts));
