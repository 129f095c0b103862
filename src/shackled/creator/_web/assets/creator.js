// The page: sends what the visitor does, and shows what comes back. What a message means is decided by the server; the
// messages are described in live.py.

import { Local } from "./local.js";
import { View } from "./view.js";
import { askWallet, findWallets } from "./wallets.js";
import * as wire from "./wire.js";
import { connect, flush } from "./wire.js";

const $ = (selector, within = document) => within.querySelector(selector);
const $$ = (selector, within = document) => [...within.querySelectorAll(selector)];
const keys = JSON.parse(document.body.dataset.keys);
const local = new Local({ send: wire.send, paint, prepared: (is) => { $("#picture").dataset.ready = is; } });
// messages after which no picture follows
const still = ["takeaway", "wallets", "stages", "answer", "node", "gif", "stop-gif", "mint", "edition", "reveal-open", "reveal", "reveal-send"];
const send = (message) => {
  if (still.includes(message.do)) local.end();
  else local.leave();
  return wire.send(message);
};
const move = (name, more, add) => { local.leave(); wire.move(name, more, add); };
const endMove = () => { if (!local.end()) { flush(); wire.send({ do: "rest" }); } };
const view = new View($("#view"), {
  move: (name, more, add, held) => local.move(name, more, held) || move(name, more, add),
  rest: endMove,
  covered: () => local.moving,
});
let visitor = "";
let opens = location.pathname === "/reveal"; // an address that can be shared

// ---- what comes back ----

// a picture: four bytes of length, that much JSON, and a BMP file
function picture(data) {
  const length = new DataView(data).getUint32(0);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
  const wanted = head.view ? local.settle(head.view) : !local.moving;
  show(head.show); // even of an outdated picture: the next message tells only what differs
  if (wanted) view.show(new Blob([new Uint8Array(data, 4 + length)], { type: "image/bmp" }), head.number, head.draft);
}

// a picture of a movement that was drawn here
function paint({ width, height, pixels, gas }, { azimuth, elevation, distance, target: [x, y, z] }) {
  view.paint(new ImageData(pixels, width, height));
  const places = { azimuth, elevation, distance, "target.x": x, "target.y": y, "target.z": z };
  const values = Object.entries(places).map(([name, value]) => [`camera.${name}`, { value: Number(value.toFixed(2)), changed: true }]);
  const texts = { gas: gas.toLocaleString("en"), "gas-label": `Gas, at ${width} x ${height}` };
  show({ values: Object.fromEntries(values), texts });
}

const showers = {
  visitor: (name) => {
    if (visitor && name !== visitor) return location.reload(); // the server was restarted: the link restores the picture
    visitor = name;
    local.join(name);
    if (opens) send({ do: "reveal-open" });
    opens = false;
    for (const link of $$("[data-take]")) link.href = `/take/${visitor}/${link.dataset.take}`;
  },
  values: (values) => { for (const [path, value] of Object.entries(values)) setValue(path, value); },
  texts: (texts) => { for (const [name, text] of Object.entries(texts)) $$(`[data-text="${name}"]`).forEach((e) => { e.textContent = text; }); },
  attributes: (changes) => {
    for (const [name, attributes] of Object.entries(changes)) {
      for (const element of $$(`[data-name~="${name}"]`)) {
        for (const [key, value] of Object.entries(attributes)) {
          if (value === null) element.removeAttribute(key);
          else element.setAttribute(key, value);
        }
      }
    }
  },
  html: (parts) => { for (const [name, html] of Object.entries(parts)) $(`[data-html="${name}"]`).innerHTML = html; },
  spheres: (spheres) => spheres.forEach(setSphere),
  aspect: (aspect) => $("#stage").style.setProperty("--aspect", aspect),
  link: (link) => history.replaceState(null, "", link),
  say: (text) => say(text),
  alert: (text) => toast(text, "alert"),
  note: (text) => toast(text, "note"),
  open: (name) => {
    const dialog = document.getElementById(name);
    if (!dialog.open) dialog.showModal();
    $("#link").value = location.href;
    if (name === "takeaway" || name === "reveal") send({ do: "wallets", names: findWallets() });
  },
  close: (name) => document.getElementById(name).close(),
  wallet: async (request) => { const answer = await askWallet(request); send({ do: "answer", ...answer }); },
  download: (url) => take(url),
};

function show(message) {
  for (const [name, value] of Object.entries(message)) showers[name]?.(value);
}

