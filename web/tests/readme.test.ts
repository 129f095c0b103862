import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { test } from "node:test";

test("the examples of the README run", () => {
    const text = readFileSync("README.md", "utf8");
    const examples = [...text.matchAll(/```js\n(.*?)```/gs)].map((match) => match[1]);
    // within the package, its name leads to what npm publishes
    const program = resolve("dist/tests/readme.mjs");
    writeFileSync(program, examples.join("\n"));
    const folder = mkdtempSync(join(tmpdir(), "shackled-"));
    const said = execFileSync("node", [program], { cwd: folder, encoding: "utf8" });
    assert.match(said, /^65536 pixels, \d+ gas\n$/);
    assert.equal(readFileSync(join(folder, "tetrahedron.bmp")).length, 54 + 3 * 65536);
});
