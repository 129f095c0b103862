// The objects that can be opened.

import { signal, useComputed } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { App } from "../app.js";
import type { PieceEntry } from "../assets.js";
import type { Document } from "../../document/document.js";
import { Button, Choices, Icon, Thumb } from "./icons.js";
import { anyGenesis } from "./keys.js";
import { open, show } from "../state.js";
import type { Drawn } from "../work/work.js";

/** The datasets, in the order of the shelf. */
const SHELVES = [
    { name: "icons", title: "Icons" },
    { name: "common", title: "Objects" },
    { name: "genesis", title: "Genesis" },
] as const;

/** Number of Genesis pieces on the shelf, of those in the collection, and the side of their pictures. */
const GENESIS = 24;
const COLLECTION = 1024;
const SIDE = 64;

/** Files that can be opened, and those that belong to them. */
const ACCEPTED = ".glb,.gltf,.obj,.mtl,.ply,.stl,.off,.toml,.json,.zip,.png,.jpg,.jpeg,.webp,.bin,.hex";

const thumbnails = signal<Readonly<Record<string, string>>>({});

export function ShelfPanel({ app }: { app: App }) {
    useEffect(() => {
        const loading = app.assets.json<Record<string, string>>("thumbnails.json");
        loading.then(
            (found) => (thumbnails.value = found),
            () => undefined,
        );
    }, []);
    const { adding, shelf, words } = open.value;
    const asked = words.trim().toLowerCase();
    const seed = seedIn(asked);
    const isFound = ({ name, title }: PieceEntry): boolean => `${name} ${title}`.toLowerCase().includes(asked);
    const isHere = ({ dataset }: PieceEntry): boolean => dataset === shelf;
    const names = app.pieces.value.filter(asked ? isFound : isHere).map(({ name }) => name);
    return (
        <section class="shelf" aria-label="Objects" id="page-shelf">
            <label class="button" for="file">
                <Icon name="open" />
                <span>
                    Open<span class="drop"> or drop</span> files
                </span>
            </label>
            <input
                class="unseen"
                type="file"
                id="file"
                data-name="file"
                multiple
                accept={ACCEPTED}
                aria-label="Open mesh, scene or picture files"
                onChange={({ currentTarget }) => {
                    void app.open([...(currentTarget.files ?? [])]);
                    currentTarget.value = "";
                }}
            />
            <input
                class="field"
                type="search"
                autocomplete="off"
                spellcheck={false}
                placeholder="Search, or a Genesis seed"
                aria-label="Search the objects, or enter a Genesis seed"
                data-name="search"
                value={words}
                onInput={({ currentTarget }) => show({ words: currentTarget.value })}
                onKeyDown={({ key }) => {
                    if (key === "Escape") show({ words: "" });
                    if (key !== "Enter") return;
                    if (seed) void openSeed(app, seed);
                    else if (asked && names[0]) void app.openPiece(names[0], adding);
                }}
            />
            {!asked && (
                <Choices
                    id="shelf"
                    label="Shelves"
                    of={SHELVES}
                    chosen={shelf}
                    choose={(name) => show({ shelf: name })}
                />
            )}
            <label class="quiet adding">
                <input
                    type="checkbox"
                    data-name="adding"
                    checked={adding}
                    onChange={({ currentTarget }) => show({ adding: currentTarget.checked })}
                />
                Add to the scene
            </label>
            <div class="pieces-of">
                {asked && <Found app={app} isEmpty={!names.length} seed={seed} />}
                {!asked && shelf === "genesis" ? <Genesis app={app} /> : <Pieces app={app} names={names} />}
            </div>
        </section>
    );
}

function Found({ app, isEmpty, seed }: { app: App; isEmpty: boolean; seed: string | null }) {
    if (seed) {
        const label = `Open Genesis ${seed.length > 4 ? `${seed.slice(0, 8)}…` : seed}`;
        return <Button name="dice" label={label} id="open-seed" look="" onClick={() => void openSeed(app, seed)} />;
    }
    return isEmpty ? (
        <p class="quiet" data-name="nothing-found">
            No object has this name. Enter a number up to {COLLECTION - 1} or 64 hexadecimal digits for a piece of
            Genesis, or drop a file anywhere on the page.
        </p>
    ) : null;
}

function Pieces({ app, names }: { app: App; names: readonly string[] }) {
    const shown = useComputed(() => pieceOf(app.drawing.seen.value?.doc)).value;
    const titles = new Map(app.pieces.value.map(({ name, title }) => [name, title]));
    return (
        <div class="pieces">
            {names.map((name) => (
                <Thumb
                    key={name}
                    id={`piece-${name}`}
                    title={titles.get(name) ?? name}
                    url={thumbnails.value[name]}
                    pressed={shown === name}
                    onClick={(event) => void app.openPiece(name, open.peek().adding || event.shiftKey)}
                />
            ))}
        </div>
    );
}

/** Return the piece of which all objects are; null where there is none. */
function pieceOf(doc: Document | undefined): string | null {
    const names = new Set(doc?.objects.map(({ mesh }) => ("piece" in mesh ? mesh.piece : null)));
    return names.size === 1 ? ([...names][0] ?? null) : null;
}

// ---- Genesis ----

const genesis = signal<readonly (string | null)[]>(Array.from({ length: GENESIS }, () => null));
let drawing: Promise<void> | null = null;

function Genesis({ app }: { app: App }) {
    useEffect(() => void (drawing ??= drawGenesis(app)), []);
    return (
        <>
            <Button
                name="dice"
                label="Random piece"
                id="any-genesis"
                look=""
                onClick={() => void anyGenesis(app, open.peek().adding)}
            />
            <div class="pieces">
                {genesis.value.map((url, number) => {
                    const open = (): void => void openSeed(app, String(number));
                    const title = `Genesis ${number}`;
                    return <Thumb key={number} id={`genesis-${number}`} title={title} url={url} onClick={open} />;
                })}
            </div>
        </>
    );
}

/** Draw the pieces of the shelf, one after the other, when no one waits for anything else. */
async function drawGenesis(app: App): Promise<void> {
    for (let number = 0; number < GENESIS; number++) {
        try {
            const doc = await app.meshes.piece(`genesis/${number}`);
            const drawn = await app.work.draw(doc, { width: SIDE, height: SIDE, antialias: true, lane: "background" });
            genesis.value = genesis.value.with(number, urlOf(drawn));
        } catch {
            return; // the shelf does without pictures
        }
    }
}

/** Return a drawn picture as the address of an image. */
export function urlOf({ width, height, pixels }: Pick<Drawn, "width" | "height" | "pixels">): string {
    const canvas = Object.assign(document.createElement("canvas"), { width, height });
    canvas.getContext("2d")?.putImageData(new ImageData(pixels, width, height), 0, 0);
    return canvas.toDataURL();
}

/** Return the seed that a text is: a number of the collection, or 64 hexadecimal digits; null if it is none. */
export function seedIn(text: string): string | null {
    const asked = text.trim().toLowerCase();
    if (/^(0x)?[0-9a-f]{64}$/.test(asked)) return asked.slice(-64);
    return /^(0|[1-9]\d{0,3})$/.test(asked) && Number(asked) < COLLECTION ? asked : null;
}

/** Open the piece of a seed as `seedIn` returns it. */
export async function openSeed(app: App, seed: string): Promise<void> {
    show({ words: "" });
    await app.openPiece(`genesis/${seed}`, open.peek().adding);
}
