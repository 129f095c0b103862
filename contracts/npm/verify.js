"use strict";

const { existsSync, readFileSync } = require("node:fs");
const { join } = require("node:path");
const inputs = require("./verify.json");

/**
 * Return the standard JSON input from which the compiler makes a contract, every source included. Groups of contracts
 * have one input.
 */
function standardInput(contract) {
  const input = inputs.find(({ settings }) => Object.values(settings.outputSelection).some((names) => contract in names));
  if (!input) throw new RangeError(`there is no contract ${contract}; a name is, for example, Studio`);
  // sources of libraries are in the folder verify
  const read = (path) => readFileSync([path, join("verify", path)].map((each) => join(__dirname, each)).find(existsSync), "utf8");
  return { ...input, sources: Object.fromEntries(input.sources.map((path) => [path, { content: read(path) }])) };
}

module.exports = { standardInput };

if (require.main === module) {
  console.log(JSON.stringify(standardInput(process.argv[2]), null, 1));
}
