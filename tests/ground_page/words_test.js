import assert from "node:assert/strict";
import test from "node:test";
import {duration, percent, quantity, times, withSd} from "../../flight/ground/page/format.js";
import {batteryWords, figureWords, situation, targetWords, verdictWords, waitingFor} from "../../flight/ground/page/words.js";

const plain = text => text.replaceAll("\u00a0", " ");

test("no number stands without its unit", () => {
  assert.equal(plain(quantity(3.14159, "m", 2)), "3.14 m");
  assert.equal(plain(quantity(-0.001, "m", 1)), "0.0 m");
  assert.equal(plain(quantity(-1.25, "m/s", 1)), "\u22121.3 m/s");
  assert.equal(plain(withSd(4.678, 0.051, "m")), "4.68 ± 0.05 m");
  assert.equal(plain(percent(0.814)), "81 %");
  assert.equal(plain(times(12)), "12 times");
  assert.equal(times(1), "once");
});

test("what is not known is said so", () => {
  for (const value of [null, undefined, NaN, Infinity]) assert.equal(quantity(value, "m"), "not known");
  assert.equal(plain(withSd(4.7, undefined, "m")), "4.70 m (± not computed)");
  assert.equal(duration(undefined, "not begun"), "not begun");
});

test("durations change their unit", () => {
  assert.deepEqual([5.25, 42, 125, 3725].map(s => plain(duration(s))), ["5.3 s", "42 s", "2 min 05 s", "1 h 02 min"]);
});

const robot = newest => ({name: "R1", newest});

test("what a robot does stands with its target", () => {
  const {title, level, waits, otherwise} = situation(robot({mission: {phase: "tour", target: 3, targets: 8, ladder: "none", waits_for: "nothing", if_it_goes_on: "it maps on"}}));
  assert.deepEqual([title, level, waits, otherwise], ["Flies its tour: target 3 of 8", "none", "nothing", "it maps on"]);
});

test("a hold says its cause and the vehicle's faults", () => {
  const {title, level, because} = situation(robot({mission: {phase: "hold", target: 1, targets: 2, ladder: "hold", text: "lidar_silent: no scan for 0.7 s"}, state: {faults: ["odometry_rejected"]}}));
  assert.equal(title, "Holds its place");
  assert.equal(level, "hold");
  assert.equal(because, "lidar silent: no scan for 0.7 s; the flight controller rejects the odometry");
});

test("a robot of which no mission was heard says so", () => {
  assert.equal(situation(robot({})).level, "unknown");
  assert.equal(waitingFor("R1", "objects", "here:8765"), "no data yet: waiting for R1_OBJECTS on here:8765");
});

test("a battery says what it is enough for, by the site's limits", () => {
  const limits = {battery_return_share: 0.3, battery_land_share: 0.15};
  assert.equal(plain(batteryWords(0.8, limits)), "returns at 30 %, lands at 15 %");
  assert.equal(batteryWords(0.29, limits), "enough for the way back");
  assert.equal(batteryWords(0.1, limits), "lands where it is");
  assert.equal(batteryWords(undefined, limits), "battery not known");
  assert.equal(batteryWords(0.8, undefined), "");
});

test("targets say their state, place and reason", () => {
  assert.equal(targetWords(undefined), "no target");
  assert.equal(targetWords({state: "planned", tour: 0, reason: ""}), "place 1 in the tour");
  assert.equal(targetWords({state: "unreachable", reason: "no way there"}), "unreachable: no way there");
});

test("verdicts are words", () => {
  assert.match(verdictWords(undefined), /nothing yet/);
  assert.match(verdictWords({clear: true, clearance_m: 0.8}), /clear to its end/);
  assert.equal(plain(verdictWords({clear: false, reason: "occupied", clear_for_s: 1.5})), "something is in the way; clear for 1.5 s");
});

test("figures of a run get the unit of their name", () => {
  assert.deepEqual(figureWords("mae_m", 0.1148).map(plain), ["mae", "0.115 m"]);
  assert.deepEqual(figureWords("found", 8).map(plain), ["found", "8 (count)"]);
  assert.deepEqual(figureWords("size_nees", 0.84).map(plain), ["size nees", "0.840 (ratio)"]);
  assert.equal(figureWords("errors", [1]), null);
});

test("a target that is done or out of the tour says so, and an unknown state itself", () => {
  assert.equal(targetWords({state: "done", reason: "seen"}), "done: seen");
  assert.equal(targetWords({state: "planned"}), "in the tour");
  assert.equal(targetWords({state: "asleep"}), "asleep");
});

test("a verdict without time left says its reason alone", () => {
  assert.equal(verdictWords({clear: false, reason: "stale_scan", clear_for_s: 0}), "the newest scan is too old");
});

test("an unknown phase and an unknown fault are said as they came", () => {
  const {title, because} = situation(robot({mission: {phase: "dance"}, state: {faults: ["tired"]}}));
  assert.equal(title, "dance");
  assert.equal(because, "tired");
});

test("figures are yes or no, words, counts and shares", () => {
  assert.deepEqual(figureWords("home_reached", true), ["home reached", "yes"]);
  assert.deepEqual(figureWords("scenario", "demo"), ["scenario", "demo"]);
  assert.deepEqual(figureWords("found_share", 0.875).map(plain), ["found", "88 %"]);
  assert.deepEqual(figureWords("flight_time_s", 61.25).map(plain), ["flight time", "61.3 s"]);
});

test("an hour is an hour, never sixty minutes", () => {
  assert.equal(plain(duration(3599.6)), "1 h 00 min");
  assert.equal(plain(duration(0)), "0.0 s");
});

test("never is said of nothing", () => {
  assert.deepEqual([times(0), times(undefined)], ["never", "never"]);
});
