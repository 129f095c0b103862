// The whole page.

import { useEffect } from "preact/hooks";
import { InputError } from "../../errors.js";
import type { App } from "../app.js";
import { Header, Seldom } from "./header.js";
import { Choices } from "./icons.js";
import { Panel } from "./panel.js";
import { Picture } from "./picture.js";
import { ShelfPanel, openSeed, seedIn } from "./shelf.js";
import { open, show } from "../state.js";
import { Status } from "./status.js";

/** What small screens have below the picture. */
const PAGES = [
    { name: "shelf", title: "Objects" },
    { name: "looks", title: "Looks" },
    { name: "scene", title: "Adjust" },
] as const;

export function Page({ app }: { app: App }) {
    useEffect(() => listenToFiles(app), []);
    const { dialog, dropping, page } = open.value;
    return (
        <div class="creator" data-page={page}>
            <Header app={app} />
            <ShelfPanel app={app} />
            <main class="stage" aria-label="The picture and its gas">
                <Picture app={app} />
                <Status app={app} />
                <Choices id="page" label="Below the picture" look="pages" of={PAGES} chosen={page} choose={turnTo} />
            </main>
            <Panel app={app} />
            <footer class="foot">
                <Seldom app={app} />
            </footer>
            {dropping && (
                <div class="dropping" aria-hidden="true">
                    Drop files to open them
                </div>
            )}
            {dialog && <dialog.Dialog key={dialog.name} />}
        </div>
    );
}

/** Show one of the pages from its beginning. */
function turnTo(page: (typeof PAGES)[number]["name"]): void {
    show({ page });
    scrollTo(0, 0);
}

/** Open what is dropped on the page, or pasted: files, or a seed. */
function listenToFiles(app: App): () => void {
    const stop = new AbortController();
    let over = 0;
    const on = <K extends keyof DocumentEventMap>(type: K, handle: (event: DocumentEventMap[K]) => void): void =>
        document.addEventListener(type, handle, { signal: stop.signal });
    const text = (words: string): boolean => {
        const seed = words.length > 4 ? seedIn(words) : null;
        if (seed) void openSeed(app, seed);
        return seed !== null;
    };
    const depth = (by: number): void => {
        over = Math.max(0, over + by);
        show({ dropping: over > 0 });
    };
    on("dragenter", ({ dataTransfer }) => dataTransfer?.types.includes("Files") && depth(1));
    on("dragleave", ({ dataTransfer }) => dataTransfer?.types.includes("Files") && depth(-1));
    on("dragover", (event) => event.preventDefault());
    on("drop", (event) => {
        event.preventDefault();
        depth(-over);
        const { dataTransfer } = event;
        if (!dataTransfer) return;
        // folders have to be asked for before this returns
        const entries = [...dataTransfer.items]
            .map((item) => item.webkitGetAsEntry())
            .filter((entry) => entry !== null);
        const files = [...dataTransfer.files];
        if (entries.some((entry) => entry.isDirectory))
            void app.run("Reading the folder", () => filesIn(entries)).then((found) => found && app.open(found));
        else if (files.length) void app.open(files);
        else text(dataTransfer.getData("text"));
    });
    on("paste", (event) => {
        const { clipboardData, target } = event;
        if (!clipboardData || app.dialog.value) return;
        if (clipboardData.files.length) void app.open([...clipboardData.files]);
        else if (!(target instanceof HTMLInputElement) && text(clipboardData.getData("text"))) event.preventDefault();
    });
    return () => stop.abort();
}

/** Most files of a folder. */
const MOST_FILES = 1000;

/** Return all files in folders; their paths are their names. */
async function filesIn(entries: readonly FileSystemEntry[]): Promise<File[]> {
    const found: File[] = [];
    const read = async (entry: FileSystemEntry): Promise<void> => {
        if (entry.isFile) {
            if (found.length >= MOST_FILES)
                throw new InputError(`The folder has more than ${MOST_FILES} files: drop those of one model`);
            const file = await new Promise<File>((resolve, reject) =>
                (entry as FileSystemFileEntry).file(resolve, reject),
            );
            Object.defineProperty(file, "webkitRelativePath", { value: entry.fullPath.slice(1) });
            found.push(file);
            return;
        }
        const reader = (entry as FileSystemDirectoryEntry).createReader();
        for (;;) {
            const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
            if (!some.length) return;
            for (const each of some) await read(each);
        }
    };
    for (const entry of entries) await read(entry);
    return found;
}
