// Bundles, by esbuild.
//
//   node build.mjs package       dist/index.js, which npm publishes
//   node build.mjs tests         dist/tests/, which `node --test` runs
//   node build.mjs python DIR    what the Python package holds, into DIR

import { readdirSync, rmSync } from "node:fs";
import { build } from "esbuild";

const common = { bundle: true, format: "esm", target: "es2022", charset: "utf8", legalComments: "none" };

const builds = {
    package: () => build({ ...common, entryPoints: ["src/index.ts"], outdir: "dist" }),
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
    python: (folder) => build({ ...common, entryPoints: { shackled: "src/index.ts" }, minify: true, outdir: folder }),
};

const [what, ...rest] = process.argv.slice(2);
if (!Object.hasOwn(builds, what ?? "")) {
    console.error(`usage: node build.mjs ${Object.keys(builds).join("|")}`);
    process.exit(2);
}
await builds[what](...rest);
