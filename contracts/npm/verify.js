"use strict";

const { existsSync, readFileSync } = require("node:fs");
const { join } = require("node:path");
const inputs = require("./verify.json");

/**
 * Return the standard JSON input from which the compiler makes a contract, every source included. Groups of contracts
 * have one input.
 */
function standardInput(contract) {
  const input = inputs.find(({ settings }) => Object.values(settings.outputSelection).some((names) => Object.hasOwn(names, contract)));
  if (!input) throw new RangeError(`there is no contract ${contract}: give a name such as Studio`);
  // sources of libraries are in the folder verify
  const read = (path) => readFileSync([path, join("verify", path)].map((each) => join(__dirname, each)).find(existsSync), "utf8");
  return { ...input, sources: Object.fromEntries(input.sources.map((path) => [path, { content: read(path) }])) };
}

module.exports = { standardInput };

if (require.main === module) {
  try {
    console.log(JSON.stringify(standardInput(process.argv[2]), null, 1));
  } catch (fault) {
    console.error(fault.message);
    process.exitCode = 1;
  }
}
