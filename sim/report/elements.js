"use strict";
// What the page is made of. All text from files goes through textContent or setAttribute, never through HTML.

const number = (value, digits = 6) => (value === null || value === undefined ? "–" : Number(value).toPrecision(digits)
  .replace(/(\.\d*?)0+(?=e|$)/, "$1").replace(/\.(?=e|$)/, ""));
const percent = (value, digits = 1) => `${(100 * value).toFixed(digits)} %`;
const count = (value) => value.toLocaleString("en");
const rounded = (value) => value.toLocaleString("en", { maximumSignificantDigits: 3 });

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
  [el("dt", {}, key.replaceAll("_", " ")), el("dd", {}, value instanceof Node ? value : String(value))]));
const section = (title, ...children) => [el("h2", {}, title), ...children];
const table = (heads, rows) => el("table", {}, el("tr", {}, ...heads.map((head) => el("th", {}, head))),
  ...rows.map((cells) => el("tr", {}, ...cells.map((cell) => cell instanceof Node && cell.tagName === "TD"
    ? cell : el("td", {}, cell)))));


/** A command as a shell takes it; an option is not broken at its hyphens. */
const shell = (command, attributes = {}) => el("pre", attributes, ...command.split(/(\s+)/).map((word) =>
  (word.startsWith("-") ? el("span", { class: "option" }, word) : word)));

/** Round values from zero up to `most`, about five of them. */
function ticks(most) {
  const raw = most / 5, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 2.5, 5, 10].find((factor) => factor * power >= raw);
  return Array.from({ length: 1 + Math.floor(most / step) }, (_, k) => k * step);
}

/** A drawing with labelled axes from zero to `mostX` and `mostY`; x and y give the place of a value. */
class Plot {
  constructor(id, [mostX, mostY], [labelX, labelY]) {
    const [wide, high, left, right, low, top] = [428, 220, 46, 12, 36, 22];
    this.x = (value) => left + (wide - left - right) * value / mostX;
    this.y = (value) => high - low - (high - low - top) * value / mostY;
    this.element = this.make("svg", { id, class: "plot", viewBox: `0 0 ${wide} ${high}`, role: "img",
      "aria-label": `${labelY} against ${labelX}` });
    this.frame(id, left - 3, top - 3, wide - left - right + 6, high - low - top + 6);
    for (const value of ticks(mostY)) {
      this.draw("path", { d: `M${left} ${this.y(value)}H${wide - right}`, stroke: value ? "#eef2f6" : "#cbd5e1" });
      this.write(left - 7, this.y(value) + 4, "end", rounded(value));
    }
    for (const value of ticks(mostX)) this.write(this.x(value), high - low + 15, "middle", rounded(value));
    this.write((left + wide - right) / 2, high - 5, "middle", labelX);
    this.write(0, 10, "start", labelY);
  }

  /** What is drawn stays within the axes. */
  frame(id, x, y, width, height) {
    const clip = this.element.appendChild(this.make("clipPath", { id: `${id}-frame` }));
    clip.append(this.make("rect", { x, y, width, height }));
    this.inside = this.element.appendChild(this.make("g", { "clip-path": `url(#${id}-frame)` }));
  }

  make(name, attributes) {
    const shape = document.createElementNS("http://www.w3.org/2000/svg", name);
    Object.entries(attributes).forEach(([key, value]) => shape.setAttribute(key, value));
    return shape;
  }

  draw(name, attributes) {
    return this.inside.appendChild(this.make(name, attributes));
  }

  write(x, y, anchor, text) {
    const label = this.element.appendChild(this.make("text", { x, y, "text-anchor": anchor }));
    label.textContent = text;
  }
}
