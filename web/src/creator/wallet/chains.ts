// The names of chains, and where collections are on chains.

import { numberToHex } from "viem";
import { CHAINS } from "../../document/settings.js";

/** The IDs of chains on which gas is paid in ether, in which the page tells amounts. */
export const ETHER_CHAINS = CHAINS.flatMap(({ number, currency }) => (currency === "ETH" ? number : []));

const known = (id: number) => CHAINS.find(({ number }) => number === id);

export function chainName(id: number): string {
    return known(id)?.name ?? `chain ${id}`;
}

/** Return what `wallet_addEthereumChain` takes; null for a chain without a node here. */
export function additionOf(id: number) {
    const chain = known(id);
    if (!chain?.node) return null;
    const { name, node, currency, explorer } = chain;
    return {
        chainId: numberToHex(id),
        chainName: name,
        nativeCurrency: { name: currency, symbol: currency, decimals: 18 },
        rpcUrls: [node],
        ...(explorer && { blockExplorerUrls: [explorer] }),
    };
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
