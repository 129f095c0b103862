// Bundles, by esbuild.
//
//   node build.mjs package       dist/, which npm publishes
//   node build.mjs tests         dist/tests/, which `node --test` runs
//   node build.mjs python DIR    what the Python package holds, into DIR

import { copyFileSync, readdirSync, rmSync } from "node:fs";
import { build } from "esbuild";

/** Imports of "worker:PATH": a script as text, which a page starts as a worker. */
const workers = {
    name: "workers",
    setup: (building) => {
        building.onResolve({ filter: /^worker:/ }, ({ path }) => ({
            path: `src/view/${path.slice("worker:".length)}`,
            namespace: "worker",
        }));
        building.onLoad({ filter: /./, namespace: "worker" }, async ({ path }) => {
            const script = { ...common, entryPoints: [path], format: "iife", minify: true, write: false };
            const { outputFiles, metafile } = await build({ ...script, metafile: true });
            return { contents: outputFiles[0].text, loader: "text", watchFiles: Object.keys(metafile.inputs) };
        });
    },
};

const common = { bundle: true, format: "esm", target: "es2022", charset: "utf8", legalComments: "none" };
const modules = { ...common, plugins: [workers] };
const forPython = { shackled: "src/index.ts", view: "src/view/index.ts", live: "src/view/live.ts" };

const builds = {
    package: async () => {
        const entryPoints = { index: "src/index.ts", view: "src/view/index.ts" };
        await build({ ...modules, entryPoints, outdir: "dist" });
        copyFileSync("../src/shackled/evm/evm.wasm", "dist/evm.wasm");
        for (const name of ["contracts.json", "stages.json"])
            copyFileSync(`../src/shackled/web/${name}`, `dist/${name}`);
    },
    tests: () => {
        rmSync("dist/tests", { recursive: true, force: true });
        const entryPoints = readdirSync("tests").filter((name) => name.endsWith(".test.ts"));
        return build({
            ...common,
            entryPoints: entryPoints.map((name) => `tests/${name}`),
            platform: "node",
            outdir: "dist/tests",
        });
    },
    python: (folder) => build({ ...modules, entryPoints: forPython, minify: true, outdir: folder }),
};

const [what, ...rest] = process.argv.slice(2);
if (!Object.hasOwn(builds, what ?? "")) {
    console.error(`usage: node build.mjs ${Object.keys(builds).join("|")}`);
    process.exit(2);
}
await builds[what](...rest);
