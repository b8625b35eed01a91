import assert from "node:assert/strict";
import test from "node:test";
import {ellipse95, footprint, pointsOf, roundLength, toGeodetic, whiskers95, writeVertices, yawOf} from "../../flight/ground/page/geometry.js";
import {mergeMaps} from "../../flight/ground/page/merge.js";

const near = (a, b, within = 1e-9) => assert.ok(Math.abs(a - b) <= within, `${a} is not ${b}`);

test("the 95 % ellipse has half axes of 2.448 standard deviations", () => {
  const {a, b, angle} = ellipse95([0.04, 0, 0.01]);
  near(a, 2.4477 * 0.2, 1e-4);
  near(b, 2.4477 * 0.1, 1e-4);
  near(angle, 0);
});

test("the ellipse turns with its covariance", () => {
  const c = Math.cos(0.5), s = Math.sin(0.5);
  const turned = ellipse95([0.04 * c * c + 0.01 * s * s, 0.03 * s * c, 0.04 * s * s + 0.01 * c * c]);
  near(turned.angle, 0.5, 1e-6);
  near(turned.a / turned.b, 2, 1e-6);
});

test("without a covariance there is no ellipse", () => {
  assert.equal(ellipse95(undefined), null);
  assert.equal(ellipse95([0.01, null, 0.01]), null);
  assert.equal(ellipse95([0.01, 0.05, 0.01]), null);  // no covariance: correlation of 5
});

test("whiskers end where the size's 95 % interval does", () => {
  const all = whiskers95([4, 2], [0.1, 0.05]);
  assert.equal(all.length, 4);
  const [axis, sign, inner, outer] = all[0];
  assert.deepEqual([axis, sign], [0, 1]);
  near(2 * outer, 4 + 1.96 * 0.1);
  near(2 * inner, 4 - 1.96 * 0.1);
  assert.equal(whiskers95([4, 2], [0.1, undefined]).length, 2);
  assert.equal(whiskers95([4, 2], undefined).length, 0);
});

test("points are read at their offsets", () => {
  const data = Buffer.alloc(26);
  [1, 2, 3].forEach((v, i) => data.writeFloatLE(v, 13 + 4 * i));
  const cloud = {data: data.toString("base64"), point_stride: 13, fields: [{name: "x", offset: 0}, {name: "y", offset: 4}, {name: "z", offset: 8}, {name: "reflectivity", offset: 12}]};
  assert.deepEqual([...pointsOf(cloud)], [0, 0, 0, 1, 2, 3]);
});

test("a hundred metres north are a hundred metres of latitude", () => {
  const origin = {latitude_deg: 47, longitude_deg: 8, heading_deg: 0};
  const [longitude, latitude] = toGeodetic(origin, [100, 0]);
  near(longitude, 8);
  near((latitude - 47) * 111_177, 100, 0.05);  // a degree of latitude at 47° is 111,177 m
  const [east, same] = toGeodetic({...origin, heading_deg: 90}, [100, 0]);
  near(same, 47);
  near((east - 8) * 76_056, 100, 0.1);  // a degree of longitude at 47° is 76,056 m
});

test("a footprint turns with its heading", () => {
  const [frontLeft] = footprint({position: [10, 0, 0], size: [4, 2, 1], heading_rad: Math.PI / 2});
  near(frontLeft[0], 9);
  near(frontLeft[1], 2);
});

test("scale bars are round", () => {
  assert.deepEqual([7, 4, 1.9, 0.6, 120].map(roundLength), [5, 2, 1, 0.5, 100]);
});

const same = place => place;
const car = (id, x, sd, name = "vehicle") => ({id, class: name, shape: "cuboid", position: [x, 0, 0], size: [4, 2, 1.5], sd: {size: [sd, sd]}});

test("of an object of two robots the surer estimate stays", () => {
  const merged = mergeMaps([{robot: "R1", objects: [car(1, 0, 0.2), car(2, 9, 0.1)], toMap: same}, {robot: "R2", objects: [car(1, 0.5, 0.1)], toMap: same}]);
  assert.deepEqual(merged.map(({robot, robots}) => [robot, robots]), [["R2", ["R1", "R2"]], ["R1", ["R1"]]]);
});

test("another class, another place and one robot's two objects stay apart", () => {
  const merged = mergeMaps([{robot: "R1", objects: [car(1, 0, 0.2), car(2, 1, 0.2)], toMap: same}, {robot: "R2", objects: [car(1, 0, 0.1, "pole"), car(2, 4, 0.1)], toMap: same}]);
  assert.equal(merged.length, 4);
});

test("robots' frames are moved into one before they are compared", () => {
  const merged = mergeMaps([{robot: "R1", objects: [car(1, 0, 0.2)], toMap: same}, {robot: "R2", objects: [car(1, 50, 0.1)], toMap: ([x, y, z]) => [x - 50, y, z]}]);
  assert.equal(merged.length, 1);
});

