// The hands and eyes of the page: sends what the visitor does, shows what comes back. What it means is decided by the
// server, in Python; a message that goes there is {"do": name, ...}, what comes back is described in live.py.

const $ = (selector, within = document) => within.querySelector(selector);
const $$ = (selector, within = document) => [...within.querySelectorAll(selector)];
let visitor = "", keys = {};
let socket = null, pause = 250, latest = 0;

// ---- the wire ----

function connect() {
  const scheme = location.protocol === "https:" ? "wss:" : "ws:";
  socket = new WebSocket(`${scheme}//${location.host}/live/${visitor}`);
  socket.binaryType = "arraybuffer";
  socket.onopen = () => { pause = 250; document.body.classList.remove("offline"); };
  socket.onmessage = ({ data }) => typeof data === "string" ? show(JSON.parse(data)) : picture(data);
  socket.onclose = ({ code }) => {
    document.body.classList.add("offline");
    if (code === 4404) return location.reload(); // the server was started anew: the link brings everything back
    setTimeout(connect, pause);
    pause = Math.min(2 * pause, 4000);
  };
}

function send(message) {
  const open = socket?.readyState === WebSocket.OPEN;
  if (open) socket.send(JSON.stringify(message));
  return open;
}

// movements are added up and sent once a frame
let moved = null;
function move(name, more, add) {
  if (moved && (moved.do !== name || moved.number !== more.number || moved.path !== more.path)) flush();
  if (!moved) {
    moved = { do: name, ...more };
    requestAnimationFrame(flush);
  } else {
    for (const key of add) moved[key] += more[key];
    for (const key in more) if (!add.includes(key)) moved[key] = more[key];
  }
}
function flush() {
  if (moved) send(moved);
  moved = null;
}

// ---- what comes back ----

// a picture: four bytes of length, that much JSON, and a file as the contract made it
async function picture(data) {
  const length = new DataView(data).getUint32(0);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
  show(head.show);
  const bitmap = await createImageBitmap(new Blob([new Uint8Array(data, 4 + length)], { type: "image/bmp" }));
  if (head.number < latest) return; // a later one was decoded sooner
  latest = head.number;
  const canvas = $("#picture");
  if (canvas.width !== bitmap.width || canvas.height !== bitmap.height) {
    canvas.width = bitmap.width;
    canvas.height = bitmap.height;
  }
  canvas.getContext("2d").drawImage(bitmap, 0, 0);
  canvas.dataset.number = head.number;
  canvas.dataset.draft = head.draft;
}

const showers = {
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
  spheres: (spheres) => spheres.forEach(setSphere),
  aspect: (aspect) => $("#stage").style.setProperty("--aspect", aspect),
  link: (link) => history.replaceState(null, "", link),
  say: (text) => say(text),
  alert: (text) => toast(text, "alert"),
  note: (text) => toast(text, "note"),
  open: (name) => { const dialog = document.getElementById(name); if (!dialog.open) dialog.showModal(); $("#link").value = location.href; if (name === "takeaway") findWallets(); },
  close: (name) => document.getElementById(name).close(),
  wallet: askWallet,
  download: (url) => take(url),
};

function show(message) {
  for (const [name, value] of Object.entries(message)) showers[name]?.(value);
}

let speaking;
function say(text) {
  clearTimeout(speaking); // screen readers hear what stays, not every step of a movement
  speaking = setTimeout(() => { $("#spoken").textContent = text; }, 600);
}

const toasts = Object.assign(document.createElement("div"), { id: "toasts" });
function toast(text, kind) {
  ($("dialog[open]") ?? document.body).append(toasts); // all that is outside of an open dialog is dead
  const line = Object.assign(document.createElement("div"), { className: `toast ${kind}`, textContent: text });
  line.setAttribute("role", kind === "alert" ? "alert" : "status");
  if (kind === "alert") {
    const button = Object.assign(document.createElement("button"), { className: "icon", textContent: "×", onclick: () => line.remove() });
    button.setAttribute("aria-label", "Dismiss");
    line.append(button);
  }
  while (toasts.children.length > 2) toasts.firstChild.remove();
  toasts.append(line);
  setTimeout(() => line.remove(), kind === "alert" ? 15000 : 3000 + 70 * text.length); // as long as it takes to read
}
document.addEventListener("close", () => document.body.append(toasts), true);

// ---- controls ----

const inputs = (path) => $$(`[data-path="${CSS.escape(path)}"]`);

