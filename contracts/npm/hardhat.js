"use strict";

const { contracts } = require("./index.js");
const codes = require("./runtime.json");

/** Place the contracts at their addresses: see hardhat.d.ts. */
async function shackled(network) {
  const provider = [network.network?.provider, network.provider, network].find((each) => typeof each?.request === "function");
  if (!provider) throw new TypeError("shackled() needs the hre of Hardhat 2, a connection of Hardhat 3, or an EIP-1193 provider");
  for (const [name, code] of Object.entries(codes)) {
    const { address } = contracts[name];
    const found = await provider.request({ method: "eth_getCode", params: [address, "latest"] });
    if (found === "0x") await provider.request({ method: "hardhat_setCode", params: [address, code] });
  }
  return contracts;
}

module.exports = { shackled };