let speaking;
function say(text) {
  clearTimeout(speaking); // not during a movement
  speaking = setTimeout(() => { $("#spoken").textContent = text; }, 600);
}

const toasts = Object.assign(document.createElement("div"), { id: "toasts" });
function toast(text, kind) {
  ($("dialog[open]") ?? document.body).append(toasts); // everything outside an open dialog is inert
  const line = Object.assign(document.createElement("div"), { className: `toast ${kind}`, textContent: text });
  line.setAttribute("role", kind === "alert" ? "alert" : "status");
  if (kind === "alert") {
    const button = Object.assign(document.createElement("button"), { className: "icon", textContent: "×", onclick: () => line.remove() });
    button.setAttribute("aria-label", "Dismiss");
    line.append(button);
  }
  while (toasts.children.length > 2) toasts.firstChild.remove();
  toasts.append(line);
  setTimeout(() => line.remove(), kind === "alert" ? 15000 : 3000 + 70 * text.length); // time to read it
}
document.addEventListener("close", () => document.body.append(toasts), true);

// ---- controls ----

const inputs = (path) => $$(`[data-path="${CSS.escape(path)}"]`);

// the value of a logarithmic slider is low * (high / low)^t
function place(slider, value) {
  const { low, high, log } = slider.dataset;
  if (!log) return value;
  return 1000 * Math.log(Math.max(value, low) / low) / Math.log(high / low);
}
function read(slider) {
  const { low, high, log, whole } = slider.dataset;
  if (!log) return Number(slider.value);
  const value = low * (high / low) ** (slider.value / 1000);
  return whole ? Math.round(value) : Number(value.toPrecision(3));
}

function setValue(path, { value, changed, mixed }) {
  for (const input of inputs(path)) {
    if (input.type === "radio") input.checked = !mixed && input.value === String(value);
    else if (input.type === "checkbox") { input.checked = Boolean(value); input.indeterminate = Boolean(mixed); }
    else if (input.type === "range") { if (input !== held) input.value = value === null ? input.max : place(input, value); fill(input); }
    else if (input !== document.activeElement || !typing) input.value = (mixed ? null : value) ?? (input.type === "color" ? "#808080" : "");
    if (input.type === "number" && (mixed || input.placeholder === "mixed")) input.placeholder = mixed ? "mixed" : "";
    input.classList.toggle("none", value === null);
    if (input.dataset.none) input.setAttribute("aria-description", value === null ? input.dataset.none : "");
  }
  const row = $(`[data-row="${CSS.escape(path)}"]`);
  row?.classList.toggle("changed", Boolean(changed));
  row?.classList.toggle("mixed", Boolean(mixed)); // the objects differ
  const choices = row && $("[role=radiogroup]", row);
  if (choices) choices.setAttribute("aria-description", mixed ? "mixed" : "");
}

function fill(slider) {
  slider.style.setProperty("--at", `${100 * (slider.value - slider.min) / (slider.max - slider.min)}%`);
}

let held = null, typing = false;
document.addEventListener("input", ({ target }) => {
  const path = target.dataset?.path;
  if (target.dataset?.search !== undefined) return search(target);
  if (!path) return;
  if (target.type === "range") {
    held = target;
    fill(target);
    move("put", { path, value: read(target) });
  } else if (target.type === "color") move("put", { path, value: target.value });
  else if (target.type === "number") typing = true;
});
document.addEventListener("change", ({ target }) => {
  const path = target.dataset?.path;
  if (!path) return;
  flush();
  held = null;
  typing = false;
  if (target.type === "checkbox") send({ do: "put", path, value: target.checked });
  else if (target.type === "radio") send({ do: "put", path, value: target.value });
  else if (target.type === "number") send(target.value === "" ? { do: "reset", path } : { do: "put", path, value: Number(target.value) });
  else if (target.type === "color") send({ do: "put", path, value: target.value });
  send({ do: "rest" });
});
document.addEventListener("focusout", () => { typing = false; });

// ---- buttons ----

