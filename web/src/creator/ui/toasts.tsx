// Lines that are shown for some seconds.

import { render } from "preact";
import { useEffect } from "preact/hooks";
import type { App, Toast } from "../app.js";
import { IconButton } from "./icons.js";

/** Show toasts above everything: outside of an open dialog all is inert, so they are inside of it. */
export function showToasts(app: App): void {
    const place = document.createElement("div");
    document.body.append(place);
    render(<Toasts app={app} place={place} />, place);
}

function Toasts({ app, place }: { app: App; place: HTMLElement }) {
    const [toasts, dialog] = [app.toasts.value, app.dialog.value];
    const spoken = (kind: Toast["kind"]): string =>
        toasts.flatMap((each) => (each.kind === kind ? each.text : [])).join(". ");
    useEffect(() => {
        // the dialog opens after this
        requestAnimationFrame(() => (document.querySelector("dialog[open]") ?? document.body).append(place));
    }, [dialog, toasts]);
    return (
        <>
            <div class="toasts">
                {toasts.map(({ id, text, kind }) => (
                    <div key={id} class={`toast ${kind}`} data-name={`toast-${kind}`}>
                        <span>{text}</span>
                        {kind === "error" && (
                            <IconButton small name="close" label="Dismiss" onClick={() => app.dismiss(id)} />
                        )}
                    </div>
                ))}
            </div>
            <div class="unseen" role="status" children={spoken("note")} />
            <div class="unseen" role="alert" children={spoken("error")} />
        </>
    );
}
