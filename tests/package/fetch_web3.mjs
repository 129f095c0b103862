// Open web3:// addresses of anvil's chain, as browsers do: node fetch_web3.mjs RPC ADDRESS...
// Writes status, headers and body of each as a line of JSON.
import { Client } from "web3protocol";

const [rpc, ...addresses] = process.argv.slice(2);
const client = new Client([{ id: 31337, name: "anvil", shortName: "anvil", rpcUrls: [rpc] }]);
for (const address of addresses) {
    const { httpCode, httpHeaders, output } = await client.fetchUrl(address);
    const body = Buffer.from(await new Response(output).arrayBuffer()).toString("base64");
    console.log(JSON.stringify({ status: httpCode, headers: httpHeaders, body }));
}
