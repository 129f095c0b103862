// The picture as PNG, as a turntable, as a page, and as a link.

import { useEffect, useState } from "preact/hooks";
import { isLocal, stemOf, titleOf } from "../programs/subject.js";
import { MAX_FILE_SIDE } from "../work/protocol.js";
import { Button, Choices, Pixels, Progress, count, gasWords, useTask, type TabProps } from "./widgets.js";

/** The largest PNG that is offered first, in pixels a side. */
const COMMON = 1024;
const SCALES = [1, 2, 3, 4, 5, 6, 7, 8];
/** Pixels of all pictures of a turntable, and the side to which they are enlarged. */
const MAX_FILM = 60_000_000;
const TURNING = { gif: 512, apng: 256 };
const MAX_FRAMES = 120;

export function PictureTab(props: TabProps) {
    return (
        <>
            <Png {...props} />
            <section>
                <h3>For a friend</h3>
                <Page {...props} />
                <Link {...props} />
            </section>
            <Turntable {...props} />
        </>
    );
}

function Png({ app, doc, drawn }: TabProps) {
    const longest = Math.max(doc.width, doc.height);
    const scales = SCALES.filter((scale) => scale === 1 || scale * longest <= MAX_FILE_SIDE);
    const [scale, choose] = useState(Math.max(...scales.filter((each) => each === 1 || each * longest <= COMMON)));
    const [transparent, setTransparent] = useState(false);
    const [ready, setReady] = useState<File | null>(null);
    const task = useTask();
    useEffect(() => setReady(null), [doc, scale, transparent]);
    const title = titleOf(doc);
    const make = async (signal: AbortSignal): Promise<File> => {
        const blob = await app.work.png(doc, { scale, transparent, signal });
        return new File([blob], `${stemOf(title)}.png`, { type: "image/png" });
    };
    const save = async (signal: AbortSignal): Promise<void> => {
        const file = await make(signal);
        app.save(file, file.name);
    };
    const share = async (signal: AbortSignal): Promise<void> => {
        const file = ready ?? (await make(signal));
        setReady(file);
        try {
            await navigator.share({ files: [file], title });
        } catch (error) {
            // closed by the visitor; or the click is too long ago, and the next one shares at once
            if (!(error instanceof DOMException && ["AbortError", "NotAllowedError"].includes(error.name))) throw error;
        }
    };
    const figures = drawn ? `, ${gasWords(drawn.gas)}, ${count(drawn.triangles)} triangles` : "";
    const named = scales.map((each) => [each, `${each}×`] as const);
    const toggle = (event: { currentTarget: HTMLInputElement }): void => setTransparent(event.currentTarget.checked);
    const busy = task.part !== null;
    return (
        <section class="take">
            <Pixels drawn={drawn} label={`The picture: ${title}`} />
            <div>
                <h3>{title}</h3>
                <p class="quiet">{`${doc.width} × ${doc.height} pixels${figures}`}</p>
                <Choices name="scale" label="Size of the PNG" value={scale} does={choose} of={named} />
                <label class="check">
                    <input type="checkbox" name="transparent" checked={transparent} onChange={toggle} />
                    Without background
                </label>
                <div class="scales">
                    <Button name="take-png" look="main big" off={busy} does={() => task.start(save)}>
                        Save PNG, {scale * doc.width} × {scale * doc.height}
                    </Button>
                    {canShare() && (
                        <Button name="share" off={busy} does={() => task.start(share)}>
                            {ready ? "Share now" : "Share …"}
                        </Button>
                    )}
                </div>
                <Progress task={task} what="Making the PNG" />
                <p class="quiet">
                    Made by the contract PngEncoder, with the scene inside if that takes at most 64 KB: drop the file on
                    this page to go on.
                </p>
            </div>
        </section>
    );
}

function canShare(): boolean {
    const files = [new File([""], "a.png", { type: "image/png" })];
    return typeof navigator.share === "function" && (navigator as Partial<Navigator>).canShare?.({ files }) === true;
}

