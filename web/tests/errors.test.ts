import assert from "node:assert/strict";
import { test } from "node:test";
import { InputError } from "../src/index.js";

test("an InputError has its name", () => {
    assert.equal(String(new InputError("the width must be a number")), "InputError: the width must be a number");
});
