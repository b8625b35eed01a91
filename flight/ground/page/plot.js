/// Small plots as SVG: a line over time with its unit, and a band of one standard deviation where there is one.

const NS = "http://www.w3.org/2000/svg";

function node(tag, attributes) {
  const made = document.createElementNS(NS, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

/// The path of samples [[t, v], …] in a box; where a value is not known the line breaks. Pure, but for its form.
export function linePath(samples, {begin, end, low, high, width, height}) {
  const x = t => ((t - begin) / Math.max(1e-9, end - begin)) * width;
  const y = v => height - ((v - low) / Math.max(1e-9, high - low)) * height;
  let path = "", drawing = false;
  for (const [t, v] of samples) {
    const known = v !== null && v !== undefined && Number.isFinite(v);
    if (known) path += `${drawing ? "L" : "M"}${x(t).toFixed(1)} ${y(v).toFixed(1)}`;
    drawing = known;
  }
  return path;
}

/// Lowest and highest value that is known, at least `least` apart; null: none is.
export function range(values, least = 0) {
  const known = values.filter(v => v !== null && v !== undefined && Number.isFinite(v));
  if (!known.length) return null;
  let low = Math.min(...known), high = Math.max(...known);
  if (high - low < least) [low, high] = [(low + high - least) / 2, (low + high + least) / 2];
  return [low, high];
}

/// A sparkline: `set(samples)` with samples [[t, v], …]; from zero on, if `fromZero`.
export class Spark {
  constructor({width = 84, height = 20, least = 1, fromZero = true} = {}) {
    Object.assign(this, {width, height, least, fromZero});
    this.node = node("svg", {class: "spark", viewBox: `0 -1 ${width} ${height + 2}`, width, height, "aria-hidden": "true", preserveAspectRatio: "none"});
    this.line = this.node.appendChild(node("path", {d: ""}));
    this.node.appendChild(node("line", {x1: 0, x2: width, y1: height, y2: height, class: "base"}));
  }

  set(samples) {
    const bounds = range(samples.map(([, v]) => v), this.least);
    if (!bounds) return this.line.setAttribute("d", "");
    const [low, high] = this.fromZero ? [0, Math.max(bounds[1], this.least)] : bounds;
    const {width, height} = this;
    return this.line.setAttribute("d", linePath(samples, {begin: samples[0][0], end: samples.at(-1)[0], low, high, width, height}));
  }
}

/// A plot with axes: lines [{samples: [[t, v, sd]], class, name}], values in `unit`.
export function plot(lines, {width = 380, height = 120, unit = "m", least = 0.05, digits = 2} = {}) {
  const left = 52, right = 8, top = 8, bottom = 20, inner = {width: width - left - right, height: height - top - bottom};
  const all = lines.flatMap(({samples}) => samples);
  const bounds = range(all.flatMap(([, v, sd]) => (v === null ? [] : [v - (sd ?? 0), v + (sd ?? 0)])), least);
  const svg = node("svg", {class: "plot", viewBox: `0 0 ${width} ${height}`, role: "img"});
  if (!bounds) return svg;
  const pad = (bounds[1] - bounds[0]) * 0.08;
  const [low, high] = [bounds[0] - pad, bounds[1] + pad], begin = Math.min(...all.map(([t]) => t)), end = Math.max(...all.map(([t]) => t), begin + 1);
  const box = {begin, end, low, high, ...inner};
  const body = svg.appendChild(node("g", {transform: `translate(${left} ${top})`}));
  const words = (x, y, text, anchor) => {
    const made = svg.appendChild(node("text", {x, y, "text-anchor": anchor}));
    made.textContent = text;
  };
  for (const k of [0, 0.5, 1]) {
    const y = inner.height * (1 - k);
    body.appendChild(node("line", {x1: 0, x2: inner.width, y1: y, y2: y, class: "grid"}));
    words(left - 5, top + y + 4, `${(low + k * (high - low)).toFixed(digits)} ${unit}`, "end");
  }
  for (const {samples, name} of lines) {
    const up = samples.map(([t, v, sd]) => [t, v + (sd ?? 0)]), down = samples.map(([t, v, sd]) => [t, v - (sd ?? 0)]).reverse();
    if (samples.length > 1) body.appendChild(node("path", {d: `${linePath([...up, ...down], box).replace(/(?!^)M/g, "L")}Z`, class: `band ${name}`}));
    body.appendChild(node("path", {d: linePath(samples, box), class: `line ${name}`}));
    for (const [t, v] of samples.length < 40 ? samples : samples.slice(-1)) {
      body.appendChild(node("circle", {cx: ((t - begin) / (end - begin)) * inner.width, cy: inner.height * (1 - (v - low) / (high - low)), r: 2, class: `dot ${name}`}));
    }
  }
  words(left, height - 4, `${(end - begin).toFixed(0)} s before`, "start");
  words(width - right, height - 4, "newest", "end");
  return svg;
}
