// The display: shows pictures of the SVG exporter, and zooms, pans and measures them without asking the server.
//
// A picture lies in a shadow tree, so that its ids and the page's never meet. The view is its viewBox: what is
// zoomed is drawn anew as geometry, never as pixels. All lengths are millimetres of cloth, y down as SVG has it.
"use strict";
window.studio = (() => {
  const RULER = 22, EDGE = 28, MM = 96 / 25.4;
  const NS = "http://www.w3.org/2000/svg";
  const STYLE = `
    :host { display: block; position: absolute; inset: 0; overflow: hidden; }
    .stage { position: absolute; left: ${RULER}px; top: ${RULER}px; right: 0; bottom: 0; overflow: hidden;
             cursor: grab; touch-action: none; outline: none; }
    .stage:focus-visible { box-shadow: inset 0 0 0 2px var(--accent); }
    .stage.held { cursor: grabbing; }
    .stage > svg { position: absolute; left: 0; top: 0; width: 100%; height: 100%; }
    .over { pointer-events: none; }
    .over .pin { pointer-events: auto; cursor: help; }
    .lines g[data-ink] path, .lines g[data-ink] polygon, .lines g[data-ink] polyline, .lines g[data-ink] rect,
    .lines g[data-ink] circle, .lines g[data-ink] line
      { fill: none !important; stroke: var(--line) !important; stroke-width: 1.1px !important;
        vector-effect: non-scaling-stroke; }
    .lines g[data-cloth] { display: none; }
    .off { display: none; }
    canvas { position: absolute; left: 0; top: 0; }
    .words { position: absolute; left: ${RULER + 14}px; bottom: 14px; max-width: min(460px, calc(100% - ${RULER + 28}px)); margin: 0; display: none;
             padding: 8px 12px; list-style: none; background: var(--panel); border: 1px solid var(--rule); border-left: 4px solid var(--fault);
             border-radius: 8px; box-shadow: 0 4px 16px rgb(10 14 24 / 18%); color: var(--ink); font: 12px/1.4 system-ui, sans-serif; }
    .words.on { display: block; }
    .words li { display: flex; gap: 8px; padding: 2px 0; } .words li::before { content: attr(data-number); flex: none; min-width: 14px; color: var(--fault); font-weight: 600; }
    .over .number { font: 600 11px system-ui, sans-serif; fill: #b3261e; stroke: #fff; stroke-width: 3px; paint-order: stroke; text-anchor: middle; }
    .alone { position: absolute; left: ${RULER + 14}px; bottom: 14px; width: 236px; padding: 8px; display: none; pointer-events: none;
             background: var(--panel); border: 1px solid var(--rule); border-radius: 8px; box-shadow: 0 8px 28px rgb(10 14 24 / 22%);
             color: var(--quiet); font: 12px system-ui, sans-serif; }
    .alone.on { display: block; }
    .alone svg { display: block; width: 100%; height: 236px; border-radius: 4px; margin-bottom: 6px; }
  `;
  const token = { host: null, shown: 0, alone: 0 };
  let shadow, stage, words, aside, art = null, over, rulerX, rulerY;
  let size = [1, 1], centre = [0.5, 0.5], scale = 1, fitted = true, lines = false, hidden = new Set();
  let guides = [], pins = [], showGuides = false, showPins = true, pending = false, screenMm = MM;

  function mount(host) {
    if (token.host === host) return;
    token.host = host;
    shadow = host.shadowRoot || host.attachShadow({ mode: "open" });
    shadow.innerHTML = `<style>${STYLE}</style><canvas class="x"></canvas><canvas class="y"></canvas>
      <div class="stage" tabindex="0" role="img" aria-label="The pattern. Arrow keys move it, plus and minus zoom, 0 fits it."></div>
      <ol class="words" role="status" aria-label="What the certificate finds wrong"></ol>
      <div class="alone" aria-hidden="true"></div>`;
    words = shadow.querySelector(".words");
    aside = shadow.querySelector(".alone");
    stage = shadow.querySelector(".stage");
    [rulerX, rulerY] = shadow.querySelectorAll("canvas");
    over = document.createElementNS(NS, "svg");
    over.setAttribute("class", "over");
    stage.append(over);
    screenMm = Number(localStorage.getItem("batik-px-per-mm")) || MM;
    new ResizeObserver(() => (fitted ? fit() : draw())).observe(stage);
    new MutationObserver(draw).observe(document.body, { attributes: true, attributeFilter: ["class"] });
    stage.addEventListener("wheel", onWheel, { passive: false });
    stage.addEventListener("pointerdown", onDown);
    stage.addEventListener("dblclick", fit);
    stage.addEventListener("keydown", onKey);
    if (art) stage.prepend(art);
  }

  // Bring a new picture in, and tell what is known of it in the line below.
  function show(text, head) {
    if (head.part === "verdict") { verdict(head.verdict, head.passed); return setPins(head.pins); }
    const parsed = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
    if (parsed.nodeName !== "svg") return;
    if (head.part === "motif") return showAlone(parsed, head.name);
    if (!head.sketch) hideAlone();
    for (const each of parsed.querySelectorAll("metadata, script, foreignObject")) each.remove();
    const made = document.importNode(parsed, true);
    const box = (made.getAttribute("viewBox") || "0 0 100 100").split(/[\s,]+/).map(Number);
    for (const each of made.querySelectorAll("g")) {
      const label = each.getAttribute("inkscape:label");
      if (label === null) continue;
      if (label.startsWith("%")) each.dataset.cloth = label; else each.dataset.ink = each.id;
    }
    for (const name of ["width", "height"]) made.removeAttribute(name);
    made.setAttribute("preserveAspectRatio", "none");
    made.setAttribute("aria-hidden", "true");
    if (art) art.replaceWith(made); else stage.prepend(made);
    art = made;
    const fresh = box[2] !== size[0] || box[3] !== size[1];
    size = [box[2], box[3]];
    guides = head.guides || [];
    setPins(head.pins || []);
    for (const [name, words] of Object.entries(head.words)) say(`said-${name}`, words);
    if (head.verdict) verdict(head.verdict, head.passed);
    else if (!head.certified) verdict("", true);
    applyLayers();
    if (fresh || fitted) fit(); else draw();
    requestAnimationFrame(() => { token.shown++; token.at = performance.now(); token.first ??= token.at; });
  }

  // The motif whose slider moves, by itself: it is there while the whole is still being drawn.
  function showAlone(svg, name) {
    for (const each of svg.querySelectorAll("metadata, script, foreignObject")) each.remove();
    const made = document.importNode(svg, true);
    for (const each of ["width", "height"]) made.removeAttribute(each);
    aside.replaceChildren(made, Object.assign(document.createElement("span"), { textContent: `${name}, alone` }));
    aside.classList.add("on");
    requestAnimationFrame(() => { token.alone++; token.aloneAt = performance.now(); });
  }
  function hideAlone() { aside.classList.remove("on"); }
  // What a hand has let go of need not be seen alone any more, even where no picture follows.
  function letGo() { setTimeout(hideAlone, 2500); }

  function verdict(words, good) {
    say("said-verdict", words);
    for (const each of document.getElementsByClassName("said-verdict")) {
      each.classList.toggle("good", good);
      each.classList.toggle("bad", !good);
    }
  }

  // Words of the line below are the display's own: the page's elements are not asked.
  function say(name, words) {
    for (const each of document.getElementsByClassName(name)) if (each.textContent !== words) each.textContent = words;
  }

  // Pointers are numbered in the picture; what each says stands below it.
  const MOST_SAID = 5;
  function setPins(found) {
    pins = found;
    const rows = pins.slice(0, MOST_SAID).map((each, at) => [at + 1, each.text]);
    if (pins.length > MOST_SAID) rows.push(["", `and ${pins.length - MOST_SAID} more: each says what it is when pointed at`]);
    words.replaceChildren(...rows.map(([number, text]) => {
      const row = Object.assign(document.createElement("li"), { textContent: text });
      row.dataset.number = number;
      return row;
    }));
    draw();
  }

  function applyLayers() {
    if (!art) return;
    art.classList.toggle("lines", lines);
    for (const each of art.querySelectorAll("g[data-ink], g[data-cloth]"))
      each.classList.toggle("off", hidden.has(each.id));
  }

  function fit() {
    const w = stage.clientWidth - 2 * EDGE, h = stage.clientHeight - 2 * EDGE;
    if (w < 10 || h < 10) return;
    scale = Math.min(w / size[0], h / size[1]);
    centre = [size[0] / 2, size[1] / 2];
    fitted = true;
    draw();
  }

  function zoom(factor, at) {
    const [px, py] = at || [stage.clientWidth / 2, stage.clientHeight / 2];
    const mm = toMm(px, py);
    scale = Math.min(Math.max(scale * factor, 0.005), 4000);
    centre = [mm[0] - (px - stage.clientWidth / 2) / scale, mm[1] - (py - stage.clientHeight / 2) / scale];
    fitted = false;
    draw();
  }

  function actual() { zoom(screenMm / scale); }
  const toMm = (px, py) => [centre[0] + (px - stage.clientWidth / 2) / scale, centre[1] + (py - stage.clientHeight / 2) / scale];

  function pan(dx, dy) { centre = [centre[0] - dx / scale, centre[1] - dy / scale]; fitted = false; draw(); }

  function onWheel(event) {
    event.preventDefault();
    const box = stage.getBoundingClientRect();
    if (event.shiftKey) return pan(-event.deltaY, 0);
    zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), [event.clientX - box.left, event.clientY - box.top]);
  }

  function onDown(event) {
    if (event.button > 1) return;
    let [x, y] = [event.clientX, event.clientY];
    stage.setPointerCapture(event.pointerId);
    stage.classList.add("held");
    const move = (e) => { pan(e.clientX - x, e.clientY - y); [x, y] = [e.clientX, e.clientY]; };
    const up = () => {
      stage.classList.remove("held");
      stage.removeEventListener("pointermove", move);
      stage.removeEventListener("pointerup", up);
      stage.removeEventListener("pointercancel", up);
    };
    stage.addEventListener("pointermove", move);
    stage.addEventListener("pointerup", up);
    stage.addEventListener("pointercancel", up);
  }

  function onKey(event) {
    const step = 40, keys = {
      ArrowLeft: () => pan(step, 0), ArrowRight: () => pan(-step, 0), ArrowUp: () => pan(0, step),
      ArrowDown: () => pan(0, -step), "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(0.8), "0": fit,
      "1": actual,
    };
    if (event.ctrlKey || event.metaKey || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  }

  function draw() {
    if (pending) return;
    pending = true;
    requestAnimationFrame(() => { pending = false; if (stage) paint(); });
  }

  function paint() {
    const w = stage.clientWidth, h = stage.clientHeight;
    const box = `${centre[0] - w / 2 / scale} ${centre[1] - h / 2 / scale} ${w / scale} ${h / scale}`;
    if (art) art.setAttribute("viewBox", box);
    over.setAttribute("viewBox", `0 0 ${Math.max(w, 1)} ${Math.max(h, 1)}`);
    over.replaceChildren(...marks(w, h));
    ruler(rulerX, w, 0);
    ruler(rulerY, h, 1);
    say("zoom", `${((100 * scale) / screenMm).toFixed(0)}%`);
  }

  function marks(w, h) {
    const px = (x, y) => [w / 2 + (x - centre[0]) * scale, h / 2 + (y - centre[1]) * scale];
    const made = [];
    const add = (name, attributes, text) => {
      const node = document.createElementNS(NS, name);
      for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
      if (text) node.append(Object.assign(document.createElementNS(NS, "title"), { textContent: text }));
      made.push(node);
      return node;
    };
    for (const line of showGuides ? guides : []) {
      const points = line.map(([x, y]) => px(x, y).map((v) => v.toFixed(1)).join(" ")).join(" ");
      add("polyline", { points, fill: "none", stroke: "#fff", "stroke-width": 2.5, opacity: 0.55 });
      add("polyline", { points, fill: "none", stroke: "#c2185b", "stroke-width": 1.25, "stroke-dasharray": "6 4" });
    }
    words.classList.toggle("on", showPins && pins.length > 0);
    for (const [at, pin] of (showPins ? pins : []).entries()) {
      const [x, y] = px(pin.x, pin.y);
      if (at < MOST_SAID) add("text", { class: "number", x, y: y - 14 }).textContent = at + 1;
      add("circle", { cx: x, cy: y, r: 9, fill: "none", stroke: "#fff", "stroke-width": 4 });
      add("circle", { class: "pin", cx: x, cy: y, r: 9, fill: "transparent", stroke: "#d32f2f", "stroke-width": 2 }, pin.text);
    }
    return made;
  }

  // A ruler with marks on round numbers of millimetres.
  function ruler(canvas, length, axis) {
    const dpr = window.devicePixelRatio || 1, [w, h] = axis ? [RULER, length] : [length, RULER];
    canvas.style.cssText = axis ? `top:${RULER}px;left:0;width:${w}px;height:${h}px` : `left:${RULER}px;top:0;width:${w}px;height:${h}px`;
    canvas.width = Math.max(w * dpr, 1); canvas.height = Math.max(h * dpr, 1);
    const pen = canvas.getContext("2d"), look = getComputedStyle(token.host);
    pen.scale(dpr, dpr);
    pen.fillStyle = look.getPropertyValue("--panel"); pen.fillRect(0, 0, w, h);
    pen.strokeStyle = pen.fillStyle = look.getPropertyValue("--quiet");
    pen.font = "10px system-ui, sans-serif"; pen.lineWidth = 1;
    const rough = 70 / scale, power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((each) => each * power >= rough);
    const parts = step / power === 2 ? 4 : 5, first = centre[axis] - length / 2 / scale;
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    pen.beginPath();
    for (let n = Math.floor(first / step) * parts; ; n++) {
      const mm = (n * step) / parts, at = Math.round((mm - first) * scale) + 0.5;
      if (at > length) break;
      const long = n % parts === 0, tall = long ? RULER : 5;
      if (axis) { pen.moveTo(RULER - tall, at); pen.lineTo(RULER, at); } else { pen.moveTo(at, RULER - tall); pen.lineTo(at, RULER); }
      if (!long) continue;
      const text = mm.toFixed(digits).replace("-0", "0");
      if (axis) { pen.save(); pen.translate(11, at + 3); pen.rotate(-Math.PI / 2); pen.textAlign = "right"; pen.fillText(text, 0, 0); pen.restore(); }
      else pen.fillText(text, at + 3, 10);
    }
    pen.stroke();
  }

  // Files dropped anywhere on the page, or chosen by the button, go to the server as they are.
  const LARGEST = 20e6;
  async function send(file) {
    if (file.size > LARGEST) return window.emitEvent("studio-refused", `${file.name} has ${(file.size / 1e6).toFixed(0)} MB: at most ${LARGEST / 1e6} MB are taken`);
    document.body.dataset.reading = `Reading ${file.name} …`;
    const answer = await fetch(`/studio/drop?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file,
      headers: { "content-type": "application/octet-stream" } }).catch(() => null);
    delete document.body.dataset.reading;
    const said = answer ? await answer.text() : `${file.name} could not be sent`;
    window.emitEvent(answer && answer.ok ? "studio-dropped" : "studio-refused", said);
  }
  function choose() {
    const input = Object.assign(document.createElement("input"), { type: "file", accept: ".toml,.svg,.pdf,.dxf,.hpgl,.gcode,.png" });
    input.onchange = () => input.files[0] && send(input.files[0]);
    input.click();
  }
  function acceptDrops() {
    let depth = 0;
    const holds = (event) => event.dataTransfer && [...event.dataTransfer.types].includes("Files");
    document.addEventListener("dragenter", (e) => { if (holds(e)) { depth++; document.body.classList.add("dropping"); e.preventDefault(); } });
    document.addEventListener("dragover", (e) => { if (holds(e)) e.preventDefault(); });
    document.addEventListener("dragleave", (e) => { if (holds(e) && --depth <= 0) { depth = 0; document.body.classList.remove("dropping"); } });
    document.addEventListener("drop", (e) => {
      if (!holds(e)) return;
      e.preventDefault();
      depth = 0;
      document.body.classList.remove("dropping");
      for (const file of e.dataTransfer.files) send(file);
    });
  }
  acceptDrops();

  // Keys that mean the same wherever one is; those that edit words stay with the words that are edited.
  const KEYS = { z: "undo", y: "redo", "Z": "redo", s: "save", "S": "save-as", e: "export", o: "open", "E": "explore" };
  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const name = KEYS[event.shiftKey ? event.key.toUpperCase() : event.key];
    const editing = event.target.closest && event.target.closest("input, textarea, [contenteditable=true]");
    if (!name || (editing && (name === "undo" || name === "redo"))) return;
    event.preventDefault();
    if (name === "open") choose(); else window.emitEvent("studio-key", name);
  });
  document.addEventListener("paste", (event) => {
    if (event.target.closest && event.target.closest("input, textarea, [contenteditable=true]")) return;
    const text = event.clipboardData.getData("text/plain");
    if (text) window.emitEvent("studio-pasted", text);
  });

  // Quasar's sliders say what they are on their root, and take the focus on a box inside it: who is read the page
  // aloud would land on nothing. The box says the same.
  function nameSlider(event) {
    const box = event.target, root = box.parentElement;
    if (!box.classList || !box.classList.contains("q-slider__track-container") || !root) return;
    requestAnimationFrame(() => {
      for (const name of ["role", "aria-label", "aria-valuemin", "aria-valuemax", "aria-valuenow"])
        if (root.hasAttribute(name)) box.setAttribute(name, root.getAttribute(name));
    });
  }
  for (const name of ["focusin", "keydown", "keyup"]) document.addEventListener(name, nameSlider);

  return {
    mount, show, letGo, fit, actual, zoom: (factor) => zoom(factor), choose, state: token,
    lines: (on) => { lines = on; applyLayers(); },
    layer: (id, on) => { on ? hidden.delete(id) : hidden.add(id); applyLayers(); },
    guides: (on) => { showGuides = on; draw(); },
    pins: (on) => { showPins = on; draw(); },
    calibrate: (pxPerMm) => { screenMm = pxPerMm; localStorage.setItem("batik-px-per-mm", pxPerMm); draw(); },
    view: () => ({ scale, centre, size }),
  };
})();
