import assert from "node:assert/strict";
import test from "node:test";
import {Choices, LAYERS} from "../../flight/ground/page/choices.js";
import {CLASSES, LEVELS, ofClass, ofRobot} from "../../flight/ground/page/colours.js";
import {linePath, plot, range, Spark} from "../../flight/ground/page/plot.js";
import {RUNGS} from "../../flight/ground/page/words.js";
import {made} from "./made_document.js";

const BOX = {begin: 0, end: 10, low: 0, high: 4, width: 100, height: 40};

test("the highest value is drawn on top, the lowest at the bottom", () => {
  assert.equal(linePath([[0, 4], [10, 0]], BOX), "M0.0 0.0L100.0 40.0");
});

test("nothing known, nothing drawn", () => {
  assert.equal(linePath([[0, null], [1, undefined], [2, NaN]], BOX), "");
});

test("one moment is no division by nothing", () => {
  assert.doesNotMatch(linePath([[5, 1]], {...BOX, begin: 5, end: 5, low: 1, high: 1}), /NaN|Infinity/);
});

test("a range holds what is known, infinities not", () => {
  assert.deepEqual(range([3, null, Infinity, -1, NaN]), [-1, 3]);
});

test("a range is not narrowed", () => {
  assert.deepEqual(range([0, 10], 1), [0, 10]);
});

test("a spark stands on zero and clears itself", () => {
  made();
  const spark = new Spark({width: 10, height: 10, least: 1});
  spark.set([[0, 2], [1, 4]]);
  assert.equal(spark.line.getAttribute("d"), "M0.0 5.0L10.0 0.0");
  spark.set([]);
  assert.equal(spark.line.getAttribute("d"), "");
});

test("a plot says its unit at the bottom, the middle and the top of what it shows", () => {
  made();
  const svg = plot([{name: "length", samples: [[0, 4, 0], [10, 5, 0]]}], {unit: "m"});
  const words = svg.all(({tagName}) => tagName === "TEXT").map(({textContent}) => textContent);
  assert.deepEqual(words, ["3.92 m", "4.50 m", "5.08 m", "10 s before", "newest"]);  // 8 % of room above and below
});

test("the band is one standard deviation to both sides, closed", () => {
  made();
  const svg = plot([{name: "length", samples: [[0, 4, 1], [10, 4, 1]]}], {width: 160, height: 128});
  const [band] = svg.byClass("band");
  const heights = [...band.getAttribute("d").matchAll(/ (-?[\d.]+)/g)].map(([, y]) => Number(y));
  const [up, , , down] = heights;
  assert.ok(band.getAttribute("d").endsWith("Z"));
  assert.ok(Math.abs((up + down) / 2 - 50) < 0.1, `${heights}`);  // the value itself, in the middle of 100 px
  assert.ok(Math.abs(down - up - 100 / 1.16) < 0.2, `${heights}`);  // 2 m of 2.32 m that are shown
});

test("a plot of nothing is empty", () => {
  made();
  assert.equal(plot([{name: "a", samples: []}]).children.length, 0);
});

test("a choice is told to all who listen, with what changed alone", () => {
  const choices = new Choices(), told = [];
  choices.on(what => told.push(what));
  choices.on(what => told.push(what));
  choices.set({robot: "R2"});
  assert.deepEqual(told, [{robot: "R2"}, {robot: "R2"}]);
  assert.equal(choices.robot, "R2");
});

test("heavy layers are off at first, the others on; a toggle turns one", () => {
  const choices = new Choices();
  assert.deepEqual(LAYERS.map(({name}) => name).filter(name => !choices.layers[name]), ["occupancy", "points"]);
  choices.toggle("points");
  assert.equal(choices.layers.points, true);
  assert.equal(choices.layers.path, true);
});

test("classes differ in their mark, not in colour alone; unknown ones have one, too", () => {
  const glyphs = [...Object.values(CLASSES), ofClass("boat")].map(({glyph}) => glyph);
  assert.equal(new Set(glyphs).size, glyphs.length);
});

test("six robots differ in colour; the seventh begins anew", () => {
  const colours = [0, 1, 2, 3, 4, 5].map(ofRobot);
  assert.equal(new Set(colours).size, 6);
  assert.equal(ofRobot(6), ofRobot(0));
});

test("every rung of the safety ladder has its colour", () => {
  for (const {level} of RUNGS) assert.ok(LEVELS[level === "none" ? "ok" : level], level);
});

/// Relative luminance and contrast by WCAG 2.1: words are read on white from 4.5 on.
test("levels can be read on white", () => {
  for (const [name, colour] of Object.entries(LEVELS)) {
    const [r, g, b] = [1, 3, 5].map(i => parseInt(colour.slice(i, i + 2), 16) / 255).map(c => (c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    assert.ok(1.05 / (0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05) >= 4.5, name);
  }
});
