import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { test } from "node:test";
import { cosine, exponentOf, fromAxisAngle, powerOfTwo, rint, sine, tangent } from "../src/scene/arithmetic.js";

test("sines are those of Python", () => {
    // tests/scene/test_arithmetic.py has the same digest
    const values: number[] = [];
    for (let hundredths = -18_000; hundredths <= 36_000; hundredths += 9) {
        values.push(cosine(hundredths / 100), sine(hundredths / 100));
    }
    const bytes = new DataView(new ArrayBuffer(8 * values.length));
    values.forEach((value, index) => bytes.setFloat64(8 * index, value, true));
    const digest = createHash("sha256").update(bytes).digest("hex");
    assert.equal(digest, "09b289884fccdccc9c83d0b0c41e5232a81eab62795a58379e427efbb34ef9bf");
});

test("tangents are near those of the engine", () => {
    for (let degrees = 0.1; degrees < 89.9; degrees += 0.1) {
        const expected = Math.tan((degrees * Math.PI) / 180);
        assert.ok(Math.abs(tangent(degrees) - expected) <= 1e-12 * expected, `${degrees} degrees`);
    }
});

test("numbers are rounded to the nearest, ties to even", () => {
    const rounded = [0.5, 1.5, 2.5, -0.5, -1.5, 0.49999999999999994, 2 ** 52 + 1, -(2 ** 60), 1e300].map(rint);
    assert.deepEqual(
        rounded.map((x) => x + 0),
        [0, 2, 2, 0, -2, 0, 2 ** 52 + 1, -(2 ** 60), 1e300],
    );
});

test("exponents of numbers of any size", () => {
    for (const exponent of [-1074, -1023, -1022, -500, -1, 0, 1, 52, 1023]) {
        assert.equal(exponentOf(2 ** exponent), exponent + 1);
    }
    assert.equal(exponentOf(0.75), 0);
    assert.equal(exponentOf(-3), 2);
    for (const exponent of [-1000, -1, 0, 1, 1000]) assert.equal(powerOfTwo(exponent), 2 ** exponent);
});

test("whole turns leave rotations as they are", () => {
    for (const degrees of [0, 37, 180, -180, -90]) {
        for (const turns of [2, -2, 20]) {
            assert.deepEqual(fromAxisAngle([1, 2, 3], degrees + 360 * turns), fromAxisAngle([1, 2, 3], degrees));
        }
    }
});
