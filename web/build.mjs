// Bundles, by esbuild.
//
//   node build.mjs package       dist/, which npm publishes
//   node build.mjs tests         dist/tests/, which `node --test` runs
//   node build.mjs python DIR    what the Python package holds, into DIR
//   node build.mjs page DIR      the scripts and styles of the Creator, into DIR; in DIR/one also as one script

import { copyFileSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { relative, resolve } from "node:path";
import { build } from "esbuild";
import { parse } from "smol-toml";

/** What the scripts of workers are made of, for notices. */
const insideWorkers = {};

/** Imports of "worker:PATH", from src/: a script as text, which a page starts as a worker. */
const workers = {
    name: "workers",
    setup: (building) => {
        building.onResolve({ filter: /^worker:/ }, ({ path }) => ({
            path: `src/${path.slice("worker:".length)}`,
            namespace: "worker",
        }));
        building.onLoad({ filter: /./, namespace: "worker" }, async ({ path }) => {
            const script = { ...common, external: ["fs", "path"], format: "iife", minify: true };
            const { outputFiles, metafile } = await build({
                ...script,
                entryPoints: [path],
                write: false,
                metafile: true,
            });
            Object.assign(insideWorkers, metafile.inputs);
            return { contents: outputFiles[0].text, loader: "text", watchFiles: Object.keys(metafile.inputs) };
        });
    },
};

/** Imports of "toml:PATH", from src/shackled/: a table of the Python package. */
const tables = {
    name: "tables",
    setup: (building) => {
        building.onResolve({ filter: /^toml:/ }, ({ path }) => ({
            path: resolve("../src/shackled", path.slice("toml:".length)),
            namespace: "toml",
        }));
        building.onLoad({ filter: /./, namespace: "toml" }, ({ path }) => {
            const table = JSON.stringify(parse(readFileSync(path, "utf8")));
            // the page is one file, too, in which no script may hold the beginning of a comment
            return { contents: table.replaceAll("<!--", "<[!]--"), loader: "json", watchFiles: [path] };
        });
    },
};

/**
 * Readers need no renderer, and the core of three.js has none. What starts the decoder of Draco meshes is no module: here it
 * exports what it defines.
 */
const libraries = {
    name: "libraries",
    setup: (building) => {
        const core = resolve("node_modules/three/build/three.core.js");
        building.onResolve({ filter: /^three$/ }, () => ({ path: core }));
        building.onLoad({ filter: /draco_wasm_wrapper\.js$/ }, ({ path }) => ({
            contents: `${readFileSync(path, "utf8")}\nexport default DracoDecoderModule;`,
        }));
    },
};

const common = {
    bundle: true,
    format: "esm",
    target: "es2022",
    charset: "utf8",
    legalComments: "none",
    jsx: "automatic",
    jsxImportSource: "preact",
    plugins: [libraries, tables],
};
/** The decoder of Draco meshes; what starts it asks for parts of Node there. */
const DRACO = "three/examples/jsm/libs/draco/gltf/draco_decoder.wasm";
const modules = { ...common, plugins: [workers, libraries, tables] };
const forPython = { shackled: "src/index.ts", view: "src/view/index.ts" };

/** Write the licences of the packages that a bundle is made of. */
function writeNotices(inputs, path) {
    const found = Object.keys(inputs).map((input) => /.*node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(input)?.[1]);
    const notices = [...new Set(found.filter(Boolean))].sort().map((name) => {
        const folder = `node_modules/${name}`;
        const { version, license } = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));
        const file = readdirSync(folder).find((each) => /^licen[sc]e/i.test(each));
        const text = file ? readFileSync(`${folder}/${file}`, "utf8").trim() : "";
        return `${name} ${version} (${license})\n\n${text}`.trim();
    });
    const decoder = "Draco (Apache-2.0)\n\nThe decoder of compressed meshes: https://github.com/google/draco";
    writeFileSync(path, `${[...notices, decoder].join(`\n\n${"-".repeat(78)}\n`)}\n`);
}

/** Return the paths of all that a script loads, at once or later. Of imports that nothing uses, esbuild writes chunks too. */
function loadedBy(script, outputs) {
    const found = new Set([script]);
    for (const path of found)
        for (const { path: next, external } of outputs[path].imports) if (!external) found.add(next);
    return found;
}

const builds = {
    package: async () => {
        const entryPoints = { index: "src/index.ts", view: "src/view/index.ts" };
        await build({ ...modules, entryPoints, outdir: "dist" });
        const command = { ...modules, entryPoints: { cli: "src/cli.ts" }, minify: true, platform: "node" };
        const { metafile } = await build({ ...command, metafile: true, outdir: "dist" });
        writeNotices(metafile.inputs, "dist/LICENSES.txt");
        copyFileSync("../src/shackled/evm/evm.wasm", "dist/evm.wasm");
        copyFileSync(`node_modules/${DRACO}`, "dist/draco.wasm");
        for (const name of ["contracts.json", "stages.json"])
            copyFileSync(`../src/shackled/web/${name}`, `dist/${name}`);
    },
    tests: () => {
        rmSync("dist/tests", { recursive: true, force: true });
        const entryPoints = readdirSync("tests").filter((name) => name.endsWith(".test.ts"));
        return build({
            ...modules,
            entryPoints: entryPoints.map((name) => `tests/${name}`),
            platform: "node",
            outdir: "dist/tests",
        });
    },
    python: (folder) => build({ ...modules, entryPoints: forPython, minify: true, outdir: folder }),
    page: async (folder) => {
        const entryPoints = { creator: "src/creator/main.tsx" };
        const page = { ...modules, entryPoints, external: ["fs", "path"], minify: true, metafile: true };
        const chunkNames = "chunks/[name]-[hash]";
        const { metafile } = await build({ ...page, splitting: true, chunkNames, outdir: folder });
        const loaded = loadedBy(relative(".", `${folder}/creator.js`), metafile.outputs);
        for (const path of Object.keys(metafile.outputs)) if (/js$/.test(path) && !loaded.has(path)) rmSync(path);
        const inputs = { ...metafile.inputs, ...insideWorkers };
        writeNotices(inputs, `${folder}/LICENSES.txt`);
        writeFileSync(`${folder}/meta.json`, JSON.stringify(metafile));
        await build({ ...page, outdir: `${folder}/one` });
    },
};

const [what, ...rest] = process.argv.slice(2);
if (!Object.hasOwn(builds, what ?? "")) {
    console.error(`usage: node build.mjs ${Object.keys(builds).join("|")}`);
    process.exit(2);
}
await builds[what](...rest);