// a slider stands at low * (high / low)^t where its scale is logarithmic
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
    move("put", { path, value: read(target) }, []);
  } else if (target.type === "color") move("put", { path, value: target.value }, []);
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
  const button = event.target.closest("[data-do], [data-open], [data-close], [data-copy], [data-copy-link], [data-theme-toggle], [data-tab]");
  if (event.target.tagName === "DIALOG") return event.target.close(); // beside the box
  const file = event.target.closest("a[download]");
  if (file && !file.href.startsWith("blob:")) { event.preventDefault(); take(file.href); }
  if (!button) return;
  const { dataset } = button;
  if (dataset.do && !send(JSON.parse(dataset.do))) toast("The server does not answer", "alert");
  if (dataset.close !== undefined) button.closest("dialog")?.close();
  if (dataset.open) document.getElementById(dataset.open).showModal();
  if (dataset.copy) copy(fetch(dataset.copy).then((answer) => answer.text()));
  if (dataset.copyLink !== undefined) copy(Promise.resolve(location.href));
  if (dataset.themeToggle !== undefined) setTheme(dark() ? "light" : "dark");
  if (dataset.tab) tab(dataset.tab);
});

// a file, or why there is none: a link by itself would save the words as the file
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
    toast("The server does not answer", "alert");
  }
}

// what is copied may still be on its way; browsers let nothing be copied long after a click, but promises
async function copy(text) {
  try {
    const blob = text.then((words) => new Blob([words], { type: "text/plain" }));
    await navigator.clipboard.write([new ClipboardItem({ "text/plain": blob })]);
    toast("Copied", "note");
  } catch {
    toast("The browser does not let the page copy: mark the text, and copy it by hand", "alert");
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
    // what has the form of a seed, or nearly so, the server judges
    if (/^\d{1,4}$|^0x[0-9a-f]*$|^[0-9a-f]{16,}$/i.test(value)) {
      send({ do: "seed", text: value });
      if (seed.test(value)) { event.target.value = ""; search(event.target); }
    } else if (value) found[0]?.click();
  }
});