test("the surer estimate stays with its own place", () => {
  const [{place, object}] = mergeMaps([{robot: "R1", objects: [car(1, 0, 0.2)], toMap: same}, {robot: "R2", objects: [car(2, 1, 0.1)], toMap: same}]);
  assert.equal(object.id, 2);
  assert.deepEqual(place, [1, 0, 0]);
});

test("a third robot finds the object where its surer estimate is", () => {
  const robot = (name, x, sd) => ({robot: name, objects: [car(1, x, sd)], toMap: same});
  const merged = mergeMaps([robot("R1", 1.4, 0.3), robot("R2", 2.8, 0.2), robot("R3", 4.2, 0.1)]);
  assert.deepEqual(merged.map(({robots}) => robots), [["R1", "R2", "R3"]]);
});

test("an estimate without a deviation is the least sure one", () => {
  const unsure = {...car(1, 0, 0), sd: undefined};
  const merged = mergeMaps([{robot: "R1", objects: [unsure], toMap: same}, {robot: "R2", objects: [car(2, 0.2, 0.5)], toMap: same}]);
  assert.equal(merged[0].robot, "R2");
});

test("a quarter's yaw is read from its quaternion", () => {
  near(yawOf([0, 0, Math.SQRT1_2, Math.SQRT1_2]), Math.PI / 2);
  near(yawOf([0, 0, 0, 1]), 0);
  near(yawOf([0, 0, Math.sin(-0.3), Math.cos(-0.3)]), -0.6);
});

test("a cloud that is cut has its whole points alone", () => {
  const cloud = {data: Buffer.alloc(30).toString("base64"), point_stride: 12, fields: [{name: "x", offset: 0}, {name: "y", offset: 4}, {name: "z", offset: 8}]};
  assert.equal(pointsOf(cloud).length, 6);
});

test("whiskers never go through the middle", () => {
  for (const [, , inner] of whiskers95([1, 1], [9, 9])) assert.equal(inner, 0);
});

test("the axes of an ellipse are a right angle, the longer one first", () => {
  const {a, b, angle} = ellipse95([0.01, 0, 0.04]);
  assert.ok(a > b);
  near(Math.abs(angle), Math.PI / 2);
});

/// The vertices of shapes with these matrices, of a triangle that lies across x and y.
function vertices(matrices, colours) {
  const unit = {position: [0.5, 0.5, 0, -0.5, 0.5, 0, 0, -0.5, 0], normal: [0, 0, 1, 0, 0, 1, 1, 0, 0]}, count = matrices.length / 16;
  const into = Object.fromEntries(["position", "normal", "color", "unitPlace", "unitNormal", "unitSize"].map(name => [name, new Float64Array(9 * count)]));
  writeVertices(unit, matrices, colours, count, into);
  return into;
}

const allNear = (found, wanted) => wanted.forEach((v, i) => assert.ok(Math.abs(found[i] - v) < 1e-12, `${i}: ${found[i]}, not ${v}`));

test("vertices of a shape are those of the unit shape, scaled, turned and moved", () => {
  // 4 along x and 2 along y, turned by a quarter (x is y, y is -x), moved to (10, 20, 30).
  const {position, unitPlace, unitSize} = vertices([0, 4, 0, 0, -2, 0, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1]);
  allNear(position, [9, 22, 30, 9, 18, 30, 11, 20, 30]);
  allNear(unitPlace, [0.5, 0.5, 0, -0.5, 0.5, 0, 0, -0.5, 0]);
  allNear(unitSize, [4, 2, 1, 4, 2, 1, 4, 2, 1]);
});

test("normals of a shape keep their length and stand on its faces, however it is stretched", () => {
  // The x axis goes to (3, 3, 0), the y axis to (-0.5, 0.5, 0).
  const {normal} = vertices([3, 3, 0, 0, -0.5, 0.5, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]);
  allNear(normal, [0, 0, 1, 0, 0, 1, Math.SQRT1_2, Math.SQRT1_2, 0]);
});

test("each shape has its own place and colour; without colours all are white", () => {
  const at = (x, size) => [size, 0, 0, 0, 0, size, 0, 0, 0, 0, size, 0, x, 0, 0, 1];
  const {position, color} = vertices([...at(1, 1), ...at(5, 2)], [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
  allNear(position.slice(9), [6, 1, 0, 4, 1, 0, 5, -1, 0]);
  allNear(color, [0.1, 0.2, 0.3, 0.1, 0.2, 0.3, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
  allNear(vertices(at(0, 1)).color, Array(9).fill(1));
});

test("a shape without size makes no number that is none", () => {
  const {position, normal} = vertices(Array(16).fill(0));
  assert.ok([...position, ...normal].every(Number.isFinite));
});