document.addEventListener("click", (event) => {
  local.end();
  const button = event.target.closest("[data-do], [data-open], [data-close], [data-copy], [data-copy-of], [data-copy-link], [data-theme-toggle], [data-tab]");
  if (event.target.tagName === "DIALOG") return event.target.close(); // on the backdrop
  const file = event.target.closest("a[download]");
  if (file && !file.href.startsWith("blob:")) { event.preventDefault(); take(file.href); }
  if (!button) return;
  const { dataset } = button;
  if (dataset.do && !send({ ...JSON.parse(dataset.do), ...fields(button) })) toast("The server does not respond", "alert");
  if (dataset.close !== undefined) button.closest("dialog")?.close();
  if (dataset.open) document.getElementById(dataset.open).showModal();
  if (dataset.copy) copy(snippet(`/take/${visitor}/${dataset.copy}`));
  if (dataset.copyOf) copy(Promise.resolve(document.getElementById(dataset.copyOf).textContent));
  if (dataset.copyLink !== undefined) copy(Promise.resolve(location.href));
  if (dataset.themeToggle !== undefined) setTheme(dark() ? "light" : "dark");
  if (dataset.tab) tab(dataset.tab);
});

// what is typed beside a button: the inputs of its fieldset that have names, unless they are controls of the picture
function fields(button) {
  const inputs = $$("input[name]:not([data-path], [type=checkbox]:not(:checked))", button.closest("fieldset") ?? button);
  return inputs.length ? { fields: Object.fromEntries(inputs.map(({ name, value }) => [name, value])) } : {};
}

// download a file, or show the error: a plain link would save the error as the file
async function take(url) {
  try {
    const answer = await fetch(url);
    if (!answer.ok) return toast((await answer.text()).slice(0, 400), "alert");
    const name = /filename="([^"]+)"/.exec(answer.headers.get("content-disposition"))?.[1] ?? "picture";
    const href = URL.createObjectURL(await answer.blob());
    const anchor = Object.assign(document.createElement("a"), { href, download: name });
    document.body.append(anchor);
    anchor.click();
    anchor.remove();
    setTimeout(() => URL.revokeObjectURL(href), 60000);
  } catch {
    toast("The server does not respond", "alert");
  }
}

async function snippet(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error((await answer.text()).slice(0, 400));
  return answer.text();
}

// text is a promise: browsers allow copying only right after a click
async function copy(text) {
  try {
    const blob = text.then((words) => new Blob([words], { type: "text/plain" }));
    // a browser that refuses to copy may never look at it; the error of text is shown below
    blob.catch(() => {});
    await navigator.clipboard.write([new ClipboardItem({ "text/plain": blob })]);
    toast("Copied", "note");
  } catch {
    const forbidden = "The browser does not allow the page to copy: select the text and copy it";
    toast(await text.then(() => forbidden, (error) => error.message), "alert");
  }
}

function tab(name) {
  for (const each of $$("[data-tab]")) each.setAttribute("aria-pressed", each.dataset.tab === name);
  for (const each of $$("[data-shelf]")) each.hidden = each.dataset.shelf !== name;
}

function search(input) {
  const words = input.value.trim().toLowerCase();
  for (const item of $$(".shelf-items button")) item.hidden = words !== "" && !item.dataset.words.includes(words);
  for (const shelf of $$("[data-shelf]")) {
    if (words) shelf.hidden = $$(".shelf-items button", shelf).every((item) => item.hidden);
  }
  if (!words) tab($('[data-tab][aria-pressed="true"]').dataset.tab);
  $("#shelf-none").hidden = !words || $$("[data-shelf]").some((shelf) => !shelf.hidden);
}
document.addEventListener("keydown", (event) => {
  if (event.target.dataset?.search !== undefined && event.key === "Enter") {
    const value = event.target.value.trim();
    const found = $$(".shelf-items button").filter((item) => item.offsetParent);
    // the server checks whatever looks like a seed
    if (/^\d{1,4}$|^0x[0-9a-f]*$|^[0-9a-f]{16,}$/i.test(value)) {
      send({ do: "seed", text: value });
      if (seed.test(value)) { event.target.value = ""; search(event.target); }
    } else if (value) found[0]?.click();
  }
});

