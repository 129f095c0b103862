// The visitor's own wallet in this browser (EIP-6963, EIP-1193): its account, its chain, and what it signs.

import { signal, type Signal } from "@preact/signals";
import { BaseError, createClient, custom, formatGwei, getAddress, isAddress, isHash, numberToHex as hex } from "viem";
import type { Address, Client, EIP1193Provider, Hash, Hex, TransactionReceipt } from "viem";
import { getBalance, waitForTransactionReceipt } from "viem/actions";
import { InputError } from "../../errors.js";
import { oneLine } from "../programs/subject.js";
import { BOUNDS } from "../../document/settings.js";
import { additionOf, chainName } from "./chains.js";

export interface Wallet {
    id: string;
    name: string;
    provider: EIP1193Provider;
}

/** A wallet that the visitor has connected: its account and its chain, as last seen. */
export interface Session {
    wallet: Wallet;
    client: Client;
    account: Address;
    chain: number;
}

/** Wei per gas: the most that is paid, and the part of the validator. */
export interface Fees {
    max: bigint;
    tip: bigint;
}

/** gas: its limit. */
export interface Call {
    to: Address;
    data: Hex;
    value?: bigint;
    gas: bigint;
}

/** A transaction with the most that it costs, its value and gas, and what the account has, in wei. */
export interface Priced {
    session: Session;
    call: Call & { value: bigint };
    fees: Fees;
    most: bigint;
    balance: bigint;
}

/** Says what happens now. */
export type Tell = (words: string) => void;

/** Milliseconds between two looks at the chain, and until a transaction must be in a block. */
const PAUSE = 1000;
const PATIENCE = 240_000;
/** What helps where the chain itself is unusual. */
const UNUSUAL = "If that is right on this chain, use the command shackled with --max-fee";
/** Codes of errors: the visitor said no (EIP-1193, WalletConnect); the chain is not known (EIP-3326). */
const DECLINED = [4001, 5000];
const UNKNOWN_CHAIN = [4902];
/** What is said where a node cannot be reached: by browsers, wallets and viem. */
const UNREACHED =
    /failed to fetch|load failed|network ?(error|request failed)|time(d )?out|disconnected|ECONN|unreachable|bad gateway/i;

export const wallets: Signal<readonly Wallet[]> = signal([]);
export const session: Signal<Session | null> = signal(null);

// ---- finding and connecting ----

/** Find the wallets of this browser, and go on listening for others. */
export function discover(): void {
    addEventListener("eip6963:announceProvider", announced);
    dispatchEvent(new Event("eip6963:requestProvider"));
    const { ethereum: provider } = globalThis as { ethereum?: EIP1193Provider };
    if (!wallets.peek().length && provider) wallets.value = [{ id: "", name: "the wallet of this browser", provider }];
}

function announced(event: Event): void {
    const { info, provider } = ((event as CustomEvent).detail ?? {}) as Partial<{
        info: { uuid: unknown; name: unknown };
        provider: EIP1193Provider;
    }>;
    if (!info || typeof provider?.request !== "function") return;
    const [id, name] = [String(info.uuid), oneLine(String(info.name)).slice(0, 40)];
    wallets.value = [...wallets.peek().filter((each) => each.id && each.id !== id), { id, name, provider }];
}

/** Ask a wallet for an account, and follow it when it changes its account or chain. */
export async function connect(wallet: Wallet): Promise<void> {
    const { provider } = wallet;
    // a library must not ask again for what the visitor has to sign
    const client = createClient({ transport: custom(provider, { retryCount: 0 }), pollingInterval: PAUSE });
    session.value = await look(wallet, client, "eth_requestAccounts");
    const follow = async (): Promise<void> => {
        const found = await look(wallet, client).catch(() => null);
        if (session.peek()?.client === client) session.value = found;
    };
    provider.on?.("accountsChanged", () => void follow());
    provider.on?.("chainChanged", () => void follow());
}

