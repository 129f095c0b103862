// Reads GLB files, each with its length in four bytes before it, and writes the reports of Khronos' validator as JSON.
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";

const [modules, source, target] = process.argv.slice(2);
const { validateBytes } = createRequire(`${modules}/`)("gltf-validator");
const data = readFileSync(source);
const reports = [];
for (let place = 0; place < data.length; ) {
    const end = place + 4 + data.readUInt32BE(place);
    reports.push(await validateBytes(new Uint8Array(data.subarray(place + 4, end)), { format: "glb" }));
    place = end;
}
writeFileSync(target, JSON.stringify(reports));
