"use strict";
// The numbers beside the object: the outcome, then one panel per question.

const wrenches = data.phi.map((_, wrench) => wrench).sort((a, b) => data.phi[b] - data.phi[a] || a - b);
const measured = data.validation;
/** The choices that the search is about. */
const choices = `${data.search.fingers} of the ${count(data.search.candidates)} candidates `
  + `(${count(data.search.subsets)} subsets)`;
const triple = (values) => `(${values.map((x) => number(x, 3)).join(", ")})`;
const loadWords = (wrench) => `force ${triple(data.wrenches[wrench].slice(0, 3))} N · moment `
  + `${triple(data.wrenches[wrench].slice(3))} N m`;
const unequal = data.contacts.some((contact) => contact.strength !== 1); // then the fingers' strengths are shown
const soft = data.contacts.some((contact) => contact.torsion > 0); // then their torques are shown
const title = () => el("h1", {}, data.object.body, el("small", {}, `${data.file} · ${data.object.file}`));

function headline() {
  const share = 100 * data.lower_bound / data.rho, scale = 0.92;
  return [
    title(),
    el("p", { class: "rho" }, `${number(data.rho, 4)} N`),
    el("p", { class: "muted" }, "the force that every finger must be able to push with"
      + (unequal ? ", times its strength" : "")
      + `; the largest normal force of a finger, the grip, is ${number(data.grip, 4)} N`),
    el("div", { class: "track", role: "img", "aria-label": "proven interval of the smallest possible force" },
      el("span", { class: "proven", style: `width:${scale * share}%` }),
      el("span", { class: "open", style: `left:${scale * share}%;width:${scale * (100 - share)}%` }),
      el("span", { class: "tick", style: `left:${100 * scale}%` })),
    el("div", { class: "ends" }, el("span", {}, "0"),
      el("span", {}, `proven ≥ ${number(data.lower_bound)} · rho = ${number(data.rho)} N`)),
    el("p", {}, `No ${choices} need less than `
      + `${number(data.lower_bound)} N: ${data.gap === null ? "nothing is proven yet"
        : `rho is within ${percent(data.gap, 3)} of the best`} (${data.status}).`),
  ];
}

const ENDS = {
  "time limit": "The search was stopped at its time limit before it had found one.",
  interrupted: "The search was stopped by its user before it had found one.",
  unresolved: "Every choice was examined, but the solver is not accurate enough to say whether one of them holds.",
};

/** The outcome of a search without a grasp: proven impossible, or open. */
function absence() {
  const impossible = data.status === "infeasible", bound = `${number(data.lower_bound, 4)} N`;
  const known = data.lower_bound > 0 ? `Proven so far: no ${choices} need less than ${bound}.`
    : `Nothing is proven yet about the ${choices}.`;
  return [title(), el("p", { class: "rho none" }, impossible ? "No grasp exists" : "No grasp was found"),
    ...(impossible ? [el("p", { class: "muted" }, `with ${data.search.fingers} fingers on these candidates; proven`),
      el("p", {}, `No ${choices} resist “${data.task}” with less than ${bound} per finger, which is 10,000 times `
        + "its largest wrench."), ...proof()]
      : [el("p", { class: "muted" }, `but one may exist (${data.status})`), el("p", {}, ENDS[data.status] ?? ""),
        el("p", {}, known)])];
}

