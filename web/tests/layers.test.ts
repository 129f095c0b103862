import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join, normalize } from "node:path";
import { test } from "node:test";

/** Folders and files of src/, the lowest first: each imports from itself and from those above it here. */
const LAYERS = [
    ...["errors.ts", "bytes.ts", "scene/", "evm/", "call.ts", "turn.ts", "picture.ts", "render.ts", "index.ts"],
    ...["workers/", "document/", "files/", "cli.ts", "draw/", "view/"],
    ...["creator/assets.ts", "creator/things.ts", "creator/mesh_store.ts", "creator/calm.ts", "creator/controls.ts"],
    ...[
        "creator/state.ts",
        "creator/work/",
        "creator/drawing.ts",
        "creator/app.ts",
        "creator/programs/",
        "creator/ui/",
    ],
    ...["creator/dialogs/", "creator/wallet/", "creator/dialogs.tsx", "creator/main.tsx"],
];

/** The modules that each module imports, also those of which it has types only. */
const IMPORTS = new Map(
    (readdirSync("src", { recursive: true }) as string[])
        .filter((path) => /(?<!\.d)\.tsx?$/.test(path))
        .map((path) => {
            const found = readFileSync(join("src", path), "utf8").matchAll(/(?:from|import)\s*\(?\s*"(\.[^"]+)\.js"/g);
            const modules = Array.from(found, ([, name]) => normalize(join(path, "..", name as string)));
            return [path, modules.map((name) => (existsSync(`src/${name}.tsx`) ? `${name}.tsx` : `${name}.ts`))];
        }),
);

function layerOf(path: string): number {
    return LAYERS.findIndex((layer) => path === layer || (layer.endsWith("/") && path.startsWith(layer)));
}

test("modules import what is below them", () => {
    assert.ok(IMPORTS.size > 100);
    for (const [path, modules] of IMPORTS) {
        assert.ok(layerOf(path) >= 0, `${path} has no layer`);
        for (const module of modules) {
            assert.ok(IMPORTS.has(module), `${path} imports ${module}, which is not there`);
            assert.ok(layerOf(module) <= layerOf(path), `${path} imports ${module}, which is above it`);
        }
    }
});

test("no modules import each other in a circle", () => {
    const done = new Set<string>();
    const visit = (path: string, way: readonly string[]): void => {
        assert.ok(!way.includes(path), `a circle: ${[...way.slice(way.indexOf(path)), path].join(" → ")}`);
        if (done.has(path)) return;
        for (const module of IMPORTS.get(path) ?? []) visit(module, [...way, path]);
        done.add(path);
    };
    for (const path of IMPORTS.keys()) visit(path, []);
});
