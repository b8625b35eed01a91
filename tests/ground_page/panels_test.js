import assert from "node:assert/strict";
import test from "node:test";
import {Choices} from "../../flight/ground/page/choices.js";
import {Health} from "../../flight/ground/page/health.js";
import {Labels} from "../../flight/ground/page/labels.js";
import {Mission} from "../../flight/ground/page/mission.js";
import {Now} from "../../flight/ground/page/now.js";
import {Robots} from "../../flight/ground/page/robots.js";
import {Store} from "../../flight/ground/page/store.js";
import {made, plain} from "./made_document.js";

/// What panels are given: a store of what was said of R1, a clock, the choice of R1.
function given(said = {}, {mode = "live"} = {}) {
  const clock = {ms: 0}, store = new Store(() => clock.ms), choices = new Choices();
  for (const [kind, message] of Object.entries(said)) store.take(`/R1/${kind}`, message, 0);
  choices.robot = "R1";
  return {clock, parts: {store, choices, host: "here:8765", mode: () => mode}, store, choices, parent: made()};
}

function now(said, more) {
  const all = given(said, more), panel = new Now(all.parent, all.parts);
  panel.update();
  const tile = name => plain(all.parent.all(node => node.dataset.tile === name)[0].textContent);
  return {...all, panel, tile, text: () => plain(all.parent.textContent)};
}

const HOLD = {phase: "hold", target: 1, targets: 2, ladder: "hold", text: "lidar_silent: no scan", waits_for: "the end of: no scan", if_it_goes_on: "it lands 10 s after it began to hold"};

test("now: what it waits for and what then happens stand with the rung of the ladder", () => {
  const {parent, text} = now({mission: HOLD});
  assert.match(text(), /Holds its place/);
  assert.match(text(), /Waits for the end of: no scan/);
  assert.match(text(), /If that goes on, it lands 10 s after/);
  assert.equal(parent.dataset.level, "hold");
  const marked = parent.all(node => node.getAttribute("aria-current") !== null);
  assert.deepEqual(marked.map(({dataset}) => dataset.level), ["hold"]);
});

test("now: without trouble the level is ok", () => {
  assert.equal(now({mission: {...HOLD, phase: "tour", ladder: "none"}}).parent.dataset.level, "ok");
});

test("now: before any robot is heard that is what is said", () => {
  const all = given();
  all.choices.robot = null;
  new Now(all.parent, all.parts).update();
  assert.match(all.parent.textContent, /No robot heard yet/);
  assert.equal(all.parent.dataset.level, "unknown");
});

test("now: numbers that were never heard are no zeros", () => {
  const {tile} = now({mission: HOLD});
  for (const name of ["battery", "height", "speed", "clearance", "link"]) assert.match(tile(name), /no data yet/, name);
});

test("now: the tiles say what was heard, with units", () => {
  const {tile} = now({state: {battery_share: 0.814, height_m: 3.04}, odometry: {position: [0, 0, 2], speed_mps: 0.52, status: "ok", sd_m: [0.03, 0, 0.04]}, verdict: {clear: true, clearance_m: 0.8},
    link: {age_s: 0.12, lost: false, message_rate_hz: 151, malformed: 2}});
  assert.match(tile("battery"), /81 %/);
  assert.match(tile("height"), /3\.0 m/);
  assert.match(tile("speed"), /0\.5 m\/s.*place ± 0\.05 m/);
  assert.match(tile("clearance"), /0\.80 m.*way clear/);
  assert.match(tile("link"), /0\.12 s.*151 msg\/s, 2 unreadable/);
});

test("now: without a barometer the height is the odometry's", () => {
  assert.match(now({state: {battery_share: 1}, odometry: {position: [0, 0, 2.5], status: "lost"}}).tile("height"), /2\.5 m/);
});

test("now: odometry that is lost is said instead of how sure it is", () => {
  assert.match(now({odometry: {position: [0, 0, 2], status: "lost", sd_m: [1, 1, 1]}}).tile("speed"), /odometry lost/);
});

test("now: what is old says how old, live", () => {
  const {clock, panel, tile} = now({state: {battery_share: 0.5}});
  assert.doesNotMatch(tile("battery"), /old/);
  clock.ms = 3000;
  panel.update();
  assert.match(tile("battery"), /3\.0 s old/);
});

test("now: of a run nothing is old, and there is no link", () => {
  const {clock, panel, parent, tile} = now({state: {battery_share: 0.5}}, {mode: "run"});
  clock.ms = 60000;
  panel.update();
  assert.doesNotMatch(tile("battery"), /old/);
  assert.equal(parent.all(node => node.dataset.tile === "link")[0].hidden, true);
});

test("now: a robot that is not heard is said first", () => {
  const {text} = now({mission: HOLD, link: {lost: true, age_s: 4}});
  assert.match(text(), /R1 is not heard: holds its place when it was heard last/);
  assert.match(text(), /lost: nothing is heard/);
});

