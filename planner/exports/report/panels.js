"use strict";
// The numbers beside the object. All text from files goes through textContent or setAttribute, never through HTML.

const wrenches = data.phi.map((_, wrench) => wrench).sort((a, b) => data.phi[b] - data.phi[a] || a - b);
const measured = data.validation;
const number = (value, digits = 6) => (value === null || value === undefined ? "–" : Number(value).toPrecision(digits)
  .replace(/(\.\d*?)0+(?=e|$)/, "$1").replace(/\.(?=e|$)/, ""));
const percent = (value, digits = 1) => `${(100 * value).toFixed(digits)} %`;
const svg = (name) => document.createElementNS("http://www.w3.org/2000/svg", name);

/** An element with attributes and children; strings become text. */
function el(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    key === "style" ? (element.style.cssText = value) : element.setAttribute(key, value);
  }
  element.append(...children);
  return element;
}

const meter = (share, color) => el("span", { class: "meter" },
  el("i", { style: `width:${Math.min(100, 100 * share)}%;background:${color}` }));
const metered = (share, color, text) => el("td", {}, meter(share, color), el("span", { class: "value" }, text));
const badge = (finger) => el("span", { class: "dot", style: `background:${colorOf(finger)}` }, String(finger + 1));
const list = (entries) => el("dl", {}, ...Object.entries(entries).flatMap(([key, value]) =>
  [el("dt", {}, key.replaceAll("_", " ")), el("dd", {}, String(value))]));
const section = (title, ...children) => [el("h2", {}, title), ...children];
const table = (heads, rows) => el("table", {}, el("tr", {}, ...heads.map((head) => el("th", {}, head))),
  ...rows.map((cells) => el("tr", {}, ...cells.map((cell) => cell instanceof Node && cell.tagName === "TD"
    ? cell : el("td", {}, cell)))));

function headline() {
  const { fingers, candidates, subsets } = data.search;
  const share = 100 * data.lower_bound / data.rho, scale = 0.92;
  return [
    el("h1", {}, data.object.body, el("small", {}, `${data.file} · ${data.object.file}`)),
    el("p", { class: "rho" }, `${number(data.rho, 4)} N`),
    el("p", { class: "muted" }, "the force that every finger must be able to push with"),
    el("div", { class: "track", role: "img", "aria-label": "proven interval of the smallest possible force" },
      el("span", { class: "proven", style: `width:${scale * share}%` }),
      el("span", { class: "open", style: `left:${scale * share}%;width:${scale * (100 - share)}%` }),
      el("span", { class: "tick", style: `left:${100 * scale}%` })),
    el("div", { class: "ends" }, el("span", {}, "0"),
      el("span", {}, `proven ≥ ${number(data.lower_bound)} · rho = ${number(data.rho)} N`)),
    el("p", {}, `No ${fingers} of the ${candidates} candidates (${subsets.toLocaleString("en")} subsets) need less than `
      + `${number(data.lower_bound)} N: ${data.gap === null ? "nothing is proven yet"
        : `rho is within ${percent(data.gap, 3)} of the best`} (${data.status}).`),
  ];
}

function wrenchPanel() {
  const slider = el("input", { type: "range", id: "slider", min: 0, max: wrenches.length - 1, value: 0,
    "aria-label": "wrench of the task, hardest first" });
  slider.addEventListener("input", () => show(Number(slider.value)));
  const bars = el("canvas", { id: "bars" });
  bars.addEventListener("click", (event) => {
    slider.value = Math.floor(event.offsetX / bars.clientWidth * wrenches.length);
    show(Number(slider.value));
  });
  return section(`Force needed for each of the ${wrenches.length} wrenches of “${data.task}”, hardest first`,
    bars, slider, el("div", { id: "chosen" }), el("p", { id: "load", class: "muted" }));
}

