import assert from "node:assert/strict";
import test from "node:test";
import {toCsv, toGeoJson, toJson} from "../../flight/ground/page/export.js";
import {SecondClick} from "../../flight/ground/page/orders.js";
import {linePath, range} from "../../flight/ground/page/plot.js";
import {chosenRows, rowOf, sortedRows} from "../../flight/ground/page/rows.js";

const CAR = {id: 3, class: "vehicle", shape: "cuboid", probability: 0.99, observations: 42, position: [6, -4, 0.8], size: [4.5, 1.9, 1.5], heading_rad: 0, sd: {size: [0.03, 0.02]}, target: {id: 12, state: "planned", tour: 2}};
const SURE = {...CAR, id: 4, size: [4.1, 1.8, 1.4], target: {id: 13, state: "next", tour: 0, reason: ""}};
const TRUNK = {id: 7, class: "trunk", shape: "cylinder", observations: 12, root: [3, 2, 0], axis: [0, 0, 1], radius: 0.17, height: 3.9, sd: {radius: 0.004}};
const ROWS = [CAR, SURE, TRUNK].map(object => rowOf("R1", object));
const ids = rows => rows.map(({id}) => id);

test("a cylinder's size is its diameter, with twice the radius's deviation", () => {
  assert.deepEqual(ROWS[2].size, [0.34, 0.34]);
  assert.deepEqual(ROWS[2].sd, [0.008, 0.008]);
});

test("rows are sorted by every column, both ways", () => {
  assert.deepEqual(ids(sortedRows(ROWS, "length", false)), [7, 4, 3]);
  assert.deepEqual(ids(sortedRows(ROWS, "length", true)), [3, 4, 7]);
  assert.deepEqual(ids(sortedRows(ROWS, "class", false)), [7, 3, 4]);
  assert.deepEqual(ids(sortedRows(ROWS, "seen", true)), [3, 4, 7]);
});

test("what is no target comes last both ways", () => {
  assert.deepEqual(ids(sortedRows(ROWS, "target", false)), [4, 3, 7]);
  assert.deepEqual(ids(sortedRows(ROWS, "target", true)), [3, 4, 7]);
});

test("rows are chosen by class and words", () => {
  assert.deepEqual(ids(chosenRows(ROWS, {classes: new Set(["trunk"])})), [7]);
  assert.deepEqual(ids(chosenRows(ROWS, {words: "place 3"})), [3]);
  assert.deepEqual(ids(chosenRows(ROWS, {words: " "})), [3, 4, 7]);
});

test("JSON holds the objects as they came", () => {
  assert.deepEqual(JSON.parse(toJson(ROWS)).objects[1], {robot: "R1", ...SURE});
});

test("CSV has a unit in every column's name and a row an object", () => {
  const [head, first] = toCsv(ROWS).split("\n").map(line => line.split(","));
  assert.equal(first[head.indexOf("length_m")], "4.5");
  assert.equal(first[head.indexOf("length_sd_m")], "0.03");
  assert.equal(first[head.indexOf("x_m")], "6");
  assert.equal(toCsv(ROWS).trim().split("\n").length, 4);
});

test("GeoJSON needs an origin; footprints are closed rings", () => {
  assert.equal(toGeoJson(ROWS, () => undefined), null);
  const {features} = JSON.parse(toGeoJson(ROWS, () => ({latitude_deg: 47, longitude_deg: 8, heading_deg: 90})));
  assert.deepEqual(features.map(({geometry}) => geometry.type), ["Polygon", "Polygon", "Point"]);
  const [ring] = features[0].geometry.coordinates;
  assert.equal(ring.length, 5);
  assert.deepEqual(ring[0], ring[4]);
  const [longitude, latitude] = features[2].geometry.coordinates;  // x to the east, y to the north
  assert.ok(longitude > 8 && latitude > 47);
});

test("an order is sent by the second click alone, in time, for the same robot and kind", () => {
  let ms = 0;
  const clicks = new SecondClick(() => ms);
  assert.equal(clicks.click("R1", "hold"), "ask");
  assert.equal(clicks.click("R1", "land"), "ask");
  assert.equal(clicks.click("R2", "land"), "ask");
  assert.equal(clicks.click("R2", "land"), "send");
  assert.equal(clicks.click("R2", "land"), "ask");
  ms = 5001;
  assert.equal(clicks.click("R2", "land"), "ask");
  clicks.forget();
  assert.equal(clicks.click("R2", "land"), "ask");
});

test("a line breaks where a value is not known", () => {
  const box = {begin: 0, end: 10, low: 0, high: 10, width: 100, height: 10};
  assert.equal(linePath([[0, 0], [5, 5], [6, null], [10, 10]], box), "M0.0 10.0L50.0 5.0M100.0 0.0");
});

test("a range has at least the width that is asked for", () => {
  assert.deepEqual(range([1, null, 1.1], 0.5).map(v => Number(v.toFixed(3))), [0.8, 1.3]);
  assert.equal(range([null, undefined]), null);
});

/// A reader of RFC 4180, of this test alone.
function fieldsOf(line) {
  return [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].slice(0, -1).map(([, field]) => (field.startsWith('"') ? field.slice(1, -1).replaceAll('""', '"') : field));
}

test("CSV keeps commas, quotes and carriage returns of words apart", () => {
  const row = rowOf("R1", {...CAR, class: 'van, "big"', target: {id: 1, state: "unreachable", reason: "no way,\rsaid R1"}});
  const fields = fieldsOf(toCsv([row]).slice(toCsv([]).length).replace(/\n$/, ""));
  assert.equal(fields.length, fieldsOf(toCsv([]).trim()).length);
  assert.equal(fields[2], 'van, "big"');
  assert.equal(fields.at(-1), "unreachable: no way,\rsaid R1");
});

test("CSV leaves what is not known empty", () => {
  const [head, row] = toCsv([rowOf("R1", {...TRUNK, sd: undefined})]).split("\n").map(line => line.split(","));
  assert.equal(row[head.indexOf("length_sd_m")], "");
  assert.equal(row[head.indexOf("probability")], "");
  assert.equal(row[head.indexOf("heading_rad")], "");
});

test("GeoJSON's ring is the footprint, counter-clockwise as RFC 7946 wants it", () => {
  const {features} = JSON.parse(toGeoJson([ROWS[0]], () => ({latitude_deg: 0, longitude_deg: 0, heading_deg: 90})));
  const [ring] = features[0].geometry.coordinates;
  const area = ring.slice(1).reduce((sum, [x, y], i) => sum + ring[i][0] * y - x * ring[i][1], 0) / 2;
  assert.ok(area > 0);
  assert.ok(Math.abs(area * 111_319 * 110_574 - 4.5 * 1.9) < 0.01, `${area}`);  // m a degree at the equator
});

test("GeoJSON of robots of which one has no origin is none", () => {
  assert.equal(toGeoJson([ROWS[0], rowOf("R2", CAR)], robot => (robot === "R1" ? {latitude_deg: 0, longitude_deg: 0, heading_deg: 0} : null)), null);
});

test("rows of one value keep the order of their ids, both ways", () => {
  const rows = [5, 2, 9].map(id => rowOf("R1", {...CAR, id}));
  assert.deepEqual(ids(sortedRows(rows, "length", false)), [2, 5, 9]);
  assert.deepEqual(ids(sortedRows(rows, "length", true)), [2, 5, 9]);
});

test("sorting changes nothing of what it was given", () => {
  const before = ids(ROWS);
  sortedRows(ROWS, "length", false);
  assert.deepEqual(ids(ROWS), before);
});
