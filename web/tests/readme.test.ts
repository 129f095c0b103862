import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { test } from "node:test";

test("the example of the README runs, with the package by its name", async () => {
    const example = /```js\n([^]*?)```/.exec(readFileSync("README.md", "utf8"))?.[1];
    assert.ok(example);
    // "shackled" is found from a folder of the package
    const file = new URL("readme-example.mjs", import.meta.url);
    writeFileSync(file, `${example}\nexport { call, fromTheRight };\n`);
    const { call, fromTheRight } = (await import(file.href)) as { call: Uint8Array; fromTheRight: Uint8Array };
    assert.equal(call.length, fromTheRight.length);
    assert.notDeepEqual(call, fromTheRight);
});
