// What was made here and kept in this browser.

import { useEffect, useState } from "preact/hooks";
import type { App } from "../app.js";
import { titleOf } from "../programs/subject.js";
import { duplicateThing, keepThing, openThing, removeThing, renameThing, things, type Thing } from "../things.js";
import { IconButton } from "../ui/icons.js";
import { Button, Progress, Trouble, useMade, useTask } from "./widgets.js";

/** Pixels of the longer side of a picture on a card. */
const SIDE = 160;

export function Things({ app }: { app: App }) {
    const [version, setVersion] = useState(0);
    const found = useMade(things, [version]);
    const [seen, see] = useState<Thing[] | null>(null);
    const task = useTask();
    // the cards stay while they are read again
    useEffect(() => {
        if (found.value) see(found.value);
    }, [found.value]);
    const change = (work: (signal: AbortSignal) => Promise<unknown>): void =>
        task.start(async (signal) => {
            await work(signal);
            setVersion((each) => each + 1);
        });
    const keep = async (signal: AbortSignal): Promise<void> => {
        const doc = app.doc.value;
        const factor = Math.min(1, SIDE / Math.max(doc.width, doc.height));
        const sized = (side: number): number => Math.max(1, Math.round(side * factor));
        const [width, height] = [sized(doc.width), sized(doc.height)];
        const { pixels } = await app.work.draw(doc, { width, height, lane: "background", signal });
        const canvas = Object.assign(document.createElement("canvas"), { width, height });
        canvas.getContext("2d")?.putImageData(new ImageData(pixels, width, height), 0, 0);
        await keepThing(doc, await new Promise<Blob | null>((done) => canvas.toBlob(done)), titleOf(doc));
    };
    return (
        <>
            <section class="scales">
                <Button name="keep" look="main" off={task.part !== null} does={() => change(keep)}>
                    Keep the present picture
                </Button>
                <p class="quiet">
                    Kept in this browser only, with files that you opened. Save a scene file to have it elsewhere.
                </p>
            </section>
            <Progress task={task} what="Working" />
            <Trouble text={found.error} />
            {seen?.length === 0 && <p>Nothing is kept yet.</p>}
            <ul class="things">
                {seen?.map((thing) => (
                    <Card
                        key={thing.id}
                        thing={thing}
                        open={() =>
                            task.start(async () => {
                                await app.openDocument(await openThing(thing.id), `Open ${thing.name}`);
                                app.closeDialog();
                            })
                        }
                        rename={(name) => change(() => renameThing(thing.id, name))}
                        duplicate={() => change(() => duplicateThing(thing.id))}
                        remove={() => change(() => removeThing(thing.id))}
                    />
                ))}
            </ul>
        </>
    );
}

function Card(props: {
    thing: Thing;
    open: () => void;
    rename: (name: string) => void;
    duplicate: () => void;
    remove: () => void;
}) {
    const { thing, open, rename, duplicate, remove } = props;
    const [sure, setSure] = useState(false);
    const [url, setUrl] = useState("");
    const { name, changed, picture } = thing;
    useEffect(() => {
        const made = picture ? URL.createObjectURL(picture) : "";
        setUrl(made);
        return () => URL.revokeObjectURL(made);
    }, [picture]);
    return (
        <li>
            <button type="button" class="open" aria-label={`Open: ${name}`} onClick={open}>
                {url ? <img src={url} alt="" /> : <span class="pixels" />}
            </button>
            <input
                class="field"
                aria-label="Name"
                maxLength={120}
                defaultValue={name}
                onChange={(event) => {
                    const chosen = event.currentTarget.value.trim();
                    if (chosen) rename(chosen);
                    else event.currentTarget.value = name;
                }}
            />
            <div class="care">
                <time class="quiet" dateTime={new Date(changed).toISOString()}>
                    {new Date(changed).toLocaleDateString(undefined, { dateStyle: "medium" })}
                </time>
                {sure ? (
                    <button
                        type="button"
                        class="button small"
                        onClick={remove}
                        onBlur={() => setSure(false)}
                        ref={(button) => button?.focus()}
                    >
                        Delete for good
                    </button>
                ) : (
                    <>
                        <IconButton small name="copy" label={`Duplicate: ${name}`} onClick={duplicate} />
                        <IconButton small name="remove" label={`Delete: ${name}`} onClick={() => setSure(true)} />
                    </>
                )}
            </div>
        </li>
    );
}
