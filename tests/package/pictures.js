const hre = require("hardhat");
const { shackled } = require("shackled-contracts/hardhat");

it("draws", async () => {
  const { PngEncoder, Renderer } = await shackled(hre);
  const { provider } = hre.network;
  const [from] = await provider.send("eth_accounts");
  const { bytecode } = await hre.artifacts.readArtifact("Tetrahedron");
  const words = [Renderer, PngEncoder].map((each) => each.address.slice(2).padStart(64, "0"));
  const hash = await provider.send("eth_sendTransaction", [{ from, data: bytecode + words.join("") }]);
  const { contractAddress } = await provider.send("eth_getTransactionReceipt", [hash]);
  console.log("image:", await provider.send("eth_call", [{ to: contractAddress, data: process.env.CALL }]));
});