function mission(said) {
  const all = given(said), gone = [], panel = new Mission(all.parent, {...all.parts, goTo: (robot, id) => gone.push([robot, id])});
  panel.update();
  return {...all, panel, gone, text: () => plain(all.parent.textContent)};
}

const TARGET = (id, state, more = {}) => ({id, class: "vehicle", shape: "cuboid", position: [0, 0, 0], size: [4, 2, 1], target: {id, state, reason: "", ...more}});

test("mission: phases before the present one are past, later ones are not", () => {
  const {parent} = mission({mission: {phase: "tour", targets: 8, target: 3}});
  const phases = parent.all(node => node.dataset.phase !== undefined);
  assert.deepEqual(phases.filter(node => node.classList.contains("past")).map(({dataset}) => dataset.phase), ["preflight", "arming", "takeoff"]);
  assert.deepEqual(phases.filter(node => node.getAttribute("aria-current") !== null).map(({dataset}) => dataset.phase), ["tour"]);
});

test("mission: targets stand in the order of what became of them, and lead to their object", () => {
  const {parent, gone} = mission({mission: {phase: "tour"}, objects: {objects: [TARGET(1, "planned", {tour: 1}), TARGET(2, "done"), TARGET(3, "next"), TARGET(4, "planned", {tour: 0}), {id: 9, shape: "cuboid", size: [1, 1, 1], position: [0, 0, 0]}]}});
  const buttons = parent.byClass("targets")[0].children;
  assert.deepEqual(buttons.map(({dataset}) => dataset.key), ["2", "3", "4", "1"]);
  assert.match(buttons[0].title, /^vehicle 2: done/);
  buttons[1].click();
  assert.deepEqual(gone, [["R1", 3]]);
});

test("mission: viewpoints are weighed by gain, the chosen one says so", () => {
  const candidates = [{target_id: 4, gain_nat: 1, path_m: 7}, {target_id: 5, gain_nat: 2.5, path_m: 3, chosen: true}, {target_id: -1}];
  const {text} = mission({mission: {phase: "tour"}, plan: {candidates, refused: [{reason: "occupied"}, {reason: "unknown"}, {reason: "occupied"}]}});
  assert.match(text(), /target 5: 2\.50 nat, 3\.0 m to fly — chosentarget 4: 1\.00 nat.*stop of the sweep: gain not computed, no way there/);
  assert.match(text(), /2 viewpoints: occupied1 viewpoint: unknown/);
});

test("mission: two figures of one name are two, each with its value", () => {
  const {panel, parent, text} = mission({mission: {phase: "done"}, figures: {error_m: 0.25, error_rad: 0.5}});
  for (let i = 0; i < 3; ++i) panel.update();
  assert.match(text(), /error0\.250 merror0\.500 rad/);
  assert.equal(parent.all(({textContent, children}) => textContent === "error" && !children.length).length, 2);
});

test("mission: orders say who gave them, what came of them, and how soon", () => {
  const {text} = mission({orders: {id: 3, t_s: 0, kind: "land", by: "10.0.0.7", state: "refused", text: "lands already", took_s: 0.31}});
  assert.match(text(), /land by 10\.0\.0\.7: refused after 0\.3 s, lands already/);
});

test("mission: the newest word of the log comes first, with its level", () => {
  const {store, panel, parent} = mission({});
  store.take("/R1/log", {message: "armed", level: 2}, 5);
  store.take("/R1/log", {message: "link is lost", level: 4}, 12);
  panel.update();
  const [first, second] = parent.byClass("log")[0].children;
  assert.equal(plain(first.textContent), "7.0 s  link is lost");
  assert.equal(first.className, "bad");
  assert.equal(plain(second.textContent), "0.0 s  armed");
});

test("mission: nothing heard is said, with what is waited for", () => {
  assert.match(mission({state: {}}).text(), /waiting for R1_MISSION on here:8765/);
});

const LOOP = {name: "slam", rate_hz: 2, misses: 0, age_ms: 40, drops: 0, cpu: 0.31};