async function look(
    wallet: Wallet,
    client: Client,
    method: "eth_accounts" | "eth_requestAccounts" = "eth_accounts",
): Promise<Session> {
    const accounts: unknown = await client.request({ method });
    const account = Array.isArray(accounts) ? String(accounts[0]) : "";
    if (!isAddress(account, { strict: false })) throw new InputError("The wallet gives no account: unlock it");
    return { wallet, client, account: getAddress(account), chain: Number(await number(client, "eth_chainId")) };
}

/** Ask the wallet to change to a chain, and to add it where it is not known. */
export async function switchTo({ wallet, client }: Session, chain: number): Promise<void> {
    const change = (): Promise<unknown> =>
        client.request({ method: "wallet_switchEthereumChain", params: [{ chainId: hex(chain) }] });
    try {
        await change();
    } catch (error) {
        if (!hasCode(error, UNKNOWN_CHAIN)) throw error;
        const addition = additionOf(chain);
        if (!addition) throw new InputError(`The wallet does not know ${chainName(chain)}: add it there, with a node`);
        await client.request({ method: "wallet_addEthereumChain", params: [addition] });
        if ((await look(wallet, client)).chain !== chain) await change();
    }
    const found = (session.value = await look(wallet, client));
    if (found.chain !== chain) throw new InputError(`The wallet is still on ${chainName(found.chain)}`);
}

// ---- what it tells ----

/** Return the answer to a request as a number. */
export async function number(client: Client, method: string, ...params: unknown[]): Promise<bigint> {
    const answer: unknown = await client.request({ method, params } as never);
    if (typeof answer === "string" && /^0x[0-9a-f]{1,64}$/i.test(answer)) return BigInt(answer);
    throw new InputError(
        `The wallet answers ${method} with ${oneLine(String(answer)).slice(0, 40)}, which is no number`,
    );
}

/**
 * Return what gas may cost: the base fee can double until the transaction is in a block. InputError if the node suggests a tip
 * that is not usual: unlike a base fee that is too high, all of it is paid.
 */
async function feesOf({ client }: Session): Promise<Fees> {
    const block = await client.request({ method: "eth_getBlockByNumber", params: ["latest", false] });
    const base = String(block?.baseFeePerGas);
    if (!/^0x[0-9a-f]{1,64}$/i.test(base)) throw new InputError("The chain of the wallet has no base fee (EIP-1559)");
    const tip = await number(client, "eth_maxPriorityFeePerGas").catch(() => BOUNDS.tip);
    if (tip > BOUNDS.mostTip) {
        const [tips, most] = [tip, BOUNDS.mostTip].map((wei) => formatGwei(wei));
        throw new InputError(
            `The wallet suggests a tip of ${tips} gwei per unit of gas, more than ${most}: nothing is sent. ${UNUSUAL}`,
        );
    }
    return { max: 2n * BigInt(base) + tip, tip };
}

/** Return the gas that the node of the wallet expects. InputError if it is many times that counted here. */
async function estimate(from: Session, call: Omit<Call, "gas">, counted: bigint): Promise<bigint> {
    const { to, data, value = 0n } = call;
    const expected = await number(from.client, "eth_estimateGas", { from: from.account, to, data, value: hex(value) });
    if (expected <= BOUNDS.mostTimes * counted) return expected;
    const [gas, own] = [expected, counted].map((number) => number.toLocaleString("en"));
    throw new InputError(`The wallet expects ${gas} gas, where ${own} were counted here: nothing is sent. ${UNUSUAL}`);
}

/** Return gas with a margin, since the state of the chain changes. */
export function withMargin(gas: bigint): bigint {
    return (gas * BOUNDS.margin[0]) / BOUNDS.margin[1];
}

/** Return what a transaction costs at most. counted: its gas as counted here. InputError where the node is not plausible. */
export async function priced(session: Session, of: Omit<Call, "gas">, counted: number): Promise<Priced> {
    const { client, account } = session;
    const [expected, fees, balance] = await Promise.all([
        estimate(session, of, BigInt(counted)),
        feesOf(session),
        getBalance(client, { address: account }),
    ]);
    const gas = withMargin(expected > counted ? expected : BigInt(counted));
    const call = { value: 0n, ...of, gas };
    return { session, call, fees, most: call.value + gas * fees.max, balance };
}