const dark = () => (document.documentElement.style.colorScheme || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light")) === "dark";
function setTheme(theme) {
  document.documentElement.style.colorScheme = theme;
  try { localStorage.setItem("theme", theme); } catch { /* no storage: it lasts as long as the page */ }
}

// ---- the picture under the pointer ----

const pointers = new Map();
let spread = 0;

// the way of a pointer in parts of the height of the picture; for turning, of its longer side, so that a wide and low
// one does not spin
function parts(event, from, turning) {
  const { width, height } = $("#picture").getBoundingClientRect();
  const all = (turning ? Math.max(width, height) : height) || 1;
  return { x: (event.clientX - from.x) / all, y: (event.clientY - from.y) / all };
}

function hold(event) {
  if (event.button === 1 || !event.target.closest("#view")) return;
  $("#view").classList.add("pointed"); // who points needs no frame around what has the focus
  $("#view").focus({ preventScroll: true });
  $("#view").setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  if (pointers.size === 2) spread = distance();
}
function distance() {
  const [a, b] = [...pointers.values()];
  return Math.hypot(a.x - b.x, a.y - b.y);
}
function drag(event) {
  const from = pointers.get(event.pointerId);
  if (!from) return;
  const pans = pointers.size > 1 || event.shiftKey || event.buttons & 2;
  const by = parts(event, from, !pans);
  pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  if (pointers.size === 2) {
    move("pan", { x: by.x / 2, y: by.y / 2 }, ["x", "y"]);
    const now = distance();
    if (spread > 0 && Math.abs(Math.log(now / spread)) > 0.02) {
      move("zoom", { notches: 8 * Math.log(now / spread) }, ["notches"]);
      spread = now;
    }
  } else if (pointers.size === 1) {
    move(pans ? "pan" : "orbit", by, ["x", "y"]);
  }
}
function release(event) {
  if (!pointers.delete(event.pointerId) || pointers.size) return;
  flush();
  send({ do: "rest" });
}
document.addEventListener("pointerdown", (event) => { hold(event); holdLamp(event); });
document.addEventListener("pointermove", (event) => { drag(event); dragLamp(event); });
document.addEventListener("pointerup", (event) => { release(event); releaseLamp(event); });
document.addEventListener("pointercancel", (event) => { release(event); releaseLamp(event); });
document.addEventListener("contextmenu", (event) => { if (event.target.closest("#view") && event.button === 2) event.preventDefault(); });
document.addEventListener("wheel", (event) => {
  if (!event.target.closest("#view")) return;
  event.preventDefault();
  const notches = -event.deltaY / (event.deltaMode === 1 ? 3 : 100);
  move("zoom", { notches: Math.max(-3, Math.min(3, notches)) }, ["notches"]);
}, { passive: false });

// ---- the spheres of the lights ----

let lamp = null;
function holdLamp(event) {
  const sphere = event.target.closest(".sphere");
  if (!sphere) return;
  event.preventDefault();
  sphere.setPointerCapture(event.pointerId);
  lamp = sphere;
  dragLamp(event);
}
function dragLamp(event) {
  if (!lamp) return;
  const box = lamp.getBoundingClientRect();
  const x = (event.clientX - box.x) / box.width * 2 - 1, y = (event.clientY - box.y) / box.height * 2 - 1;
  move("lamp", { number: Number(lamp.dataset.number), x, y }, []);
}
function releaseLamp() {
  if (!lamp) return;
  lamp = null;
  flush();
  send({ do: "rest" });
}
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

// text is typed there; sliders, choices and colours have arrows and Home of their own, and all that is pushed has Enter
const typed = (element) => element.closest("input:not([type=range], [type=checkbox], [type=radio], [type=color]), textarea, select");
const own = (element, key) => key === "Enter" ? element.closest("button, a, summary, input, label") : key.length > 1 && element.closest("input:not([type=checkbox])");
document.addEventListener("keydown", (event) => {
  $("#view").classList.remove("pointed");
  if (event.isComposing || $("dialog[open]")) return;
  const control = event.ctrlKey || event.metaKey;
  const name = `${control ? "Ctrl+" : ""}${event.shiftKey && (control || event.key.length > 1) ? "Shift+" : ""}${control ? event.key.toLowerCase() : event.key}`;
  const message = keys[name];
  if (!message || event.altKey || typed(event.target)) return;
  if (!control && own(event.target, event.key)) return;
  event.preventDefault();
  if (message.open) document.getElementById(message.open).showModal();
  else send(message);
});

// ---- files and seeds from outside ----

const seed = /^(0x)?[0-9a-f]{64}$/i;

async function upload(files) {
  if (!files.length) return;
  // four bytes of length, that much JSON with names and sizes, and the files one after the other
  const head = new TextEncoder().encode(JSON.stringify(files.map((file) => [file.name, file.size])));
  const length = new DataView(new ArrayBuffer(4));
  length.setUint32(0, head.length);
  const body = new Blob([length, head, ...files]);
  document.body.classList.add("busy");
  try {
    const answer = await fetch(`/upload/${visitor}`, { method: "POST", body });
    if (!answer.ok) toast((await answer.text()).slice(0, 400) || "The file could not be sent", "alert");
  } catch {
    toast("The file could not be sent: the server does not answer, or it is larger than what it takes", "alert");
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

// ---- the visitor's wallets (EIP-6963, or the one of EIP-1193) ----

const wallets = [];
addEventListener("eip6963:announceProvider", ({ detail }) => {
  if (!wallets.some(({ info }) => info.uuid === detail.info.uuid)) wallets.push(detail);
});

function findWallets() {
  dispatchEvent(new Event("eip6963:requestProvider"));
  if (!wallets.length && window.ethereum) wallets.push({ info: { name: "this browser's wallet" }, provider: window.ethereum });
  send({ do: "wallets", names: wallets.map(({ info }) => String(info.name)) });
}

// a page that was away is asked again what it has not answered; the wallet is asked but once
const answers = new Map();
async function askWallet({ id, wallet, method, params }) {
  if (!answers.has(id)) answers.set(id, ask(wallet, method, params));
  send({ do: "answer", id, ...(await answers.get(id)) });
}
async function ask(wallet, method, params) {
  try {
    return { result: (await wallets[wallet].provider.request({ method, params })) ?? null };
  } catch (error) {
    return { error: String(error?.message ?? error), code: error?.data?.originalError?.code ?? error?.code };
  }
}

// ---- beginning ----

export default {
  props: { visitor: String, keys: Object },
  render: () => null,
  mounted() {
    visitor = this.visitor;
    keys = this.keys;
    $$("input[type=range]").forEach(fill);
    connect();
  },
};
