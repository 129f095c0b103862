// The list of objects, and what can be done with them.

import { useEffect, useRef } from "preact/hooks";
import type { App } from "../app.js";
import type { Item } from "../../document/document.js";
import { renamed, reordered } from "../../document/objects.js";
import { IconButton, type IconAction } from "./icons.js";
import { duplicate, remove } from "./keys.js";
import { open, show } from "../state.js";

/** Let the next object that is opened be a further one, and show where they are. */
function add(): void {
    show({ adding: true, page: "shelf" });
    document.querySelector<HTMLElement>("[data-name=search]")?.focus();
}

export function Objects({ app }: { app: App }) {
    const { objects } = app.calm.value;
    const selected = app.selected.value;
    const one = selected.size === 1 ? [...selected][0] : null;
    const place = objects.findIndex(({ id }) => id === one);
    const choose = (id: string, more: boolean): void => app.select(id === one && !more ? null : id, more);
    const reorder = (by: number): void => app.change(reordered(app.doc.value, one as string, by), "Change the order");
    const [several, some] = [objects.length > 1, selected.size > 0 && selected.size < objects.length];
    const [isFirst, isLast] = [place === 0, place === objects.length - 1];
    const moves = several && one !== null;
    const actions: (IconAction | false | null)[] = [
        moves && { id: "object-up", name: "up", label: "Draw earlier", disabled: isFirst, onClick: () => reorder(-1) },
        moves && { id: "object-down", name: "down", label: "Draw later", disabled: isLast, onClick: () => reorder(1) },
        { id: "add-object", name: "plus", label: "Add an object from the shelf", onClick: add },
        { id: "duplicate", name: "copy", label: "Duplicate (D)", onClick: () => duplicate(app) },
        some && { id: "remove", name: "remove", label: "Remove (Delete)", onClick: () => remove(app) },
    ];
    const what =
        selected.size === 1 ? "the selected object" : `${selected.size || "all"} ${some ? "selected " : ""}objects`;
    return (
        <section class="objects" aria-labelledby="objects">
            <div class="head">
                <h2 id="objects">{objects.length === 1 ? "Object" : `${objects.length} objects`}</h2>
                {actions.map((each) => each && <IconButton small key={each.id} {...each} />)}
            </div>
            <ul class="list" data-name="objects">
                {objects.map((item) => (
                    <li key={item.id}>
                        {open.value.naming === item.id ? (
                            <Name app={app} item={item} />
                        ) : (
                            <button
                                type="button"
                                aria-pressed={selected.has(item.id)}
                                title="Click to select, double click to rename"
                                data-name={`object-${item.id}`}
                                onClick={(event) => choose(item.id, event.shiftKey || event.ctrlKey || event.metaKey)}
                                onDblClick={() => show({ naming: item.id })}
                                onKeyDown={(event) => {
                                    if (event.key === "F2") show({ naming: item.id });
                                }}
                            >
                                <i class="swatch" style={item.color ? { background: item.color } : undefined} />
                                <span>{item.name || "Object"}</span>
                                <span class="quiet">{trianglesOf(app, item)}</span>
                            </button>
                        )}
                    </li>
                ))}
            </ul>
            {several && (
                <p class="quiet" data-name="selection">
                    Controls change {what}.
                </p>
            )}
        </section>
    );
}

function trianglesOf(app: App, { mesh, maxTriangles }: Item): string {
    try {
        const { triangles } = app.meshes.get(mesh);
        return `${Math.min(triangles, maxTriangles ?? triangles).toLocaleString("en")} tri.`;
    } catch {
        return "missing";
    }
}

function Name({ app, item }: { app: App; item: Item }) {
    const field = useRef<HTMLInputElement>(null);
    useEffect(() => field.current?.select(), []);
    const end = (keep: boolean): void => {
        if (open.peek().naming !== item.id) return;
        const name = field.current?.value.trim();
        show({ naming: null });
        if (keep && name && name !== item.name) app.change(renamed(app.doc.value, item.id, name), "Rename");
    };
    return (
        <input
            ref={field}
            defaultValue={item.name}
            maxLength={64}
            aria-label={`Name of ${item.name}`}
            data-name="object-name"
            onBlur={() => end(true)}
            onKeyDown={({ key }) => {
                if (key === "Enter" || key === "Escape") end(key === "Enter");
            }}
        />
    );
}