function drawBars(position) {
  const canvas = document.getElementById("bars"), density = window.devicePixelRatio || 1;
  const { clientWidth: width, clientHeight: height } = canvas;
  [canvas.width, canvas.height] = [width * density, height * density];
  const pen = canvas.getContext("2d"), step = width / wrenches.length, gap = step > 4 ? 1 : 0;
  pen.scale(density, density);
  wrenches.forEach((wrench, k) => {
    const high = (height - 4) * data.phi[wrench] / data.rho;
    pen.fillStyle = k === position ? LOAD : "#b6c2d1";
    pen.fillRect(k * step, height - high, Math.max(step - gap, k === position ? 2 : 0.5), high);
  });
  pen.fillStyle = "#1b2733";
  pen.fillRect(0, 3, width, 1);
  pen.font = "11px system-ui, sans-serif";
  pen.textAlign = "right";
  pen.fillText("rho", width, 15);
}

/** Of one finger under one wrench: its force, and what share of the friction it uses. */
function fingerRow(wrench, finger) {
  const contact = data.contacts[finger], force = data.forces[wrench][finger], color = colorOf(finger);
  const normal = dot(force, contact.normal), along = length(plus(force, contact.normal, -normal));
  const used = normal > 1e-9 * data.rho ? along / (contact.friction * normal) : 0;
  const row = [badge(finger), metered(length(force) / data.rho, color, `${number(length(force), 4)} N`),
    metered(used, color, percent(used, 0))];
  if (measured && measured.vertices.length) {
    const seen = measured.vertices[wrench].fingers[finger];
    row.push(`${number(seen.predicted_force, 4)} N`, `${number(seen.measured_force, 4)} N`);
  }
  return row;
}

function show(position) {
  const wrench = wrenches[position], load = data.wrenches[wrench].map((x) => number(x, 3));
  document.body.dataset.wrench = wrench;
  scene.show(wrench);
  drawBars(position);
  const rank = position === 0 ? "critical: it decides rho" : `number ${position + 1} by force needed`;
  document.getElementById("chosen").replaceChildren(el("b", {}, `wrench ${wrench}`), el("span", {}, rank),
    el("span", {}, `φ = ${number(data.phi[wrench])} N`));
  document.getElementById("load").textContent =
    `force (${load.slice(0, 3).join(", ")}) N · moment (${load.slice(3).join(", ")}) N m`;
  const heads = ["", "planned force", "friction used"];
  if (measured && measured.vertices.length) heads.push("commanded", "in MuJoCo");
  document.getElementById("fingers").replaceChildren(
    table(heads, data.contacts.map((_, finger) => fingerRow(wrench, finger))));
}

const contactPanel = () => section("Contacts", table(["", "x, y, z [mm]", "friction", "on"],
  data.contacts.map((contact, i) => [badge(i), contact.position.map((x) => (1000 * x).toFixed(2)).join(", "),
    number(contact.friction, 3), contact.geom])));

function validationPanel() {
  if (!measured) {
    return section("Measured in MuJoCo", el("p", {}, "Not yet. Beside this grasp no validation was found; make one with:"),
      el("pre", {}, data.commands.validate));
  }
  const held = measured.vertices.filter((vertex) => vertex.held).length;
  const words = [`${held} of ${measured.vertices.length} wrenches held with the finger force capped at `
    + `${number(measured.protocol.hold_factor)} rho`, ...measured.reasons].join(". ");
  const rows = measured.controls.map((control) => [el("td", { class: "words" }, control.change),
    el("td", { class: control.behaved ? "ok" : "wrong" }, !control.outcomes.length ? "not possible"
      : control.behaved ? "as predicted" : "against prediction")]);
  const critical = measured.critical_force ? [el("p", {}, `Measured rho between ${number(measured.critical_force.lower)} `
    + `and ${number(measured.critical_force.upper)} N; ratio to the prediction ${number(measured.critical_force.ratio, 5)}.`)]
    : [];
  return section("Measured in MuJoCo",
    el("p", {}, el("span", { class: measured.verdict === "pass" ? "verdict pass" : "verdict" }, measured.verdict),
      `${words}.`), ...critical, scatter(), table(["control", "outcome"], rows));
}

