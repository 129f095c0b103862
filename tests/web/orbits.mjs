// Moves the cameras of calls as the page of the Creator does.
//
//   node orbits.mjs BUNDLE LINES CALLS
//
// A line is a JSON object: `call` in hexadecimal digits, its `base`, and `moves`, each a name and its amounts. Each call
// is written after its length, and after each the camera, in the same way.

import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [bundle, lines, calls] = process.argv.slice(2);
const tools = await import(pathToFileURL(bundle));
const parts = [];

function write(content) {
    const size = Buffer.alloc(4);
    size.writeUInt32BE(content.length);
    parts.push(size, content);
}

for (const line of readFileSync(lines, "utf8").trimEnd().split("\n")) {
    const { call, base, moves } = JSON.parse(line);
    let to = base.camera;
    for (const [name, ...amounts] of moves) to = tools[name](to, ...amounts);
    write(tools.orbitCall(Buffer.from(call, "hex"), base, to));
    write(Buffer.from(JSON.stringify(to)));
}
writeFileSync(calls, Buffer.concat(parts));