/** What proves that there is no grasp, in paragraphs. */
function proof() {
  const { cuts, hopeless_wrench: wrench, reasons, remedies } = data.proof;
  const helping = remedies.map((words) => el("p", {}, `May help: ${words}.`));
  if (wrench !== null) {
    return [el("p", {}, `One direction proves it: no candidate can push the object along it, and wrench ${wrench} of `
      + "the task asks for that. Purple in the picture is this load, which no number of fingers on these candidates can "
      + "balance:"), el("p", { id: "load", class: "muted" }, loadWords(wrench)), ...helping];
  }
  const certified = cuts === 0 ? [] : [el("p", {}, "The certificate beside the file proves it with "
    + `${count(cuts)} cuts; grasp-verify checks it without a solver.`)];
  return [...reasons.map((words) => el("p", {}, `Because ${words}.`)), ...certified, ...helping];
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

/** Of one finger under one wrench: its force, its torque where fingers twist, and the share of friction they use. */
function fingerRow(wrench, finger) {
  const contact = data.contacts[finger], force = data.forces[wrench][finger], color = colorOf(finger);
  const normal = dot(force, contact.normal), rubbing = length(plus(force, contact.normal, -normal));
  const torque = data.torques[wrench][finger], twist = torque === 0 ? 0 : torque / contact.torsion;
  const used = normal > 1e-9 * data.rho ? Math.hypot(rubbing / contact.friction, twist) / normal : 0;
  const cap = contact.strength * data.rho;
  const row = [badge(finger), metered(length(force) / cap, color, `${number(length(force), 4)} N`),
    ...(soft ? [number(1000 * torque, 3)] : []), metered(used, color, percent(used, 0))];
  if (measured && measured.vertices.length) {
    const seen = measured.vertices[wrench].fingers[finger];
    row.push(`${number(seen.predicted_force, 4)} N`, `${number(seen.measured_force, 4)} N`);
  }
  return row;
}

function show(position) {
  const wrench = wrenches[position];
  document.body.dataset.wrench = wrench;
  scene.show(wrench);
  drawBars(position);
  const rank = position === 0 ? "critical: it decides rho" : `number ${position + 1} by force needed`;
  document.getElementById("chosen").replaceChildren(el("b", {}, `wrench ${wrench}`), el("span", {}, rank),
    el("span", {}, `φ = ${number(data.phi[wrench])} N`));
  document.getElementById("load").textContent = loadWords(wrench);
  const heads = ["", "planned force", ...(soft ? ["torque [N\u00a0mm]"] : []), "friction used"];
  if (measured && measured.vertices.length) heads.push("commanded", "in MuJoCo");
  document.getElementById("fingers").replaceChildren(
    table(heads, data.contacts.map((_, finger) => fingerRow(wrench, finger))));
}

/** What the columns mean where fingers twist. */
function twisting() {
  if (!soft) return [];
  return [el("p", { class: "muted" }, "Torques τ are about the inward normals. Rubbing and twisting share one cone: the "
    + "friction used is √((f_t / μ)² + (τ / γ)²) / f_n, of the tangential force f_t and the normal force f_n.")];
}

function contactPanel() {
  const heads = ["", "x, y, z [mm]", "friction", ...(soft ? ["torsion γ [mm]"] : []), ...(unequal ? ["strength"] : []), "on"];
  return section("Contacts", table(heads, data.contacts.map((contact, i) => [badge(i),
    contact.position.map((x) => (1000 * x).toFixed(3)).join(", "), number(contact.friction, 3),
    ...(soft ? [number(1000 * contact.torsion, 3)] : []), ...(unequal ? [number(contact.strength, 3)] : []), contact.geom])));
}

function validationPanel() {
  if (!measured) {
    return section("Measured in MuJoCo", el("p", {}, "Not yet. Beside this grasp no validation was found; make one with:"),
      shell(data.commands.validate));
  }
  const held = measured.vertices.filter((vertex) => vertex.held).length;
  const limited = measured.friction_limited.length;
  const limit = !limited ? [] : [`${limited} of the wrenches lie on the friction limit: whatever the force, they need `
    + `more than ${number(100 * measured.protocol.friction_margin)} % of the planned friction`];
  const r0 = ["Slips are relative to R0, the largest distance of a contact from the reference point"];
  const words = [`${held} of ${measured.vertices.length} wrenches held with the finger force capped at `
    + `${number(measured.protocol.hold_factor)} rho`, ...limit, ...measured.reasons, ...r0].join(". ");
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
  const forces = measured.vertices.flatMap((vertex) => vertex.fingers.map((finger, i) =>
    [finger.predicted_force, finger.measured_force, i]));
  const most = 1.05 * Math.max(data.rho, ...forces.flatMap(([a, b]) => [a, b]));
  const plot = new Plot("scatter", [most, most], ["commanded fingertip force [N]", "measured in MuJoCo [N]"]);
  const { x, y } = plot;
  plot.draw("line", { x1: x(0), y1: y(0), x2: x(most), y2: y(most), stroke: "#94a3b8", "stroke-dasharray": "4 4" });
  for (const [a, b, i] of forces) {
    plot.draw("circle", { cx: x(a), cy: y(b), r: 2.6, fill: colorOf(i), "fill-opacity": 0.6 });
  }
  return plot.element;
}

function legend() {
  const box = document.getElementById("legend"), purple = el("b", { style: `color:${LOAD}` }, "Purple");
  box.append(el("b", {}, `${data.object.extent.map((x) => number(1000 * x, 3)).join(" × ")} mm, `
    + `${number(data.object.mass, 3)} kg. `));
  if (found) {
    box.append("Arrows are the fingers' forces; a full one is rho. The cone around each holds all forces that do not "
      + "slip. ", ...(soft ? ["Arcs are the fingers' torques about their normals; a full one is γ rho, the most that a "
      + "finger pressing with rho can twist. "] : []), purple, " is the load they balance.");
  } else {
    box.append(`Dots are the ${count(data.search.candidates)} places where a finger might go. `);
    if (data.proof.hopeless_wrench !== null) box.append(purple, " is a load that none of them can balance.");
  }
  if (!scene.gl) box.append(" This browser offers no WebGL, so the object cannot be shown; the numbers stand.");
}

/** Shows or hides the candidates; without a grasp they are what there is to see. */
function candidateToggle() {
  const box = document.querySelector("#toggle input");
  box.checked = !found;
  const follow = () => { scene.dotted = box.checked; scene.draw(); };
  box.addEventListener("change", follow);
  follow();
}

document.getElementById("panels").append(...(found ? [...headline(), ...wrenchPanel(),
  ...section("Fingers under this wrench", el("div", { id: "fingers" }), ...twisting()), ...contactPanel(), ...validationPanel()]
  : absence()), ...searchPanel(), ...reproducePanel(), ...checkPanel());
const scene = new Scene(document.getElementById("scene"));
legend();
candidateToggle();
if (found) {
  show(0);
  new ResizeObserver(() => drawBars(Number(document.getElementById("slider").value)))
    .observe(document.getElementById("bars"));
} else if (data.proof.hopeless_wrench !== null) scene.show(data.proof.hopeless_wrench);
