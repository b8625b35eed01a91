import assert from "node:assert/strict";
import test from "node:test";
import {KEPT, Series, Store} from "../../flight/ground/page/store.js";

const car = (id, length, more = {}) => ({id, class: "vehicle", shape: "cuboid", position: [0, 0, 0], size: [length, 1.8, 1.5], sd: {size: [0.1, 0.05]}, ...more});

test("robots are known by their channels, in the order of their names", () => {
  const store = new Store();
  for (const name of ["R10", "R2", "R1"]) store.know(`/${name}/objects`);
  assert.deepEqual(store.names(), ["R1", "R2", "R10"]);
});

test("the newest map replaces the one before", () => {
  const store = new Store();
  store.take("/R1/objects", {objects: [car(1, 4), car(2, 4)]}, 1);
  store.take("/R1/objects", {objects: [car(2, 5)]}, 2);
  assert.deepEqual([...store.robots.get("R1").objects.keys()], [2]);
});

test("an object's size is kept over time where it changes", () => {
  const store = new Store();
  for (const [t, length] of [[1, 4], [2, 4], [3, 4.2]]) store.take("/R1/objects", {objects: [car(1, length)]}, t);
  assert.deepEqual(store.robots.get("R1").sizes.get(1).samples, [[1, 4, 1.8, 0.1, 0.05], [3, 4.2, 1.8, 0.1, 0.05]]);
});

test("going back in a run forgets what came after", () => {
  const store = new Store();
  for (const [t, length] of [[1, 4], [5, 4.2], [2, 4.1]]) store.take("/R1/objects", {objects: [car(1, length)]}, t);
  assert.deepEqual(store.robots.get("R1").sizes.get(1).samples.map(([t]) => t), [1, 2]);
});

test("older sizes from the server come before ours", () => {
  const store = new Store();
  store.take("/R1/objects", {objects: [car(1, 4)]}, 10);
  store.robots.get("R1").seedSizes(1, [{t_s: 8, message: {objects: [car(1, 3)]}}, {t_s: 9, message: {objects: []}}, {t_s: 11, message: {objects: [car(1, 9)]}}]);
  assert.deepEqual(store.robots.get("R1").sizes.get(1).samples.map(([t, length]) => [t, length]), [[8, 3], [10, 4]]);
});

test("a target's id means the object mapped there, or the prior one", () => {
  const store = new Store();
  store.take("/R1/site", {prior: {objects: [{id: 100, position: [1, 1, 0]}, {id: 101, position: [2, 2, 0]}]}}, 0);
  store.take("/R1/objects", {objects: [car(7, 4, {target: {id: 100, state: "next"}})]}, 1);
  const robot = store.robots.get("R1");
  assert.equal(robot.target(100).id, 7);
  assert.deepEqual(robot.target(101).position, [2, 2, 0]);
  assert.equal(robot.target(102), undefined);
});

test("loops' figures are kept by process and loop", () => {
  const store = new Store();
  store.take("/R1/health", {process: "saker-flight", loops: [{name: "slam", rate_hz: 2, age_ms: 40, misses: 0}]}, 1);
  assert.deepEqual(store.robots.get("R1").loops.get("saker-flight/slam").samples, [[1, 2, 40, null, null]]);
});

test("a series has an end", () => {
  const series = new Series();
  for (let t = 0; t < KEPT + 10; ++t) series.add(t, t);
  assert.equal(series.samples.length, KEPT);
  assert.equal(series.samples[0][0], 10);
});

test("changes are taken once, ages are our clock's", () => {
  let ms = 0;
  const store = new Store(() => ms);
  store.take("/R1/state", {battery_share: 0.5, height_m: 1}, 0);
  assert.deepEqual([...store.takeChanges()].sort(), ["/R1/state", "robots"]);
  assert.equal(store.takeChanges().size, 0);
  ms = 2500;
  assert.equal(store.age_s("R1", "state"), 2.5);
  assert.equal(store.age_s("R1", "mission"), null);
  assert.deepEqual(store.robots.get("R1").battery.samples, [[0, 50]]);
});

