/// What the chosen robot does now, in plain words, with the rung of the safety ladder and the numbers that a pilot looks at first.

import {LEVELS} from "./colours.js";
import {el, say, show} from "./dom.js";
import {duration, percent, quantity} from "./format.js";
import {Spark} from "./plot.js";
import {batteryWords, RUNGS, situation, verdictWords, waitingFor} from "./words.js";

const OLD_S = 1.5;

export class Now {
  constructor(parent, {store, choices, host, mode}) {
    Object.assign(this, {store, choices, host, mode});
    this.title = el("h1", {});
    this.because = el("p", {class: "because"});
    this.waits = el("p", {}, el("span", {class: "what"}, "Waits for "), this.waitsText = el("b", {}));
    this.otherwise = el("p", {}, el("span", {class: "what"}, "If that goes on, "), this.otherwiseText = el("b", {}));
    this.ladder = el("ol", {class: "ladder", "aria-label": "Safety ladder"}, RUNGS.map(({level, name, does}) => el("li", {"data-level": level, title: does}, name)));
    this.tiles = Object.fromEntries(["battery", "height", "speed", "clearance", "link"].map(name => [name, tile(name)]));
    parent.append(el("div", {class: "words", "aria-live": "polite"}, this.title, this.waits, this.otherwise, this.because), this.ladder,
      el("div", {class: "tiles"}, Object.values(this.tiles).map(({node}) => node)));
    this.parent = parent;
  }

  update() {
    const robot = this.store.robots.get(this.choices.robot);
    if (!robot) {
      this.parent.dataset.level = "unknown";
      say(this.title, "No robot heard yet");
      say(this.because, `no data yet: waiting for any robot's STATE, ODOMETRY, OBJECTS on ${this.host}`);
      for (const node of [this.waits, this.otherwise, this.ladder]) show(node, false);
      return;
    }
    const words = situation(robot), lost = this.#lost(robot);
    this.parent.dataset.level = words.level === "none" ? "ok" : words.level;
    this.parent.style.setProperty("--level", LEVELS[this.parent.dataset.level] ?? LEVELS.unknown);
    say(this.title, lost ? `${robot.name} is not heard: ${words.title.toLowerCase()} when it was heard last` : words.title);
    say(this.waitsText, words.waits);
    say(this.otherwiseText, words.otherwise);
    show(this.waits, words.waits !== "");
    show(this.otherwise, words.otherwise !== "");
    say(this.because, robot.newest.mission ? (words.because ? `Last: ${words.because}` : "") : waitingFor(robot.name, "mission", this.host));
    this.#ladder(words.level);
    this.#tiles(robot);
  }

  #lost(robot) {
    return this.mode() === "live" && robot.newest.link?.lost === true;
  }

  #ladder(level) {
    show(this.ladder, level !== "unknown");
    for (const rung of this.ladder.children) rung.toggleAttribute("aria-current", rung.dataset.level === level);
  }

  #tiles(robot) {
    const {state, odometry, verdict, link, site} = robot.newest, live = this.mode() === "live";
    const old = kind => (live && this.store.age_s(robot.name, kind) > OLD_S ? `${duration(this.store.age_s(robot.name, kind))} old` : "");
    this.#tile("battery", percent(state?.battery_share, "no data yet"), old("state") || batteryWords(state?.battery_share, site?.limits), robot.battery.samples);
    this.#tile("height", quantity(state?.height_m ?? odometry?.position[2], "m", 1, "no data yet"), old("state") || "above the take-off", robot.height.samples);
    this.#tile("speed", quantity(odometry?.speed_mps, "m/s", 1, "no data yet"), old("odometry") || odometryWords(odometry), null);
    this.#tile("clearance", quantity(verdict?.clearance_m, "m", 2, "no data yet"), old("verdict") || verdictWords(verdict), null);
    show(this.tiles.link.node, live);
    this.#tile("link", live ? quantity(link?.age_s, "s", 2, "no data yet") : "none", live ? linkWords(link) : "", robot.link.samples);
  }

  #tile(name, value, sub, samples) {
    const {value: text, sub: below, spark} = this.tiles[name];
    say(text, value);
    say(below, sub);
    if (samples) spark.set(samples);
    show(spark.node, Boolean(samples?.length > 1));
  }
}

function tile(name) {
  const value = el("b", {}), sub = el("small", {}), spark = new Spark({width: 72, height: 16, least: name === "link" ? 0.5 : 5});
  return {node: el("div", {class: "tile", "data-tile": name}, el("span", {}, name), value, sub, spark.node), value, sub, spark};
}

function odometryWords(odometry) {
  if (!odometry) return "";
  const sd = odometry.sd_m?.every(Number.isFinite) ? `place ± ${quantity(Math.hypot(...odometry.sd_m), "m", 2)}` : "place ± not known";
  return odometry.status === "ok" ? sd : `odometry ${odometry.status}`;
}

function linkWords(link) {
  if (!link) return "";
  if (link.lost) return "lost: nothing is heard";
  return `${quantity(link.message_rate_hz, "msg/s", 0)}${link.malformed ? `, ${link.malformed} unreadable` : ""}`;
}