/** InputError unless the wallet still has this account and this chain. */
export async function check({ wallet, client, account, chain }: Session): Promise<void> {
    const now = await look(wallet, client);
    if (now.chain === chain && now.account === account) return;
    session.value = now;
    const what = now.chain === chain ? `has another account now, ${now.account}` : `is on ${chainName(now.chain)} now`;
    throw new InputError(`The wallet ${what}: nothing more was sent`);
}

// ---- what it signs ----

/** Transactions that were sent, and of which nothing was heard yet: they are not sent again. */
const open = new Map<string, Hash>();

/** Have a transaction signed, and return its receipt. InputError if it fails, or is not known to be in a block. */
export async function send(from: Session, call: Call, fees: Fees, tell: Tell): Promise<TransactionReceipt> {
    await check(from);
    const { client, account, chain } = from;
    const { to, data, gas, value = 0n } = call;
    const key = [chain, account, to, data, value].join();
    let hash = open.get(key);
    if (hash && !(await client.request({ method: "eth_getTransactionByHash", params: [hash] }))) {
        // another node may know it still: only the visitor can tell
        open.delete(key);
        throw new InputError(
            `The node of the wallet does not know the transaction ${hash} any more: go on only if it is gone in the wallet, too`,
        );
    }
    if (!hash) {
        // the most that was told is what is signed: if it does not suffice any more, nothing is
        if ((await feesOf(from)).max > 2n * fees.max)
            throw new InputError("Gas has become dearer: see what it costs now");
        const most = { gas: hex(gas), maxFeePerGas: hex(fees.max), maxPriorityFeePerGas: hex(fees.tip) };
        const transaction = { from: account, to, data, value: hex(value), chainId: hex(chain), ...most };
        hash = (await client.request({ method: "eth_sendTransaction", params: [transaction] })) as Hash;
        if (!isHash(hash)) throw new InputError("The wallet does not say what it sent: look there before you go on");
        open.set(key, hash);
    }
    tell(`Sent: ${hash}. Waiting until it is in a block …`);
    let isOther = false;
    const onReplaced = ({ reason }: { reason: string }): void => void (isOther = reason !== "repriced");
    const waiting = waitForTransactionReceipt(client, { hash, timeout: PATIENCE, onReplaced });
    const receipt = await waiting.catch((error: unknown) => {
        const why = wordsOf(error);
        throw new InputError(
            `Whether the transaction ${hash} is in a block is not known (${why}). Go on to wait for it`,
        );
    });
    open.delete(key);
    if (isOther) throw new InputError(`The transaction ${hash} was cancelled or replaced in the wallet`);
    if (receipt.status !== "success") throw new InputError(`The transaction ${hash} failed: the contract refused it`);
    return receipt;
}

// ---- errors ----

/** Return whether it is the visitor who said no. */
export function isDeclined(error: unknown): boolean {
    return hasCode(error, DECLINED);
}

interface Faulty {
    code?: number;
    data?: { originalError?: { code?: number } };
    cause?: Faulty;
}

/** Return whether an error, or one in it, has one of some codes; wallets on phones have them in `originalError`. */
function hasCode(error: unknown, codes: readonly number[]): boolean {
    const { code, data, cause } = (error ?? {}) as Faulty;
    const own = [code, data?.originalError?.code];
    return own.some((each) => codes.includes(each ?? 0)) || (cause !== undefined && hasCode(cause, codes));
}

/** Return what an error of a wallet, of its node or of a contract says, in one line. */
export function wordsOf(error: unknown): string {
    if (error instanceof BaseError) {
        const words = oneLine(error.details || error.shortMessage).slice(0, 200);
        return UNREACHED.test(words) ? `The node of the wallet does not answer (${words})` : words;
    }
    return error instanceof Error ? error.message : String(error);
}

/** Return what a promise gives; its error is one line of words. */
export async function plainly<T>(promise: Promise<T>): Promise<T> {
    return promise.catch((error: unknown) => {
        throw new InputError(isDeclined(error) ? "Cancelled" : wordsOf(error));
    });
}
