// The wallets of the visitor (EIP-6963, or a single one of EIP-1193).

const wallets = [];
addEventListener("eip6963:announceProvider", ({ detail }) => {
  if (!wallets.some(({ info }) => info.uuid === detail.info.uuid)) wallets.push(detail);
});

// the names of all wallets
export function findWallets() {
  dispatchEvent(new Event("eip6963:requestProvider"));
  if (!wallets.length && window.ethereum) {
    wallets.push({ info: { name: "this browser's wallet" }, provider: window.ethereum });
  }
  return wallets.map(({ info }) => String(info.name));
}

// The answer to a request of the server. After a reconnection the server repeats requests without an answer; the wallet
// is asked only once.
const answers = new Map();
export async function askWallet({ id, wallet, method, params }) {
  if (!answers.has(id)) answers.set(id, ask(wallet, method, params));
  return { id, ...(await answers.get(id)) };
}

async function ask(wallet, method, params) {
  try {
    const result = (await wallets[wallet].provider.request({ method, params })) ?? null;
    return { result: method === "eth_getBlockByNumber" && result ? headerOf(result) : result };
  } catch (error) {
    return { error: String(error?.message ?? error), code: error?.data?.originalError?.code ?? error?.code };
  }
}

// a block without its lists of transactions and withdrawals, which can be longer than a message may be
function headerOf(block) {
  return Object.fromEntries(Object.entries(block).filter(([, value]) => !Array.isArray(value)));
}
