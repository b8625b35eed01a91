import assert from "node:assert/strict";
import test from "node:test";
import {LAYERS} from "../../flight/ground/page/choices.js";
import {keyList, listen} from "../../flight/ground/page/keys.js";
import {KINDS} from "../../flight/ground/page/orders.js";
import {made} from "./made_document.js";

/// What was done, by the keys that were pressed; `press` gives whether the browser does its own thing, too.
function keyboard() {
  made();
  const done = [];
  listen({keys: {a: () => done.push("all"), " ": () => done.push("play"), ArrowLeft: () => done.push("back"), Escape: () => done.push("nothing")}, order: kind => done.push(`order ${kind}`),
    layer: name => done.push(`layer ${name}`), robot: index => done.push(`robot ${index}`)});
  // Where the key goes: the body, or what the selector of a test names.
  const press = (key, {on = "", ...more} = {}) => {
    const event = Object.assign(new Event("keydown", {cancelable: true}), {key, ...more});
    Object.defineProperty(event, "target", {value: {matches: list => on !== "" && list.split(", ").includes(on)}});
    return document.dispatchEvent(event);
  };
  return {done, press};
}

test("Shift and a letter is an order", () => {
  const {done, press} = keyboard();
  for (const {key} of KINDS) press(key, {shiftKey: true});
  assert.deepEqual(done, KINDS.map(({kind}) => `order ${kind}`));
});

test("an order's key that is held orders once: its repetitions are no second press", () => {
  const {done, press} = keyboard();
  press("L", {shiftKey: true});
  for (let i = 0; i < 30; ++i) assert.equal(press("L", {shiftKey: true, repeat: true}), false);
  assert.deepEqual(done, ["order land"]);
});

test("the same letter without Shift is a layer or a view, never an order", () => {
  const {done, press} = keyboard();
  for (const {key} of KINDS) press(key.toLowerCase());
  assert.ok(done.length > 0);
  assert.ok(done.every(what => !what.startsWith("order")));
});

test("every layer has its key", () => {
  const {done, press} = keyboard();
  for (const {key} of LAYERS) press(key);
  assert.deepEqual(done, LAYERS.map(({name}) => `layer ${name}`));
});

test("no key means two things", () => {
  const keys = [...LAYERS.map(({key}) => key), "a", "t", "f", "u"];
  assert.equal(new Set(keys).size, keys.length);
  assert.equal(new Set(KINDS.map(({key}) => key)).size, KINDS.length);
});

test("digits choose robots, from 1", () => {
  const {done, press} = keyboard();
  press("1");
  press("9");
  press("0");
  assert.deepEqual(done, ["robot 0", "robot 8"]);
});

test("who types is left alone", () => {
  const {done, press} = keyboard();
  for (const on of ["input[type=search]", "select", "textarea"]) press("H", {shiftKey: true, on});
  assert.deepEqual(done, []);
});

test("shortcuts of the browser stay its own", () => {
  const {done, press} = keyboard();
  for (const held of ["ctrlKey", "metaKey", "altKey"]) assert.equal(press("a", {[held]: true}), true);
  assert.deepEqual(done, []);
});

test("Space presses a button that has the focus, else it plays", () => {
  const {done, press} = keyboard();
  assert.equal(press(" ", {on: "button"}), true);
  assert.deepEqual(done, []);
  assert.equal(press(" "), false);
  assert.deepEqual(done, ["play"]);
});

test("arrows move what has the focus, else the run", () => {
  const {done, press} = keyboard();
  press("ArrowLeft", {on: "canvas"});
  press("ArrowLeft");
  assert.deepEqual(done, ["back"]);
});

test("a key without a meaning goes on to the browser", () => {
  const {done, press} = keyboard();
  assert.equal(press("F5"), true);
  assert.deepEqual(done, []);
});

test("the list of keys names every order and every layer", () => {
  made();
  const names = keyList().all(({tagName}) => tagName === "KBD").map(({textContent}) => textContent);
  for (const {key} of LAYERS) assert.ok(names.includes(key), key);
  for (const {key} of KINDS) assert.ok(names.includes(`Shift+${key}`), key);
});
