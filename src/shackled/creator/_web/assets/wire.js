// The WebSocket to the server. Messages are described in live.py.

let socket = null, pause = 250;

// receive(message) gets parsed messages, picture(data) gets pictures
export function connect(visitor, receive, picture) {
  const scheme = location.protocol === "https:" ? "wss:" : "ws:";
  const query = new URLSearchParams({ p: new URLSearchParams(location.search).get("p") ?? "", visitor: visitor() });
  socket = new WebSocket(`${scheme}//${location.host}/live?${query}`);
  socket.binaryType = "arraybuffer";
  socket.onopen = () => { pause = 250; document.body.classList.remove("offline"); };
  socket.onmessage = ({ data }) => typeof data === "string" ? receive(JSON.parse(data)) : picture(data);
  socket.onclose = ({ code }) => {
    document.body.classList.add("offline");
    if (code === 1013) pause = 15000; // there are too many visitors
    setTimeout(connect, pause, visitor, receive, picture);
    pause = Math.min(2 * pause, 4000);
  };
}

// whether the message was sent
export function send(message) {
  const open = socket?.readyState === WebSocket.OPEN;
  if (open) socket.send(JSON.stringify(message));
  return open;
}

// movements are added up and sent once per animation frame; add: the keys whose numbers are added
let moved = null;
export function move(name, more, add = []) {
  if (moved && (moved.do !== name || moved.number !== more.number || moved.path !== more.path)) flush();
  if (!moved) {
    moved = { do: name, ...more };
    requestAnimationFrame(flush);
  } else {
    for (const key of Object.keys(more)) moved[key] = add.includes(key) ? moved[key] + more[key] : more[key];
  }
}

export function flush() {
  if (moved) send(moved);
  moved = null;
}
