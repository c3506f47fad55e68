"use strict";
// How the result was found, how to make it again, and how to check it.

const trace = data.search.trace;
const SHORT = 10; // lines of a search log that are shown unfolded

/** Steps through the points, each value kept until the next is known, and the last one until `end`. */
const steps = ([[x, y], ...later], end) => `M${x} ${y}${later.map(([x, y]) => `H${x}V${y}`).join("")}H${end}`;

/** The proven bound and the best grasp found, against time or against cone programs solved. */
function gapCurve(by, label) {
  const last = trace.at(-1), known = trace.filter((line) => line.incumbent !== null);
  // early grasps can be many times worse than the last: they may leave the picture, which is about the gap that closes
  const worst = known.length ? Math.min(known[0].incumbent, 3 * last.incumbent) : 0;
  const most = [1.1 * last[by], 1.1 * Math.max(worst, last.lower_bound) || 1]; // room for the end state to be seen
  const plot = new Plot("gap", most, [label, "rho, the force of a finger [N]"]), end = plot.x(most[0]);
  const points = (lines, key) => lines.map((line) => [plot.x(line[by]), plot.y(line[key])]);
  const [below, above] = [points(trace, "lower_bound"), points(known, "incumbent")];
  const area = (line) => `${steps(line, end)}V${plot.y(0)}H${line[0][0]}Z`;
  const hatch = plot.draw("pattern", { id: "hatch", width: 6, height: 6, patternUnits: "userSpaceOnUse",
    patternTransform: "rotate(45)" });
  for (const [width, fill] of [[6, "#f1f5f9"], [2.5, "#cbd5e1"]]) {
    hatch.append(plot.make("rect", { width, height: 6, fill }));
  }
  if (above.length) plot.draw("path", { d: area(above), fill: "#fde9c8" });
  plot.draw("path", { d: area(below), fill: "url(#hatch)" });
  for (const [line, color] of [[below, "#64748b"], [above, "#1b2733"]]) {
    if (line.length) plot.draw("path", { d: steps(line, end), fill: "none", stroke: color, "stroke-width": 1.5 });
    const r = line.length > 40 ? 1.2 : 2.4;
    line.forEach(([cx, cy]) => plot.draw("circle", { cx, cy, r, fill: color }));
  }
  return plot.element;
}

const AXES = { seconds: "time [s]", socp_solves: "second-order cone programs solved" };

/** The gap curve with a choice of its axis. */
function gapPanel() {
  const usable = Object.entries(AXES).filter(([by]) => trace.length > 1 && trace.at(-1)[by] > trace[0][by]);
  if (!usable.length) return [];
  const box = el("div"), buttons = usable.map(([by, label]) => el("button", { type: "button", "data-by": by }, label));
  const draw = (pressed) => {
    buttons.forEach((button) => button.setAttribute("aria-pressed", button === pressed));
    box.replaceChildren(gapCurve(pressed.dataset.by, AXES[pressed.dataset.by]));
  };
  buttons.forEach((button) => button.addEventListener("click", () => draw(button)));
  draw(buttons[0]);
  const key = (name, words) => el("span", {}, el("i", { class: name }), words);
  return [el("div", { class: "choice" }, ...(buttons.length > 1 ? ["against ", ...buttons] : [])), box,
    el("p", { class: "keys" }, ...(found ? [key("best", "best grasp so far"), key("open", "open gap")] : []),
      key("proven", "proven: no choice needs less"))];
}

/** The log as the terminal shows it. */
function searchLog() {
  const gap = ({ incumbent, lower_bound: bound }) =>
    (incumbent === null || bound <= 0 ? "–" : `${rounded(100 * Math.max(0, incumbent / bound - 1))} %`);
  const rows = trace.map((line) => [number(line.seconds, 3), count(line.nodes), count(line.open),
    number(line.lower_bound, 5), number(line.incumbent, 5), gap(line), count(line.socp_solves), count(line.cuts)]);
  const heads = ["time [s]", "nodes", "open", "bound [N]", "best [N]", "gap", "SOCPs", "cuts"];
  const lines = `${trace.length} ${trace.length === 1 ? "line" : "lines"}`;
  return el("details", trace.length > SHORT ? { id: "log" } : { id: "log", open: "" },
    el("summary", {}, `Search log, ${lines}`), el("div", { class: "wide" }, table(heads, rows)));
}

function searchPanel() {
  const { method, fingers, candidates, subsets, nodes, socp_solves: solves, cuts, gap, seconds } = data.search;
  const counts = list({ method, fingers, candidates: count(candidates), subsets: count(subsets), nodes: count(nodes),
    "cone programs solved": count(solves), cuts: count(cuts), "gap asked for": percent(gap, 2),
    time: `${number(seconds, 3)} s` });
  const log = trace.length ? searchLog() : el("p", { class: "muted" }, "This file holds no search log.");
  return section("How it was searched", ...gapPanel(), counts, log);
}

/** What candidates were asked for, in the words of the command's options. */
function chosen() {
  if (!data.candidate_choice) return { candidates: "choice not recorded" };
  const { candidates, friction, fingertip, seed } = data.candidate_choice;
  return { candidates, friction: friction ?? "each geom's own", ...(fingertip === null ? {}
    : { fingertip: `${number(1000 * fingertip, 4)} mm` }), "seed of the candidates": seed };
}

function reproducePanel() {
  const command = data.command === null
    ? el("p", {}, "No command line is recorded: the grasp was made from Python, or by an older version.")
    : shell(data.command, { id: "command" });
  const packages = Object.entries(data.packages).map(([name, version]) => `${name} ${version}`).join(" · ");
  return section("Reproduce", command,
    list({ ...chosen(), "seed of the search": data.search.seed, "object": data.object.file,
      "its sha256": el("code", {}, data.object.sha256) }), el("p", { class: "muted" }, packages));
}

function checkPanel() {
  const step = (words, command) => [el("p", { class: "muted" }, words), shell(command)];
  return section("Check it yourself",
    ...step("Every claim about the forces and the bound, with none of the code that found them:", data.commands.verify),
    ...(found ? step("The measurement in MuJoCo:", data.commands.validate) : []),
    ...step("This page:", data.commands.report));
}
