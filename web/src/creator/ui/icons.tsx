// Icons, as paths in a square of 24, and buttons with them.

import type { ComponentChildren } from "preact";

const PATHS = {
    undo: "M5 5.5V11h5.5M5.2 10.8C7 8 9.6 6.5 12.6 6.5c4 0 6.9 2.7 6.9 6.3 0 3.2-2.3 5.7-5.5 6.2",
    redo: "M19 5.5V11h-5.5M18.8 10.8C17 8 14.4 6.5 11.4 6.5c-4 0-6.9 2.7-6.9 6.3 0 3.2 2.3 5.7 5.5 6.2",
    fit: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
    reset: "M4 4v6h6M4.5 14a8 8 0 1 0 1.8-7.5L4 10",
    help: "M9 9a3 3 0 1 1 4.2 2.8c-.8.3-1.2.9-1.2 1.7v.5M12 17.2v.1M12 21a9 9 0 1 1 0-18 9 9 0 0 1 0 18Z",
    theme: "M12 21a9 9 0 1 1 0-18 9 9 0 0 1 0 18ZM12 3v18M12 7.5 17.5 5M12 12l8.5-3M12 16.5l8.5-3",
    download: "M12 4v11m0 0 4.5-4.5M12 15l-4.5-4.5M5 19.5h14",
    open: "M12 15V4m0 0L7.5 8.5M12 4l4.5 4.5M5 15v4.5h14V15",
    close: "M6 6l12 12M18 6 6 18",
    plus: "M12 5v14M5 12h14",
    dice: "M5 4h14a1 1 0 0 1 1 1v14a1 1 0 0 1-1 1H5a1 1 0 0 1-1-1V5a1 1 0 0 1 1-1ZM8.5 8.5v.1M15.5 8.5v.1M12 12v.1M8.5 15.5v.1M15.5 15.5v.1",
    surprise:
        "M11 3.5l1.9 5.1 5.1 1.9-5.1 1.9L11 17.5l-1.9-5.1L4 10.5l5.1-1.9ZM18 15.5l.9 2.1 2.1.9-2.1.9-.9 2.1-.9-2.1-2.1-.9 2.1-.9Z",
    things: "M4 4.5h7v7H4zM13 4.5h7v7h-7zM4 13.5h7v7H4zM13 13.5h7v7h-7z",
    about: "M12 11v6M12 7.3v.1M12 21a9 9 0 1 1 0-18 9 9 0 0 1 0 18Z",
    turn: "M20 12a8 3.4 0 1 1-3-2.7M20 5.5v4.3h-4.3M12 4v4.5M12 15.5V20",
    move: "M12 3v18M3 12h18M12 3 9.5 5.5M12 3l2.5 2.5M12 21l-2.5-2.5M12 21l2.5-2.5M3 12l2.5-2.5M3 12l2.5 2.5M21 12l-2.5-2.5M21 12l-2.5 2.5",
    light: "M9.5 18h5M10.5 21h3M8 14.5a6 6 0 1 1 8 0c-.8.8-1.2 1.4-1.3 2.2H9.3c-.1-.8-.5-1.4-1.3-2.2Z",
    copy: "M9 9h11v11H9zM5 15H4V4h11v1",
    remove: "M5 7h14M10 7V4.5h4V7M6.5 7l1 13h9l1-13M10.5 11v5.5M13.5 11v5.5",
    up: "M12 19V5M6 11l6-6 6 6",
    down: "M12 5v14M6 13l6 6 6-6",
} as const;

export type IconName = keyof typeof PATHS;

export function Icon({ name }: { name: IconName }) {
    return (
        <svg viewBox="0 0 24 24" class="drawing" aria-hidden="true" focusable="false">
            <path d={PATHS[name]} />
        </svg>
    );
}

interface Does {
    name: IconName;
    /** What it is called. */
    label: string;
    /** What is shown at the pointer. */
    hint?: string | undefined;
    /** For tests. */
    id?: string | undefined;
    onClick: (event: MouseEvent) => void;
}

export interface IconAction extends Does {
    disabled?: boolean;
    pressed?: boolean;
    small?: boolean;
}

/** A button that is only an icon. */
export function IconButton(props: IconAction) {
    const { name, label, hint = label, id, small, pressed, ...rest } = props;
    const look = small ? "icon small" : "icon";
    return (
        <button
            {...rest}
            type="button"
            class={look}
            aria-label={label}
            aria-pressed={pressed}
            title={hint}
            data-name={id}
        >
            <Icon name={name} />
        </button>
    );
}

/** A button with an icon and words, which are its label if there are no others. */
export function Button(props: Does & { look?: string; popup?: boolean; children?: ComponentChildren }) {
    const { name, label, hint, id, look = "small", popup, children = label, onClick } = props;
    const menu = popup ? "dialog" : undefined;
    return (
        <button
            type="button"
            class={`button ${look}`}
            aria-label={label}
            aria-haspopup={menu}
            title={hint}
            data-name={id}
            onClick={onClick}
        >
            <Icon name={name} />
            {children}
        </button>
    );
}

/** A picture that is a button. */
export function Thumb(props: {
    id: string;
    title: string;
    url: string | undefined | null;
    pressed?: boolean | undefined;
    hint?: string;
    onClick: (event: MouseEvent) => void;
}) {
    const { id, title, url, pressed, hint = title, onClick } = props;
    return (
        <button type="button" class="piece" title={hint} aria-pressed={pressed} data-name={id} onClick={onClick}>
            {url ? <img class="thumb" src={url} alt="" width="64" height="64" decoding="async" /> : <i class="thumb" />}
            <span>{title}</span>
        </button>
    );
}

interface Choice<T> {
    name: T;
    title: string;
    /** What it is called, if not by its title. */
    spoken?: string;
}

/** Buttons in a row of which one is chosen. id: before the names, for tests. */
export function Choices<T extends string | number>(props: {
    id: string;
    label: string;
    of: readonly Choice<T>[];
    chosen: T | null;
    choose: (name: T) => void;
    look?: string;
}) {
    const { id, label, of, chosen, choose, look = "" } = props;
    return (
        <div class={`choices ${look}`} role="group" aria-label={label}>
            {of.map(({ name, title, spoken }) => {
                const does = {
                    "aria-pressed": chosen === name,
                    "data-name": `${id}-${name}`,
                    onClick: () => choose(name),
                };
                return (
                    <button key={name} type="button" aria-label={spoken} {...does}>
                        {title}
                    </button>
                );
            })}
        </div>
    );
}

export function Logo() {
    return (
        <svg class="logo" viewBox="0 0 32 32" width="26" height="26" aria-hidden="true" focusable="false">
            <path fill="#e8793a" d="M16 2 28.5 9 16 16 3.5 9Z" />
            <path fill="#b4410e" d="M3.5 9 16 16v14L3.5 23Z" />
            <path fill="#7a2a06" d="M28.5 9 16 16v14l12.5-7Z" />
            <rect x="12.6" y="13.2" width="6.8" height="11.4" rx="3.4" fill="none" stroke="#fff" stroke-width="2.2" />
        </svg>
    );
}
