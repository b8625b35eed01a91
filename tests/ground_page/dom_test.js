import assert from "node:assert/strict";
import test from "node:test";
import {el, keyed, say, show} from "../../flight/ground/page/dom.js";
import {made} from "./made_document.js";

const keysOf = parent => parent.children.map(({dataset}) => dataset.key);

test("an element has its attributes, children and listeners; what is null or false is left out", () => {
  made();
  let clicks = 0;
  const node = el("button", {class: "x", title: null, hidden: false, disabled: undefined, "aria-label": "go", onclick: () => { clicks += 1; }}, "a", null, [el("b", {}, "c"), undefined]);
  node.click();
  assert.equal(node.className, "x");
  assert.equal(node.getAttribute("aria-label"), "go");
  assert.deepEqual([node.getAttribute("title"), node.hidden, node.disabled], [null, false, false]);
  assert.equal(node.textContent, "ac");
  assert.equal(clicks, 1);
});

test("a flag is an attribute without a value", () => {
  made();
  assert.equal(el("input", {hidden: true}).getAttribute("hidden"), "");
});

test("words are text, never markup", () => {
  made();
  const node = el("p", {}, "<img src=x onerror=alert(1)>");
  assert.equal(node.children.length, 0);
  say(node, "<b>bold</b>");
  assert.equal(node.children.length, 0);
  assert.equal(node.textContent, "<b>bold</b>");
});

test("what is said again is not written again: a selection stays", () => {
  made();
  const node = el("p", {}, "a");
  const before = node.childNodes;
  say(node, "a");
  assert.equal(node.childNodes, before);
  say(node, "b");
  assert.notEqual(node.childNodes, before);
});

test("shown is not hidden", () => {
  made();
  const node = el("p");
  show(node, false);
  assert.equal(node.hidden, true);
  show(node, true);
  assert.equal(node.hidden, false);
});

test("children are those of the keys in their order; those that were there are the same ones", () => {
  const parent = made();
  keyed(parent, ["a", "b", "c"], key => el("p", {}, key));
  const [a, b, c] = parent.children;
  keyed(parent, ["c", "d", "a"], key => el("p", {}, key));
  assert.deepEqual(keysOf(parent), ["c", "d", "a"]);
  assert.equal(parent.children[0], c);
  assert.equal(parent.children[2], a);
  assert.equal(b.parent, null);
});

test("every child is updated by its key, new or not", () => {
  const parent = made(), updated = [];
  keyed(parent, [1, 2], () => el("p"), (node, key) => updated.push([node.dataset.key, key]));
  keyed(parent, [2], () => el("p"), (node, key) => updated.push([node.dataset.key, key]));
  assert.deepEqual(updated, [["1", 1], ["2", 2], ["2", 2]]);
});

test("a key that comes twice makes one child, however often it is said", () => {
  const parent = made();
  for (let i = 0; i < 5; ++i) keyed(parent, ["a", "b", "a", "b"], key => el("p", {}, key));
  assert.deepEqual(keysOf(parent), ["a", "b"]);
});

test("no keys, no children", () => {
  const parent = made();
  keyed(parent, ["a"], key => el("p", {}, key));
  keyed(parent, [], key => el("p", {}, key));
  assert.equal(parent.children.length, 0);
});
