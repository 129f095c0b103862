const { subtask } = require("hardhat/config");
const { TASK_COMPILE_SOLIDITY_GET_SOLC_BUILD } = require("hardhat/builtin-tasks/task-names");

// the compiler that Hardhat itself depends on, in place of a download; all settings are the defaults
const solc = require(require.resolve("solc/package.json", { paths: [require.resolve("hardhat")] }));

subtask(TASK_COMPILE_SOLIDITY_GET_SOLC_BUILD, async () => ({
  compilerPath: require.resolve("solc/soljson.js", { paths: [require.resolve("hardhat")] }),
  isSolcJs: true,
  version: solc.version,
  longVersion: solc.version,
}));

module.exports = { solidity: solc.version };
