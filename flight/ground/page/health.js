/// Every loop of every process: its rate, the age of its input, its lateness, what it takes, each with a plot of the last minutes.

import {el, keyed, say, show} from "./dom.js";
import {quantity} from "./format.js";
import {Spark} from "./plot.js";
import {waitingFor} from "./words.js";

const PLOTS = [
  {name: "rate", at: 1, unit: "Hz", digits: 1, unknown: "on arrival", least: 1},
  {name: "input's age", at: 2, unit: "ms", digits: 0, unknown: "nothing yet", least: 20},
  {name: "worst lateness", at: 3, unit: "ms", digits: 1, unknown: "no deadline", least: 5},
  {name: "takes (p95)", at: 4, unit: "ms", digits: 1, unknown: "did not run", least: 5},
];

export class Health {
  constructor(parent, {store, choices, host}) {
    Object.assign(this, {store, choices, host});
    this.none = el("p", {class: "none"});
    this.processes = el("div", {});
    this.channels = el("div", {class: "facts ages"});
    this.channelsTitle = el("h3", {}, "Age of the newest message by channel");
    parent.append(this.none, this.processes, this.channelsTitle, this.channels);
  }

  update() {
    const robot = this.store.robots.get(this.choices.robot);
    const processes = robot ? [...robot.processes.keys()].sort() : [];
    show(this.none, processes.length === 0);
    if (!processes.length) say(this.none, waitingFor(this.choices.robot ?? "R1", "health", this.host));
    keyed(this.processes, processes, process => this.#make(process), (node, process) => this.#fill(node, robot, process));
    const channels = Object.entries(robot?.newest.link?.channels ?? {});
    show(this.channelsTitle, channels.length > 0);
    keyed(this.channels, channels.flatMap(([name]) => [`${name}?`, name]), key => el(key.endsWith("?") ? "span" : "b", {}), (node, key) => {
      const age = robot.newest.link.channels[key];
      say(node, key.endsWith("?") ? `${robot.name}_${key.slice(0, -1)}` : quantity(age, "s", 2, "never heard"));
      node.classList.toggle("old", age > 3);
    });
  }

  #make(process) {
    const loops = el("div", {class: "loops"}), counters = el("p", {class: "counters"});
    const node = el("section", {class: "process"}, el("h3", {}, process), loops, counters);
    node.parts = {loops, counters};
    return node;
  }

  #fill(node, robot, process) {
    const health = robot.processes.get(process), byName = new Map(health.loops.map(loop => [loop.name, loop]));
    keyed(node.parts.loops, [...byName.keys()], name => makeLoop(name), (row, name) => fillLoop(row, byName.get(name), robot.loops.get(`${process}/${name}`)));
    const counters = Object.entries(health.counters ?? {}).map(([name, value]) => `${name.replaceAll("_", " ")}: ${value}`);
    say(node.parts.counters, counters.length ? `since the start, counts: ${counters.join("; ")}` : "");
  }
}

function makeLoop(name) {
  const plots = PLOTS.map(({name: what, least}) => {
    const spark = new Spark({least}), value = el("b", {});
    return {spark, value, node: el("div", {class: "measure"}, el("span", {}, what), value, spark.node)};
  });
  const late = el("small", {}), row = el("div", {class: "loop"}, el("div", {class: "name"}, el("b", {}, name), late), plots.map(({node}) => node));
  row.parts = {plots, late};
  return row;
}

function fillLoop(row, loop, series) {
  const newest = [null, loop.rate_hz, loop.age_ms, loop.worst_lateness_ms, loop.p95_ms];
  row.parts.plots.forEach(({spark, value}, i) => {
    const {at, unit, digits, unknown} = PLOTS[i];
    say(value, quantity(newest[at], unit, digits, unknown));
    spark.set(series.samples.map(sample => [sample[0], sample[at]]));
  });
  const words = [loop.misses > 0 ? `${loop.misses} late` : "never late", loop.drops > 0 ? `${loop.drops} dropped` : "", quantity(loop.cpu === undefined ? null : loop.cpu * 100, "% of a core", 0, "")];
  say(row.parts.late, words.filter(Boolean).join(", "));
  row.classList.toggle("late", loop.misses > 0);
}
