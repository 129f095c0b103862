// Open a web3:// address of anvil's chain, as browsers do: node fetch_web3.mjs RPC ADDRESS
// Writes status, headers and body as JSON.
import { Client } from "web3protocol";

const [rpc, address] = process.argv.slice(2);
const client = new Client([{ id: 31337, name: "anvil", shortName: "anvil", rpcUrls: [rpc] }]);
const { httpCode, httpHeaders, output } = await client.fetchUrl(address);
const body = Buffer.from(await new Response(output).arrayBuffer()).toString("base64");
console.log(JSON.stringify({ status: httpCode, headers: httpHeaders, body }));
