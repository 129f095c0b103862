// The bar at the top.

import type { App } from "../app.js";
import { open, show, type DialogName } from "../state.js";
import { Button, IconButton, Logo } from "./icons.js";
import { surpriseMe } from "./keys.js";

const THEME = "shackled-theme";

/** Take the theme that was chosen before. */
export function restoreTheme(): void {
    try {
        setTheme(localStorage.getItem(THEME) ?? "");
    } catch {
        // no storage
    }
}

function setTheme(theme: string): void {
    show({ theme });
    document.documentElement.style.colorScheme = theme;
}

function toggleTheme(): void {
    const dark =
        (open.peek().theme || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light")) === "dark";
    setTheme(dark ? "light" : "dark");
    try {
        localStorage.setItem(THEME, open.peek().theme);
    } catch {
        // no storage: it lasts as long as the page
    }
}

const STEPS = {
    undo: { name: "undo", label: "Undo", hint: "Undo (Ctrl Z)", id: "undo" },
    redo: { name: "redo", label: "Redo", hint: "Redo (Ctrl Shift Z)", id: "redo" },
} as const;
const SURPRISE = {
    name: "surprise",
    label: "Surprise me",
    hint: "Another look, camera and palette (S)",
    id: "surprise",
} as const;
const THINGS = { name: "things", label: "My things", hint: "What you made and kept", id: "things" } as const;
const DOWNLOAD = { name: "download", label: "Download and share", id: "download" } as const;

export function Header({ app }: { app: App }) {
    // where the page is a part of the documentation, it knows the way back
    const docs = document.querySelector<HTMLMetaElement>("meta[name=docs]")?.content;
    return (
        <header class="top">
            <a href="#view" class="button main skip" onClick={skip}>
                Skip to the picture
            </a>
            <div class="brand">
                <Logo />
                <div>
                    <h1>Shackled Creator</h1>
                    <p>Every pixel computed by a smart contract</p>
                </div>
            </div>
            <IconButton {...STEPS.undo} disabled={!app.canUndo.value} onClick={() => app.undo()} />
            <IconButton {...STEPS.redo} disabled={!app.canRedo.value} onClick={() => app.redo()} />
            <span class="gap" />
            <Button {...SURPRISE} look="plain" onClick={() => surpriseMe(app)}>
                <span class="word">Surprise me</span>
            </Button>
            <Button {...THINGS} look="plain" popup onClick={() => void app.openDialog("things")}>
                <span class="word second">My things</span>
            </Button>
            <span class="rule" />
            <span class="seldom">
                <Seldom app={app} />
            </span>
            {docs && (
                <a class="button plain" href={docs} title="The documentation of Shackled">
                    <span class="word second">Docs</span>
                </a>
            )}
            <Button {...DOWNLOAD} look="main" popup onClick={() => void app.openDialog("download")}>
                <span class="word">
                    Download<span class="second"> and share</span>
                </span>
            </Button>
        </header>
    );
}

/** Buttons that small screens have at the end of the page. */
export function Seldom({ app }: { app: App }) {
    const open = (name: DialogName) => () => void app.openDialog(name);
    return (
        <>
            <IconButton name="theme" label="Toggle dark theme" id="theme" onClick={toggleTheme} />
            <IconButton name="help" label="Keys" hint="Keys (?)" id="keys" onClick={open("keys")} />
            <IconButton name="about" label="About the Creator" id="about" onClick={open("about")} />
        </>
    );
}

// the address keeps the document
function skip(event: MouseEvent): void {
    event.preventDefault();
    document.getElementById("view")?.focus();
}