/** Commanded against measured force of every finger under every wrench. */
function scatter() {
  const [wide, high, left, low] = [428, 220, 44, 30];
  const plot = svg("svg");
  plot.id = "scatter";
  plot.setAttribute("viewBox", `0 0 ${wide} ${high}`);
  const draw = (name, attributes, text) => {
    const shape = plot.appendChild(svg(name));
    Object.entries(attributes).forEach(([key, value]) => shape.setAttribute(key, value));
    if (text) shape.textContent = text;
  };
  const forces = measured.vertices.flatMap((vertex) => vertex.fingers.map((finger, i) =>
    [finger.predicted_force, finger.measured_force, i]));
  const most = 1.05 * Math.max(data.rho, ...forces.flatMap(([a, b]) => [a, b]));
  const x = (value) => left + (wide - left - 8) * value / most, y = (value) => high - low - (high - low - 8) * value / most;
  draw("path", { d: `M${left} 8V${high - low}H${wide - 8}`, fill: "none", stroke: "#cbd5e1" });
  draw("line", { x1: x(0), y1: y(0), x2: x(most), y2: y(most), stroke: "#94a3b8", "stroke-dasharray": "4 4" });
  forces.forEach(([a, b, i]) => draw("circle", { cx: x(a), cy: y(b), r: 2.6, fill: colorOf(i), "fill-opacity": 0.6 }));
  const words = { "font-size": 11, fill: "#64748b" };
  draw("text", { x: wide - 8, y: high - 16, "text-anchor": "end", ...words }, `${number(most, 3)} N`);
  draw("text", { x: (left + wide) / 2, y: high - 4, "text-anchor": "middle", ...words }, "commanded fingertip force");
  draw("text", { x: 14, y: (high - low) / 2, "text-anchor": "middle", ...words,
    transform: `rotate(-90 14 ${(high - low) / 2})` }, "measured in MuJoCo");
  return plot;
}

const searchPanel = () => section("How it was found", list({ ...data.search,
  subsets: data.search.subsets.toLocaleString("en"), seconds: number(data.search.seconds, 3) }));

function reproducePanel() {
  const versions = Object.entries(data.packages).map(([name, version]) => `${name} ${version}`).join(" · ");
  return section("Check it yourself",
    el("p", { class: "muted" }, "Every claim about the forces and the bound, with none of the code that found them:"),
    el("pre", {}, data.commands.verify),
    el("p", { class: "muted" }, "The measurement in MuJoCo:"), el("pre", {}, data.commands.validate),
    el("p", { class: "muted" }, "This page:"), el("pre", {}, data.commands.report),
    el("p", { class: "muted" }, versions), el("p", { class: "muted" }, `object sha256 ${data.object.sha256}`));
}

function legend() {
  const box = document.getElementById("legend");
  box.append(el("b", {}, `${data.object.extent.map((x) => number(1000 * x, 3)).join(" × ")} mm, `
    + `${number(data.object.mass, 3)} kg. `), "Arrows are the fingers' forces; a full one is rho. The cone around each "
    + "holds all forces that do not slip. ", el("b", { style: `color:${LOAD}` }, "Purple"), " is the load they balance.");
  if (!scene.gl) box.append(" This browser offers no WebGL, so the object cannot be shown; the numbers stand.");
}

document.getElementById("panels").append(...headline(), ...wrenchPanel(), ...section("Fingers under this wrench",
  el("div", { id: "fingers" })), ...contactPanel(), ...validationPanel(), ...searchPanel(), ...reproducePanel());
const scene = new Scene(document.getElementById("scene"));
legend();
show(0);
new ResizeObserver(() => drawBars(Number(document.getElementById("slider").value)))
  .observe(document.getElementById("bars"));
