/// The robots: one chip each in the bar, with its colour, phase, battery and link; a panel with the slider between own maps and the merged one.

import {ofRobot} from "./colours.js";
import {el, keyed, say, show} from "./dom.js";
import {percent} from "./format.js";

export class Robots {
  constructor({bar, panel, store, choices, view, mode}) {
    Object.assign(this, {bar, store, choices, view, mode});
    this.slider = el("input", {type: "range", min: 0, max: 100, step: 1, value: 0, "aria-label": "From own maps to the merged one, %", oninput: () => choices.set({merged: Number(this.slider.value) / 100})});
    this.merged = el("p", {class: "note"});
    this.list = el("div", {class: "robots"});
    this.fader = el("section", {}, el("h3", {}, "Maps"), el("label", {class: "fader"}, el("span", {}, "own"), this.slider, el("span", {}, "merged")), this.merged);
    panel.append(this.list, this.fader);
  }

  update() {
    const names = this.store.names();
    if (names.length && !names.includes(this.choices.robot)) this.choices.set({robot: names[0]});
    keyed(this.bar, names, name => this.#chip(name), (node, name) => this.#fillChip(node, name));
    keyed(this.list, names, name => this.#card(name), (node, name) => this.#fillCard(node, name));
    show(this.fader, names.length > 1);
    const shared = this.view.mergedMap.filter(({robots}) => robots.length > 1).length;
    say(this.merged, this.choices.merged > 0
      ? `${this.view.mergedMap.length} objects, ${shared} of them seen by several robots: of each, the estimate with the smallest standard deviation is shown.`
      : "Each robot's own map is shown. The merged one takes objects of one class within 1.5 m as one.");
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