test("health: every loop of every process with its figures; those it has not are said", () => {
  const all = given({health: {process: "saker-flight", loops: [LOOP, {name: "planner", misses: 3, drops: 1}], counters: {scan_drops: 7}}});
  new Health(all.parent, all.parts).update();
  const [slam, planner] = all.parent.byClass("loop").map(({textContent}) => plain(textContent));
  assert.match(slam, /^slamnever late, 31 % of a corerate2\.0 Hzinput's age40 msworst latenessno deadline/);
  assert.match(planner, /^planner3 late, 1 droppedrateon arrival/);
  assert.match(all.parent.textContent, /counts: scan drops: 7/);
});

test("health: the ages of channels are shown, those over three seconds marked", () => {
  const all = given({health: {process: "p", loops: []}, link: {age_s: 0.1, lost: false, channels: {STATE: 0.1, PLAN: 7.25}}});
  new Health(all.parent, all.parts).update();
  assert.match(plain(all.parent.textContent), /R1_STATE0\.10 sR1_PLAN7\.25 s/);
  assert.deepEqual(all.parent.byClass("old").filter(({tagName}) => tagName === "B").map(node => plain(node.textContent)), ["7.25 s"]);
});

test("health: before a process is heard that is said", () => {
  const all = given({state: {}});
  new Health(all.parent, all.parts).update();
  assert.match(all.parent.textContent, /waiting for R1_HEALTH/);
});

function fleet(names, more = {}, parts = {}) {
  const all = given({}, more), view = {mergedMap: []};
  for (const name of names) all.store.know(`/${name}/state`);
  const bar = all.parent, panel = document.createElement("section");
  const robots = new Robots({bar, panel, store: all.store, choices: all.choices, view, mode: all.parts.mode, ...parts});
  robots.update();
  return {...all, view, panel, robots, chips: () => bar.byClass("chip")};
}

test("robots: a chip each, in the order of their names; a click chooses", () => {
  const {chips, choices} = fleet(["R10", "R2", "R1"]);
  assert.deepEqual(chips().map(({dataset}) => dataset.key), ["R1", "R2", "R10"]);
  chips()[1].click();
  assert.equal(choices.robot, "R2");
});

/// What the base's section says, a line each; null: it is not shown.
function told(base, now_s = 1000) {
  const {store, robots, panel} = fleet(["R1"], {}, {clock: () => now_s});
  if (base) store.take("/store", base, 0);
  robots.update();
  return robots.base.hidden ? null : panel.byClass("told")[0].children.map(node => plain(node.textContent));
}

test("robots: without a base nothing is said of one", () => assert.equal(told(null), null));

test("robots: the base says who told what, and when", () => {
  const streams = [{kind: "history", version: 3, bytes: 41200, gaps: 0, came_s: 940}, {kind: "prior_map", version: 1, bytes: 900, gaps: 2}];
  assert.deepEqual(told({file_bytes: 1, robots: [{name: "R1", heard_s: 988, streams}, {name: "R2", streams: []}]}), [
    "R1: in contact 12 s ago", "R1, flight 3: 41.2 kB, more came 1 min 00 s ago", "R1, prior map 1: 0.9 kB, 2 pieces after a gap", "R2: never in contact, told nothing yet"]);
});

test("robots: a base that holds nothing says so", () => assert.deepEqual(told({file_bytes: 1, robots: []}), ["nothing yet"]));

test("robots: the first one is chosen where the chosen one is not there", () => {
  const {choices} = fleet(["R7", "R3"]);
  assert.equal(choices.robot, "R3");
});

test("robots: a chip says phase and battery, or that it is not heard", () => {
  const {chips, robots, store} = fleet(["R1"]);
  assert.match(chips()[0].textContent, /waiting/);
  store.take("/R1/mission", {phase: "tour"}, 0);
  store.take("/R1/state", {battery_share: 0.5}, 0);
  robots.update();
  assert.match(plain(chips()[0].textContent), /tour, 50 %/);
  store.take("/R1/link", {lost: true}, 0);
  robots.update();
  assert.match(chips()[0].textContent, /not heard/);
  assert.ok(chips()[0].classList.contains("lost"));
});

test("robots: maps are merged where there are several robots alone", () => {
  const one = fleet(["R1"]), two = fleet(["R1", "R2"]);
  const fader = panel => panel.all(({tagName}) => tagName === "SECTION")[0];
  assert.equal(fader(one.panel).hidden, true);
  assert.equal(fader(two.panel).hidden, false);
});

test("robots: the slider is a share, and the objects that several saw are counted", () => {
  const {panel, choices, view, robots} = fleet(["R1", "R2"]);
  const [slider] = panel.all(({tagName}) => tagName === "INPUT");
  slider.value = 50;
  slider.fire("input");
  assert.equal(choices.merged, 0.5);
  view.mergedMap = [{robots: ["R1", "R2"]}, {robots: ["R1"]}];
  robots.update();
  assert.match(panel.textContent, /2 objects, 1 of them seen by several robots/);
});

test("labels: what is behind the camera is not shown, nodes are used again", () => {
  const parent = made(), labels = new Labels(parent, {toScreen: point => (point === "behind" ? null : [10, 20])});
  labels.set([{point: "here", text: "R1", kind: "robot", colour: "#123"}, {point: "behind", text: "R2", kind: "robot"}]);
  const [one, two] = parent.children;
  assert.deepEqual([one.textContent, one.hidden, two.hidden], ["R1", false, true]);
  assert.equal(one.style.transform, "translate(10.0px, 20.0px)");
  labels.set([{point: "here", text: "3", kind: "stop"}]);
  assert.equal(parent.children.length, 2);
  assert.deepEqual([one.textContent, one.className, two.hidden], ["3", "label stop", true]);
});
