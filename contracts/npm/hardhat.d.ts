import type { contracts } from "shackled-contracts";

/** An EIP-1193 provider: sends requests to a node. */
export interface Eip1193 {
  request(request: { method: string; params?: unknown[] }): Promise<unknown>;
}

/**
 * Place the shipped bytecode of all contracts at their addresses on a development network, Hardhat or anvil. Addresses
 * that already have code, as on a fork, are left unchanged.
 *
 * @param network The `hre` of Hardhat 2, a connection of Hardhat 3 (`await hre.network.create()`), or a provider.
 * @returns Address and ABI of each contract, by name.
 */
export function shackled(
  network: Eip1193 | { provider: Eip1193 } | { network: { provider: Eip1193 } },
): Promise<typeof contracts>;
