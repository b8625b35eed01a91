/// The mission: its phases, its targets, time and gain so far, why it is where it is, which viewpoints were weighed and refused, what was said;
/// of a finished run its figures.

import {el, keyed, say, show} from "./dom.js";
import {duration, quantity} from "./format.js";
import {figureWords, PHASES, targetWords, waitingFor} from "./words.js";

const SIGNS = {done: "\u2713", visited: "\u2713", left: "\u2212", next: "\u25b6", unreachable: "\u2715", planned: "\u25cb", waiting: "\u2026"};
const MOST_LINES = 60, MOST_VIEWPOINTS = 12;

export class Mission {
  constructor(parent, {store, choices, host, goTo}) {
    Object.assign(this, {store, choices, host, goTo});
    this.none = el("p", {class: "none"});
    this.phases = el("ol", {class: "phases", "aria-label": "Phases"}, PHASES.map(phase => el("li", {"data-phase": phase}, phase)));
    this.facts = el("div", {class: "facts"});
    this.targets = el("div", {class: "targets", "aria-label": "Targets"});
    this.viewpoints = el("div", {class: "lines"});
    this.refused = el("div", {class: "lines"});
    this.orders = el("div", {class: "lines"});
    this.log = el("div", {class: "lines log"});
    this.figures = el("div", {class: "facts"});
    this.titles = {};
    parent.append(this.none, this.phases, this.facts, this.#titled("Targets", this.targets), this.#titled("Viewpoints weighed", this.viewpoints),
      this.#titled("Refused", this.refused), this.#titled("Figures of the run", this.figures), this.#titled("Orders", this.orders), this.#titled("What was said", this.log));
  }

  #titled(title, node) {
    return (this.titles[title] = el("section", {}, el("h3", {}, title), node));
  }

  update() {
    const robot = this.store.robots.get(this.choices.robot), mission = robot?.newest.mission;
    show(this.none, !mission);
    show(this.phases, Boolean(mission));
    if (!mission) say(this.none, waitingFor(this.choices.robot ?? "R1", "mission", this.host));
    if (!robot) return;
    this.#phases(mission);
    this.#facts(robot, mission);
    this.#targets(robot);
    this.#viewpoints(robot.newest.plan);
    this.#said(robot);
  }

  #phases(mission) {
    const at = PHASES.indexOf(mission?.phase);
    [...this.phases.children].forEach((node, i) => {
      node.toggleAttribute("aria-current", i === at);
      node.classList.toggle("past", i < at);
    });
    this.phases.dataset.hold = mission?.phase === "hold" ? "hold" : "";
  }

  #facts(robot, mission) {
    const {path, trajectory, plan} = robot.newest, rows = [
      ["phase", mission?.phase], ["target", mission?.targets > 0 ? `${mission.target} of ${mission.targets}` : "none yet"],
      ["time since take-off", duration(mission?.elapsed_s, "not begun")], ["gain so far", quantity(mission?.gain_nat, "nat", 1)],
      ["way flown", quantity(path?.length_m, "m", 1)], ["committed way ends in", duration(trajectory?.end_s, "none is committed")],
      ["planner", plan?.reason || "nothing was refused"],
    ];
    facts(this.facts, rows);
  }

  #targets(robot) {
    const order = {done: 0, visited: 1, left: 2, next: 3, planned: 4, waiting: 5, unreachable: 6};
    const targets = [...robot.objects.values()].filter(({target}) => target)
      .sort((a, b) => order[a.target.state] - order[b.target.state] || (a.target.tour ?? 0) - (b.target.tour ?? 0) || a.id - b.id);
    show(this.titles.Targets, targets.length > 0);
    const byId = new Map(targets.map(object => [String(object.id), object]));
    keyed(this.targets, [...byId.keys()], id => el("button", {onclick: () => this.goTo(robot.name, Number(id))}), (node, id) => {
      const {target, class: name} = byId.get(id);
      say(node, `${SIGNS[target.state] ?? "?"} ${id}`);
      node.dataset.state = target.state;
      node.title = `${name} ${id}: ${targetWords(target)}`;
      node.setAttribute("aria-label", node.title);
    });
  }

  #viewpoints(plan) {
    const weighed = [...(plan?.candidates ?? [])].sort((a, b) => (b.gain_nat ?? -1) - (a.gain_nat ?? -1)).slice(0, MOST_VIEWPOINTS);
    show(this.titles["Viewpoints weighed"], weighed.length > 0);
    lines(this.viewpoints, weighed.map(({target_id: target, gain_nat, path_m, chosen}) => ({
      text: `${target < 0 ? "stop of the sweep" : `target ${target}`}: ${quantity(gain_nat, "nat", 2, "gain not computed")}, ${quantity(path_m, "m", 1, "no way there")} to fly${chosen ? " \u2014 chosen" : ""}`,
      kind: chosen ? "chosen" : "",
    })));
    const reasons = new Map();
    for (const {reason} of plan?.refused ?? []) reasons.set(reason, (reasons.get(reason) ?? 0) + 1);
    show(this.titles.Refused, reasons.size > 0);
    lines(this.refused, [...reasons].sort((a, b) => b[1] - a[1]).map(([reason, count]) => ({text: `${count} viewpoint${count === 1 ? "" : "s"}: ${reason}`})));
  }

  #said(robot) {
    show(this.titles["What was said"], robot.log.length > 0);
    const first = robot.log[0]?.t_s ?? 0;
    lines(this.log, robot.log.slice(-MOST_LINES).reverse().map(({message, level, t_s}) => ({text: `${duration(Math.max(0, t_s - first))}  ${message}`, kind: level >= 4 ? "bad" : level === 3 ? "warn" : ""})));
    show(this.titles.Orders, robot.orders.size > 0);
    lines(this.orders, [...robot.orders.values()].reverse().map(({kind, by, state, text, took_s, t_s}) => ({
      text: `${new Date(t_s * 1000).toLocaleTimeString("en-GB")}  ${kind} by ${by}: ${state}${took_s === null || took_s === undefined ? "" : ` after ${duration(took_s)}`}${text ? `, ${text}` : ""}`,
      kind: state === "acknowledged" ? "" : state === "sent" ? "warn" : "bad",
    })));
    const figures = Object.entries(robot.newest.figures ?? {}).map(([name, value]) => figureWords(name, value)).filter(Boolean);
    show(this.titles["Figures of the run"], figures.length > 0);
    facts(this.figures, figures);
  }
}

// By place, for two figures may have one name: "error, m" and "error, rad".
function facts(node, rows) {
  const parts = rows.flat();
  keyed(node, parts.map((_, i) => i), i => el(i % 2 === 0 ? "span" : "b", {}), (child, i) => say(child, String(parts[i])));
}

function lines(node, rows) {
  keyed(node, rows.map((_, i) => i), () => el("p", {}), (child, i) => {
    say(child, rows[i].text);
    child.className = rows[i].kind ?? "";
  });
}
