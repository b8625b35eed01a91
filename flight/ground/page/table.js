/// The table of objects: sorted by a click on a column's name, only the rows in sight are in the page, so that ten thousand are no more than
/// twenty. A click or Enter on a row goes there and shows how its size came about.

import {ofClass} from "./colours.js";
import {el, say, show} from "./dom.js";
import {quantity, times, withSd} from "./format.js";
import {plot} from "./plot.js";
import {chosenRows, rowOf, sortedRows} from "./rows.js";

const ROW_PX = 40, SPARE = 6;
const HEADS = [["class", "Object"], ["length", "Length × width ± sd"], ["seen", "Seen"], ["target", "Target"]];

export class Table {
  /// `goTo(robot, id)`; `history(robot, id)` asks for what the server keeps.
  constructor(parent, {store, choices, goTo, history, host}) {
    Object.assign(this, {store, choices, goTo, history, host, column: "target", descending: false, words: "", off: new Set(), rows: []});
    this.search = el("input", {type: "search", placeholder: "class, id, state", "aria-label": "Rows that contain", oninput: () => { this.words = this.search.value; this.update(); }});
    this.filters = el("span", {class: "chips", role: "group", "aria-label": "Classes"});
    this.count = el("span", {class: "count", "aria-live": "polite"});
    this.heads = HEADS.map(([column, text]) => el("button", {role: "columnheader", class: `cell ${column}`, "data-column": column, onclick: () => this.sortBy(column)}, text));
    this.body = el("div", {class: "rows", role: "rowgroup"});
    this.scroller = el("div", {class: "scroller", role: "table", tabindex: "0", "aria-label": "Objects of the map", onscroll: () => this.#place(), onkeydown: event => this.#key(event)},
      el("div", {class: "row head", role: "row"}, this.heads), this.body);
    this.none = el("p", {class: "none"});
    this.card = el("div", {class: "card", hidden: true});
    parent.append(el("div", {class: "tools"}, this.search, this.filters, this.count), this.scroller, this.none, this.card);
    choices.on(what => (what.object !== undefined || what.robot !== undefined) && this.update());
    new ResizeObserver(() => this.#place()).observe(this.scroller);
  }

  sortBy(column) {
    this.descending = this.column === column && !this.descending;
    this.column = column;
    this.update();
  }

  /// What is shown, sorted: what is exported, too.
  shown() {
    const robot = this.choices.robot;
    const names = robot ? [robot] : this.store.names();
    const all = names.flatMap(name => [...this.store.robots.get(name).objects.values()].map(object => rowOf(name, object)));
    this.all = all.length;
    this.classes = [...new Set(all.map(row => row.class))].sort();
    const classes = this.off.size ? new Set(this.classes.filter(name => !this.off.has(name))) : null;
    return sortedRows(chosenRows(all, {classes, words: this.words}), this.column, this.descending);
  }

  update() {
    this.rows = this.shown();
    this.#filters();
    for (const head of this.heads) {
      head.setAttribute("aria-sort", head.dataset.column !== this.column ? "none" : this.descending ? "descending" : "ascending");
    }
    say(this.count, this.rows.length === this.all ? `${this.all} objects` : `${this.rows.length} of ${this.all} objects`);
    show(this.none, this.rows.length === 0);
    show(this.scroller, this.rows.length > 0);
    const robot = this.choices.robot ?? "R1";
    say(this.none, this.all ? "no object has these words" : `no data yet: waiting for ${robot}_OBJECTS on ${this.host}`);
    this.#place();
    this.#card();
  }

  #filters() {
    if (this.filters.dataset.of === this.classes.join()) return;
    this.filters.dataset.of = this.classes.join();
    this.filters.replaceChildren(...this.classes.map(name => {
      const {glyph, colour} = ofClass(name), mark = el("b", {"aria-hidden": "true"}, glyph);
      mark.style.color = colour;
      const button = el("button", {"aria-pressed": String(!this.off.has(name)), onclick: () => {
        if (!this.off.delete(name)) this.off.add(name);
        button.setAttribute("aria-pressed", String(!this.off.has(name)));
        this.update();
      }}, mark, ` ${name}`);
      return button;
    }));
  }

  // Rows in sight, by what is scrolled.
  #place() {
    const first = Math.max(0, Math.floor((this.scroller.scrollTop - ROW_PX) / ROW_PX) - SPARE);
    const last = Math.min(this.rows.length, first + Math.ceil(this.scroller.clientHeight / ROW_PX) + 2 * SPARE);
    this.body.style.height = `${this.rows.length * ROW_PX}px`;
    while (this.body.children.length < last - first) this.body.append(this.#makeRow());
    [...this.body.children].forEach((node, i) => {
      show(node, first + i < last);
      if (first + i < last) this.#fill(node, this.rows[first + i], first + i);
    });
  }

  #makeRow() {
    const mark = el("b", {"aria-hidden": "true"}), name = el("span"), sub = el("small");
    const cells = {class: el("span", {class: "cell class", role: "cell"}, mark, el("span", {}, name, sub)), length: el("span", {class: "cell length", role: "cell"}),
      seen: el("span", {class: "cell seen", role: "cell"}), target: el("span", {class: "cell target", role: "cell"})};
    const node = el("div", {class: "row", role: "row", onclick: () => this.#choose(node.row)}, Object.values(cells));
    node.parts = {mark, name, sub, ...cells};
    return node;
  }

  #fill(node, row, at) {
    node.row = row;
    node.style.transform = `translateY(${at * ROW_PX}px)`;
    const {mark, name, sub, length, seen, target} = node.parts, {glyph, colour} = ofClass(row.class);
    say(mark, glyph);
    mark.style.color = colour;
    say(name, `${row.class} ${row.id}`);
    say(sub, this.choices.robot ? "" : row.robot);
    say(length, sizeWords(row));
    say(seen, times(row.observations));
    say(target, row.state);
    node.dataset.id = row.id;
    node.dataset.state = row.target?.state ?? "none";
    const chosen = this.choices.object;
    node.setAttribute("aria-selected", String(chosen?.id === row.id && chosen.robot === row.robot));
  }

  #choose(row) {
    this.goTo(row.robot, row.id);
    if (matchMedia("(max-width: 760px)").matches) this.card.scrollIntoView({block: "nearest"});
    this.history(row.robot, row.id)?.then(() => this.#card());
  }

  #key(event) {
    const step = {ArrowDown: 1, ArrowUp: -1, PageDown: 8, PageUp: -8, Home: -Infinity, End: Infinity}[event.key];
    if (step === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const chosen = this.choices.object;
    const now = this.rows.findIndex(row => chosen && row.id === chosen.id && row.robot === chosen.robot);
    const next = Math.min(this.rows.length - 1, Math.max(0, now + step));
    if (!this.rows[next]) return;
    const top = next * ROW_PX, seen = this.scroller.clientHeight - 2 * ROW_PX;
    if (top < this.scroller.scrollTop || top > this.scroller.scrollTop + seen) this.scroller.scrollTop = top - (step > 0 ? seen : 0);
    this.#choose(this.rows[next]);
  }

  // The object that is chosen: all that is known of it, and its size over time.
  #card() {
    const chosen = this.choices.object, robot = chosen && this.store.robots.get(chosen.robot), object = robot?.objects.get(chosen.id);
    show(this.card, Boolean(object));
    if (!object) return;
    const row = rowOf(chosen.robot, object), samples = robot.sizes.get(object.id)?.samples ?? [];
    const of = k => samples.map(sample => [sample[0], sample[1 + k], sample[3 + k]]);
    const round = row.shape === "cylinder";
    const lines = round ? [{name: "length", samples: of(0)}] : [{name: "length", samples: of(0)}, {name: "width", samples: of(1)}];
    const drawn = lines.map(line => plot([line], {height: 84, least: 0.2}));
    const newest = el("div", {class: "facts"}, facts(row).flatMap(([what, value, wide]) => [el("span", {}, what), el("b", {class: wide ? "wide" : null}, value)]));
    this.card.replaceChildren(
      el("h3", {}, `${row.class} ${row.id}`, el("button", {class: "close", "aria-label": "Close", onclick: () => this.choices.set({object: null})}, "\u00d7")),
      ...drawn.map((svg, k) => el("figure", {}, el("figcaption", {}, `${round ? "diameter" : ["length", "width"][k]} over time, band: one standard deviation`), svg)), newest);
  }
}

function sizeWords(row) {
  if (row.shape === "cylinder") return `\u2300 ${withSd(row.size[0], row.sd[0], "m")}`;
  return `${withSd(row.size[0], row.sd[0], "m")} × ${withSd(row.size[1], row.sd[1], "m")}`;
}

function facts(row) {
  const round = row.shape === "cylinder", [x, y, z] = round ? row.object.root : row.object.position;
  return [
    ...(round ? [["diameter", withSd(row.size[0], row.sd[0], "m")]] : [["length", withSd(row.size[0], row.sd[0], "m")], ["width", withSd(row.size[1], row.sd[1], "m")]]),
    ["height", quantity(row.height_m, "m", 2)],
    ["place", `${quantity(x, "m", 2)}, ${quantity(y, "m", 2)}, ${quantity(z, "m", 2)}`, true],
    ["place, sd", (row.object.sd?.position ?? []).map(v => quantity(v, "m", 3)).join(", ") || "not computed", true],
    ["class is right", quantity(row.probability === null ? null : row.probability * 100, "%", 1)],
    ["seen", times(row.observations)],
    ["target", row.state, true],
  ];
}
