// Chains that the page knows, and where collections are on chains.

import { numberToHex } from "viem";

/** Names by ID; and nodes, for wallets that do not know the chain. */
export const CHAINS: Record<number, { name: string; node?: string }> = {
    1: { name: "Ethereum" },
    11155111: { name: "Sepolia", node: "https://11155111.rpc.thirdweb.com" },
    560048: { name: "Hoodi", node: "https://rpc.hoodi.ethpandaops.io" },
    31337: { name: "a development chain", node: "http://127.0.0.1:8545" },
};

export function chainName(id: number): string {
    return CHAINS[id]?.name ?? `chain ${id}`;
}

/** Return what `wallet_addEthereumChain` takes; null for a chain without a node here. */
export function additionOf(id: number) {
    const { name, node } = CHAINS[id] ?? {};
    const nativeCurrency = { name: "Ether", symbol: "ETH", decimals: 18 };
    return name && node ? { chainId: numberToHex(id), chainName: name, nativeCurrency, rpcUrls: [node] } : null;
}

/** The addresses of contracts by their names, by the ID of the chain. */
export type Book = Record<string, Record<string, string>>;

let book: Promise<Book> | undefined;

/** Return the address book that is beside the page; an empty one where there is none. */
export function addressBook(): Promise<Book> {
    return (book ??= readBook().catch(() => ({})));
}

async function readBook(): Promise<Book> {
    if (location.protocol === "file:") return {};
    const response = await fetch("addresses.json");
    return ((response.ok ? await response.json() : {}) as { chains?: Book }).chains ?? {};
}

/** Return the IDs of the chains on which a book has one of some contracts. */
export function chainsOf(book: Book | null, ...names: readonly string[]): number[] {
    const has = (contracts: Record<string, string>): boolean => names.some((name) => contracts[name]);
    return Object.entries(book ?? {}).flatMap(([id, contracts]) => (has(contracts) ? [Number(id)] : []));
}
