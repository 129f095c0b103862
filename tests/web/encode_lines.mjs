// Encodes the scene files in a file, one a line: the bytes of their calls into another, each after its length.
//
//   node encode_lines.mjs BUNDLE SCENES CALLS

import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [bundle, scenes, calls] = process.argv.slice(2);
const { encode, parseScene } = await import(pathToFileURL(bundle));
const parts = [];
for (const line of readFileSync(scenes, "utf8").trimEnd().split("\n")) {
  const { name, tile, text } = JSON.parse(line);
  let call;
  try {
    call = encode(parseScene(text), name, tile);
  } catch (error) {
    call = Buffer.from(String(error?.stack ?? error));
  }
  const size = Buffer.alloc(4);
  size.writeUInt32BE(call.length);
  parts.push(size, call);
}
writeFileSync(calls, Buffer.concat(parts));