test("going back in a run forgets what was not yet", () => {
  const store = new Store(), car3 = car(3, 4);
  store.take("/playback", {t_s: 110}, 110);
  for (const [kind, message] of Object.entries({mission: {phase: "done"}, verdict: {clear: true}, objects: {objects: [car3]}, site: {prior: {objects: [car(9, 4)]}}, state: {battery_share: 0.5}})) store.take(`/R1/${kind}`, message, 110);
  store.takeChanges();
  store.take("/playback", {t_s: 101}, 101);
  const robot = store.robots.get("R1");
  assert.deepEqual(Object.keys(robot.newest), ["site"]);
  assert.equal(robot.objects.size, 0);
  assert.deepEqual(robot.battery.samples, []);
  assert.deepEqual([...store.takeChanges()].sort(), ["/R1/mission", "/R1/objects", "/R1/state", "/R1/verdict", "/playback"]);
});

test("going back keeps what was said of then, whichever came first", () => {
  const store = new Store();
  store.take("/playback", {t_s: 110}, 110);
  store.take("/R1/verdict", {clear: true}, 100);
  store.take("/R1/odometry", {status: "ok"}, 101);
  store.take("/playback", {t_s: 101}, 101);
  assert.deepEqual(Object.keys(store.robots.get("R1").newest).sort(), ["odometry", "verdict"]);
});

test("going on in a run forgets nothing", () => {
  const store = new Store();
  store.take("/playback", {t_s: 101}, 101);
  store.take("/R1/mission", {phase: "tour"}, 101);
  store.take("/playback", {t_s: 110}, 110);
  store.take("/playback", {t_s: 110}, 110);
  assert.equal(store.robots.get("R1").newest.mission.phase, "tour");
});

/// The answer of `seek` is there before the message: the panel writes it into the store.
test("going back is noticed though the service's answer came first", () => {
  const store = new Store();
  store.take("/playback", {t_s: 110}, 110);
  store.take("/R1/mission", {phase: "done"}, 110);
  store.playback = {t_s: 101};
  store.take("/playback", {t_s: 101}, 101);
  assert.equal(store.robots.get("R1").newest.mission, undefined);
});

test("what was said before comes again after going back, once", () => {
  const store = new Store();
  store.take("/playback", {t_s: 110}, 110);
  for (const t of [101, 101.2]) store.take("/R1/log", {message: `at ${t}`}, t);
  store.take("/playback", {t_s: 101.3}, 101.3);
  for (const t of [101, 101.2]) store.take("/R1/log", {message: `at ${t}`}, t);
  assert.deepEqual(store.robots.get("R1").log.map(({message}) => message), ["at 101", "at 101.2"]);
});

test("a log has an end", () => {
  const store = new Store();
  for (let t = 0; t < 250; ++t) store.take("/R1/log", {message: String(t)}, t);
  const {log} = store.robots.get("R1");
  assert.equal(log.length, 200);
  assert.equal(log.at(-1).message, "249");
});

test("an order is one, whatever is said of it", () => {
  const store = new Store();
  for (const state of ["sent", "acknowledged"]) store.take("/R1/orders", {id: 4, state}, 0);
  assert.deepEqual([...store.robots.get("R1").orders.values()].map(({state}) => state), ["acknowledged"]);
});

test("a topic of no robot makes none", () => {
  const store = new Store();
  store.take("/playback", {t_s: 1}, 1);
  assert.equal(store.know("/status"), null);
  assert.deepEqual(store.names(), []);
});

test("what is not known of the vehicle is a gap, no zero", () => {
  const store = new Store();
  store.take("/R1/state", {}, 1);
  store.take("/R1/link", {}, 1);
  const {battery, height, link} = store.robots.get("R1");
  assert.deepEqual([battery, height, link].map(({samples}) => samples), [[[1, null]], [[1, null]], [[1, null]]]);
});

test("what the base holds is no robot's", () => {
  const store = new Store();
  assert.equal(store.know("/store"), null);
  store.take("/store", {file_bytes: 5, robots: []}, 1);
  assert.deepEqual(store.base, {file_bytes: 5, robots: []});
  assert.equal(store.robots.size, 0);
  assert.ok(store.takeChanges().has("/store"));
});