const dark = () => (document.documentElement.style.colorScheme || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light")) === "dark";
function setTheme(theme) {
  document.documentElement.style.colorScheme = theme;
  try { localStorage.setItem("theme", theme); } catch { /* no storage */ }
}

// ---- the spheres of the lights ----

let lamp = null;
document.addEventListener("pointerdown", (event) => {
  const sphere = event.target.closest(".sphere");
  if (!sphere) return;
  event.preventDefault();
  sphere.setPointerCapture(event.pointerId);
  lamp = sphere;
  dragLamp(event);
});
function dragLamp(event) {
  if (!lamp) return;
  const box = lamp.getBoundingClientRect();
  const x = (event.clientX - box.x) / box.width * 2 - 1, y = (event.clientY - box.y) / box.height * 2 - 1;
  move("lamp", { number: Number(lamp.dataset.number), x, y });
}
function releaseLamp() {
  if (!lamp) return;
  lamp = null;
  endMove();
}
document.addEventListener("pointermove", dragLamp);
document.addEventListener("pointerup", releaseLamp);
document.addEventListener("pointercancel", releaseLamp);
function setSphere(at, number) {
  const group = $(`[data-lamp="${number}"]`);
  group.hidden = !at;
  if (!at) return;
  const dot = $(".sphere .dot", group);
  dot.style.left = `${50 + 50 * at.x}%`;
  dot.style.top = `${50 + 50 * at.y}%`;
  dot.classList.toggle("behind", !at.front);
  const ball = $(".sphere", group).style;
  ball.setProperty("--x", `${50 + 38 * at.x}%`);
  ball.setProperty("--y", `${50 + 38 * at.y}%`);
  ball.setProperty("--lamp", at.color);
  ball.setProperty("--lit", at.front ? "100%" : "35%");
}

// ---- keys ----

// fields of text take all keys; sliders, choices and colours take arrows and Home, and buttons take Enter
const typed = (element) => element.closest("input:not([type=range], [type=checkbox], [type=radio], [type=color]), textarea, select");
const own = (element, key) => key === "Enter" ? element.closest("button, a, summary, input, label") : key.length > 1 && element.closest("input:not([type=checkbox])");
document.addEventListener("keydown", (event) => {
  if (event.isComposing || $("dialog[open]")) return;
  const control = event.ctrlKey || event.metaKey;
  const name = `${control ? "Ctrl+" : ""}${event.shiftKey && (control || event.key.length > 1) ? "Shift+" : ""}${control ? event.key.toLowerCase() : event.key}`;
  const message = keys[name];
  if (!message || event.altKey || typed(event.target)) return;
  if (!control && own(event.target, event.key)) return;
  event.preventDefault();
  if (message.open) document.getElementById(message.open).showModal();
  else if (!["orbit", "pan", "zoom"].includes(message.do) || !local.move(message.do, message, view.held)) send(message);
});

// ---- files and seeds from outside ----

const seed = /^(0x)?[0-9a-f]{64}$/i;

// the server reads one upload of a visitor at a time
let uploads = Promise.resolve();
function upload(files) {
  if (files.length) uploads = uploads.then(() => sendFiles(files));
}
async function sendFiles(files) {
  // four bytes of length, that much JSON with names and sizes, and the files
  const head = new TextEncoder().encode(JSON.stringify(files.map((file) => [file.name, file.size])));
  const length = new DataView(new ArrayBuffer(4));
  length.setUint32(0, head.length);
  const body = new Blob([length, head, ...files]);
  document.body.classList.add("busy");
  try {
    const answer = await fetch(`/upload/${visitor}`, { method: "POST", body });
    if (!answer.ok) toast((await answer.text()).slice(0, 400) || "The file could not be sent", "alert");
  } catch {
    toast("The file could not be sent: the server does not respond, or the file is too large", "alert");
  } finally {
    document.body.classList.remove("busy");
  }
}
document.addEventListener("change", ({ target }) => {
  if (target.id !== "file") return;
  upload([...target.files]);
  target.value = "";
});
let over = 0;
document.addEventListener("dragenter", (event) => { if (event.dataTransfer?.types.includes("Files")) { over += 1; document.body.classList.add("dropping"); } });
document.addEventListener("dragleave", () => { over = Math.max(0, over - 1); if (!over) document.body.classList.remove("dropping"); });
document.addEventListener("dragover", (event) => event.preventDefault());
document.addEventListener("drop", (event) => {
  event.preventDefault();
  over = 0;
  document.body.classList.remove("dropping");
  if (event.dataTransfer.files.length) upload([...event.dataTransfer.files]);
  else { const text = event.dataTransfer.getData("text").trim(); if (seed.test(text)) send({ do: "seed", text }); }
});
document.addEventListener("paste", (event) => {
  const { files } = event.clipboardData;
  const text = event.clipboardData.getData("text").trim();
  if (files.length) upload([...files]);
  else if (seed.test(text)) { event.preventDefault(); send({ do: "seed", text }); }
});

// ---- start ----

$$("input[type=range]").forEach(fill);
connect(() => visitor, show, picture);
