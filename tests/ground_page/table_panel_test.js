import assert from "node:assert/strict";
import test from "node:test";
import {Choices} from "../../flight/ground/page/choices.js";
import {Store} from "../../flight/ground/page/store.js";
import {Table} from "../../flight/ground/page/table.js";
import {made, plain} from "./made_document.js";

const car = (id, length, more = {}) => ({id, class: "vehicle", shape: "cuboid", probability: 0.98, observations: 12, position: [1, 2, 0.75], size: [length, 1.8, 1.5], sd: {size: [0.03, 0.02], position: [0.01, 0.02]}, ...more});
const trunk = id => ({id, class: "trunk", shape: "cylinder", observations: 1, root: [3, 2, 0], axis: [0, 0, 1], radius: 0.17, height: 3.9});

/// A table of these objects of R1, 400 px high: ten rows of 40 px.
function table(objects) {
  const parent = made(), store = new Store(() => 0), choices = new Choices(), gone = [];
  choices.robot = "R1";
  store.take("/R1/objects", {objects}, 1);
  const goTo = (robot, id) => {
    gone.push(id);
    choices.set({object: {robot, id}});
  };
  const panel = new Table(parent, {store, choices, goTo, history: () => null, host: "here:8765"});
  panel.update();
  const shown = () => parent.byClass("rows")[0].children.filter(({hidden}) => !hidden);
  const key = name => parent.byClass("scroller")[0].fire("keydown", {key: name});
  return {parent, store, choices, panel, gone, shown, key, text: () => plain(parent.textContent)};
}

const many = count => Array.from({length: count}, (_, i) => car(i, 4));

test("of ten thousand objects the rows in sight are made, no more", () => {
  const {parent, shown} = table(many(10000));
  assert.ok(shown().length >= 10 && shown().length <= 30, `${shown().length}`);
  assert.equal(parent.byClass("rows")[0].style.height, "400000px");
});

test("scrolled, the rows are those of there", () => {
  const {parent, shown} = table(many(1000)), [scroller] = parent.byClass("scroller");
  scroller.scrollTop = 20000;
  scroller.fire("scroll");
  const ids = shown().map(({dataset}) => Number(dataset.id));
  assert.ok(ids.includes(500) && ids.includes(509), ids.join());
  assert.ok(!ids.includes(0));
});

test("a row says size with its deviation, how often it was seen, and the target's state", () => {
  const {shown} = table([car(3, 4.5, {target: {id: 9, state: "next"}}), trunk(4)]);
  const [one, two] = shown().map(({textContent}) => plain(textContent));
  assert.match(one, /vehicle 34\.50 ± 0\.03 m × 1\.80 ± 0\.02 m12 timesflown to now/);
  assert.match(two, /trunk 4⌀ 0\.34 m \(± not computed\)onceno target/);
});

test("a column's name sorts by it, again the other way", () => {
  const {parent, shown} = table([car(1, 5), car(2, 4), car(3, 4.5)]);
  const [head] = parent.all(({dataset}) => dataset.column === "length");
  const ids = () => shown().map(({dataset}) => dataset.id).join("");
  head.click();
  assert.equal(ids(), "231");
  assert.equal(head.getAttribute("aria-sort"), "ascending");
  head.click();
  assert.equal(ids(), "132");
  assert.equal(head.getAttribute("aria-sort"), "descending");
});

test("words that are searched for choose rows, and how many of how many is said", () => {
  const {parent, shown, text} = table([car(1, 5), trunk(2)]);
  const [search] = parent.all(({tagName}) => tagName === "INPUT");
  search.value = "trunk";
  search.fire("input");
  assert.deepEqual(shown().map(({dataset}) => dataset.id), ["2"]);
  assert.match(text(), /1 of 2 objects/);
  search.value = "nothing like it";
  search.fire("input");
  assert.match(text(), /no object has these words/);
});

test("a class that is switched off is not shown, until it is switched on", () => {
  const {parent, shown} = table([car(1, 5), trunk(2)]);
  const [, vehicles] = parent.byClass("chips")[0].children;
  vehicles.click();
  assert.deepEqual(shown().map(({dataset}) => dataset.id), ["2"]);
  vehicles.click();
  assert.equal(shown().length, 2);
});

test("arrows go through the rows and stay within them", () => {
  const {gone, key, panel} = table([car(1, 5), car(2, 4)]);
  panel.sortBy("class");
  for (const name of ["ArrowDown", "ArrowDown", "ArrowUp", "ArrowUp", "End", "Home"]) key(name);
  assert.deepEqual(gone, [1, 2, 1, 1, 2, 1]);
});

test("the object that is chosen has a card, until it is gone from the map", () => {
  const {parent, store, choices, panel} = table([car(3, 4.5)]);
  const [card] = parent.byClass("card");
  assert.equal(card.hidden, true);
  choices.set({object: {robot: "R1", id: 3}});
  assert.equal(card.hidden, false);
  assert.match(plain(card.textContent), /length4\.50 ± 0\.03 m.*place1\.00 m, 2\.00 m, 0\.75 m.*place, sd0\.010 m, 0\.020 m.*class is right98\.0 %/);
  store.take("/R1/objects", {objects: []}, 2);
  panel.update();
  assert.equal(card.hidden, true);
});

test("without objects it says what is waited for", () => {
  assert.match(table([]).text(), /waiting for R1_OBJECTS on here:8765/);
});

test("without a chosen robot rows of all of them are shown", () => {
  const {store, choices, shown, panel} = table([car(1, 5)]);
  store.take("/R2/objects", {objects: [car(1, 4)]}, 1);
  choices.set({robot: null});
  panel.update();
  assert.equal(shown().length, 2);
  assert.match(shown()[1].textContent, /R2/);
});
