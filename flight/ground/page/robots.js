/// The robots: one chip each in the bar, with its colour, phase, battery and link; a panel with the slider between own maps and the merged one,
/// and with what the base station holds: who told what, and when.

import {ofRobot} from "./colours.js";
import {el, keyed, say, show} from "./dom.js";
import {duration, percent, quantity} from "./format.js";

export class Robots {
  /// `clock()`: s, the system clock.
  constructor({bar, panel, store, choices, view, mode, clock = () => Date.now() / 1000}) {
    Object.assign(this, {bar, store, choices, view, mode, clock});
    this.slider = el("input", {type: "range", min: 0, max: 100, step: 1, value: 0, "aria-label": "From own maps to the merged one, %", oninput: () => choices.set({merged: Number(this.slider.value) / 100})});
    this.merged = el("p", {class: "note"});
    this.list = el("div", {class: "robots"});
    this.fader = el("section", {}, el("h3", {}, "Maps"), el("label", {class: "fader"}, el("span", {}, "own"), this.slider, el("span", {}, "merged")), this.merged);
    this.told = el("div", {class: "told"});
    this.base = el("section", {hidden: true}, el("h3", {}, "The base station holds"), this.told);
    panel.append(this.list, this.fader, this.base);
  }

  update() {
    const names = this.store.names();
    if (names.length && !names.includes(this.choices.robot)) this.choices.set({robot: names[0]});
    keyed(this.bar, names, name => this.#chip(name), (node, name) => this.#fillChip(node, name));
    keyed(this.list, names, name => this.#card(name), (node, name) => this.#fillCard(node, name));
    show(this.fader, names.length > 1);
    this.#base();
    const shared = this.view.mergedMap.filter(({robots}) => robots.length > 1).length;
    say(this.merged, this.choices.merged > 0
      ? `${this.view.mergedMap.length} objects, ${shared} of them seen by several robots: of each, the estimate with the smallest standard deviation is shown.`
      : "Each robot's own map is shown. The merged one takes objects of one class within 1.5 m as one.");
  }

  #base() {
    const {base} = this.store;
    show(this.base, Boolean(base));
    if (!base) return;
    const rows = new Map(base.robots.flatMap(robot => rowsOf(robot, this.clock())));
    if (!rows.size) rows.set("none", "nothing yet");
    keyed(this.told, [...rows.keys()], () => el("p", {class: "note"}), (node, key) => say(node, rows.get(key)));
  }

  #chip(name) {
    const text = el("span", {}), mark = el("i", {});
    mark.style.background = ofRobot(this.store.names().indexOf(name));
    const node = el("button", {class: "chip", onclick: () => this.choices.set({robot: name})}, mark, el("b", {}, name), text);
    node.parts = {text, mark};
    return node;
  }

  #lost(robot) {
    return this.mode() === "live" && robot.newest.link?.lost;
  }

  #fillChip(node, name) {
    const robot = this.store.robots.get(name), {mission, state} = robot.newest;
    node.parts.mark.style.background = ofRobot(this.store.names().indexOf(name));
    node.setAttribute("aria-pressed", String(this.choices.robot === name));
    node.classList.toggle("lost", Boolean(this.#lost(robot)));
    say(node.parts.text, this.#lost(robot) ? "not heard" : [mission?.phase, percent(state?.battery_share, "")].filter(Boolean).join(", ") || "waiting");
  }

  #card(name) {
    const text = el("small", {}), mark = el("i", {});
    mark.style.background = ofRobot(this.store.names().indexOf(name));
    const node = el("button", {onclick: () => this.choices.set({robot: name, follow: true})}, mark, el("span", {}, el("b", {}, name), text));
    node.parts = {text};
    return node;
  }

  #fillCard(node, name) {
    const robot = this.store.robots.get(name), {mission, state, objects} = robot.newest;
    node.setAttribute("aria-pressed", String(this.choices.robot === name));
    say(node.parts.text, [mission ? `${mission.phase}${mission.targets ? `, target ${mission.target} of ${mission.targets}` : ""}` : "no mission heard",
      `battery ${percent(state?.battery_share)}`, `${objects?.total ?? robot.objects.size} objects`, this.#lost(robot) ? "not heard" : ""].filter(Boolean).join(" · "));
  }
}

const KINDS = {history: "flight", prior_map: "prior map", uncertainty: "uncertainty model"};
const kB = bytes => quantity(bytes / 1000, "kB", 1);

/// [key, words] of what a robot told the base: its streams, each with its size and when more of it came.
function rowsOf({name, heard_s, streams}, now_s) {
  const ago = t_s => (t_s === undefined ? "" : `${duration(Math.max(0, now_s - t_s))} ago`);
  const heard = heard_s === undefined ? "never in contact" : `in contact ${ago(heard_s)}`;
  return [[name, `${name}: ${heard}${streams.length ? "" : ", told nothing yet"}`], ...streams.map(({kind, version, bytes, gaps, came_s}) => [`${name}/${kind}/${version}`,
    [`${name}, ${KINDS[kind] ?? kind} ${version}: ${kB(bytes)}`, gaps ? `${gaps} pieces after a gap` : "", came_s === undefined ? "" : `more came ${ago(came_s)}`].filter(Boolean).join(", ")])];
}