function Page({ app, doc }: TabProps) {
    const task = useTask();
    const make = async (signal: AbortSignal): Promise<void> =>
        app.save(await app.work.page(doc, { signal }), `${stemOf(titleOf(doc))}.html`);
    return (
        <>
            <div class="scales">
                <Button name="take-page" off={task.part !== null} does={() => task.start(make)}>
                    Save a page that turns
                </Button>
            </div>
            <Progress task={task} what="Making the page" />
            <p class="quiet">
                One file to send or to keep. It opens in any browser, without the network, and the scene can be turned
                there.
            </p>
        </>
    );
}

function Link({ app }: TabProps) {
    const address = app.address;
    const missing = app.missing.value.join(", ");
    return (
        <>
            <div class="linkline">
                <input class="field" readOnly aria-label="A link that restores everything" value={address} />
                <Button name="take-link" off={!address} does={() => void app.copy(address)}>
                    Copy link
                </Button>
            </div>
            <p class="quiet">
                {isLocal(location.href)
                    ? "This page is on this computer only, and so is its link: send others the page that turns, the PNG or the scene file. What follows # restores the picture on any other copy of this page, too."
                    : "It restores everything, and can be changed further."}
                {missing &&
                    ` Files that you opened are not in the link: whoever follows it must open the same ones there (${missing}).`}
            </p>
        </>
    );
}

function Turntable({ app, doc }: TabProps) {
    const [format, setFormat] = useState<"gif" | "apng">("gif");
    const [frames, setFrames] = useState(24);
    const [seconds, setSeconds] = useState(3);
    const [url, show] = useState("");
    const task = useTask();
    useEffect(() => () => URL.revokeObjectURL(url), [url]);
    const { width, height } = doc;
    const pixels = width * height * frames;
    const most = Math.floor(TURNING[format] / Math.max(width, height));
    const scale = Math.max(1, Math.min(4, most, Math.floor(Math.sqrt(MAX_FILM / pixels))));
    const duration = Math.min(10_000, Math.max(20, Math.round((1000 * seconds) / frames)));
    const make = async (signal: AbortSignal, onProgress: (part: number) => void): Promise<void> => {
        const blob = await app.work[format](doc, { frames, duration, scale, signal, onProgress });
        show(URL.createObjectURL(blob));
        app.save(blob, `${stemOf(titleOf(doc))}-turning.${format === "gif" ? "gif" : "png"}`);
    };
    const formats = [["gif", "GIF"] as const, ["apng", "APNG"] as const];
    const help = {
        gif: "Opens everywhere, in at most 256 colours.",
        apng: "In all colours, made by the contract Turntable. Some programs show its first picture only.",
    };
    const excess = `The pictures are too large together, by ${Math.ceil((100 * pixels) / MAX_FILM - 100)} %: choose fewer or smaller ones.`;
    return (
        <section>
            <h3>Turntable</h3>
            <div class="scales">
                <Choices name="turntable" label="Format" value={format} does={setFormat} of={formats} />
                <Count unit="pictures" value={frames} low={2} high={MAX_FRAMES} step={1} does={setFrames} />
                <Count unit="seconds" value={seconds} low={0.5} high={60} step={0.5} does={setSeconds} />
                <Button
                    name={`take-${format}`}
                    off={task.part !== null || pixels > MAX_FILM}
                    does={() => task.start(make)}
                >
                    Make {format.toUpperCase()}, {scale * width} × {scale * height}
                </Button>
            </div>
            <Progress task={task} what="Making the turntable" />
            {url && <img class="made" src={url} alt="The turntable" />}
            <p class="quiet">{pixels > MAX_FILM ? excess : help[format]}</p>
        </section>
    );
}

/** A number within bounds. */
function Count(props: {
    unit: string;
    value: number;
    low: number;
    high: number;
    step: number;
    does: (to: number) => void;
}) {
    const { unit, value, low, high, step, does } = props;
    const take = ({ currentTarget: field }: { currentTarget: HTMLInputElement }): void => {
        const found = Math.min(high, Math.max(low, step * Math.round(field.valueAsNumber / step) || low));
        field.value = String(found);
        does(found);
    };
    return (
        <label class="count">
            <input type="number" min={low} max={high} step={step} defaultValue={value} onChange={take} /> {unit}
        </label>
    );
}
