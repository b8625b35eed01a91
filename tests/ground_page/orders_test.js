import assert from "node:assert/strict";
import test from "node:test";
import {Choices} from "../../flight/ground/page/choices.js";
import {KINDS, Orders, SecondClick} from "../../flight/ground/page/orders.js";
import {made, plain, settled} from "./made_document.js";

/// Orders to R1, of which `answers` are what the server says next; nothing is sent but what is in `sent`.
function desk({may = () => ""} = {}) {
  const parent = made(), choices = new Choices(), sent = [], waiting = [];
  choices.robot = "R1";
  const send = (robot, kind) => new Promise((done, fail) => {
    sent.push(`${robot} ${kind}`);
    waiting.push({done, fail});
  });
  const orders = new Orders(parent, {choices, send, may});
  const button = kind => parent.all(node => node.dataset.kind === kind)[0];
  const said = () => plain(parent.byClass("said")[0].textContent);
  return {parent, choices, sent, waiting, orders, button, said};
}

test("the first click asks and sends nothing; the second sends once", async () => {
  const {button, sent, said} = desk();
  button("land").click();
  assert.deepEqual(sent, []);
  assert.match(said(), /^Land R1\? It lands where it is\. Press again/);
  button("land").click();
  assert.deepEqual(sent, ["R1 land"]);
  assert.match(said(), /waiting for its acknowledgement/);
});

test("a click on another order asks anew", () => {
  const {button, sent} = desk();
  for (const kind of ["hold", "land", "hold", "abort"]) button(kind).click();
  assert.deepEqual(sent, []);
});

test("another robot is asked anew, even by the same order", () => {
  const {button, choices, sent} = desk();
  button("land").click();
  choices.set({robot: "R2"});
  button("land").click();
  assert.deepEqual(sent, []);
  button("land").click();
  assert.deepEqual(sent, ["R2 land"]);
});

test("a button that is asked for says so, the others do not", () => {
  const {button} = desk();
  button("return").click();
  assert.equal(button("return").textContent, "Return: again (5 s)");
  assert.equal(button("hold").textContent, "Hold");
});

test("a key that is held on a button is no second click", () => {
  const {parent} = desk(), group = parent.byClass("buttons")[0];
  assert.equal(group.fire("keydown", {key: "Enter", repeat: true}), false);
  assert.equal(group.fire("keydown", {key: "Enter", repeat: false}), true);
});

test("after five seconds nothing was sent, and that is said", t => {
  let ms = 1000;
  t.mock.method(performance, "now", () => ms);
  const {button, orders, sent, said} = desk();
  button("abort").click();
  ms += 4999;
  orders.update();
  assert.match(said(), /Press again/);
  ms += 1;
  orders.update();
  assert.equal(said(), "nothing was sent");
  button("abort").click();
  assert.deepEqual(sent, []);
});

for (const [state, text, words, kind] of [
  ["acknowledged", "holds", "hold acknowledged by R1 after 0.3 s", "good"],
  ["refused", "it lands already", "hold refused by R1: it lands already", "bad"],
  ["silent", "", "R1 did not answer hold", "bad"],
  ["silent", "no MISSION", "R1 did not answer hold: no MISSION", "bad"],
]) {
  test(`an order that is ${state}${text ? ` (${text})` : ""} is said to be so`, async () => {
    const {parent, orders, waiting, said} = desk();
    orders.press("hold");
    orders.press("hold");
    waiting[0].done({state, text, took_s: 0.3});
    await settled();
    assert.equal(said(), words);
    assert.ok(parent.byClass("said")[0].classList.contains(kind));
  });
}

test("an order that could not be sent is said with the reason", async () => {
  const {orders, waiting, said, button} = desk();
  orders.press("hold");
  orders.press("hold");
  waiting[0].fail(new Error("the link was lost before the answer came"));
  await settled();
  assert.equal(said(), "hold to R1 failed: the link was lost before the answer came");
  assert.equal(button("hold").disabled, false);
});

test("while one waits for its answer it cannot be given again, others can", async () => {
  const {orders, button, waiting} = desk();
  orders.press("hold");
  orders.press("hold");
  assert.equal(button("hold").disabled, true);
  assert.equal(button("land").disabled, false);
  waiting[0].done({state: "acknowledged"});
  await settled();
  assert.equal(button("hold").disabled, false);
});

test("a robot that does not answer keeps nobody from ordering another one", () => {
  const {orders, choices, button} = desk();
  orders.press("hold");
  orders.press("hold");
  choices.set({robot: "R2"});
  orders.update();
  assert.equal(button("hold").disabled, false);
});

test("of two that wait, the answer of one ends that one alone", async () => {
  const {orders, button, waiting} = desk();
  for (const kind of ["hold", "hold", "land", "land"]) orders.press(kind);
  waiting[0].done({state: "acknowledged"});
  await settled();
  assert.equal(button("hold").disabled, false);
  assert.equal(button("land").disabled, true);
});

test("without a link no order can be given, and why is said", () => {
  let why = "no link: an order would not arrive";
  const {orders, button, sent, said} = desk({may: () => why});
  orders.update();
  assert.ok(KINDS.every(({kind}) => button(kind).disabled));
  assert.equal(said(), why);
  orders.press("hold");
  orders.press("hold");
  assert.deepEqual(sent, []);
  why = "";
  orders.update();
  assert.equal(said(), "");
  assert.equal(button("hold").disabled, false);
});

test("without a robot no order can be given", () => {
  const {orders, choices, sent, said} = desk();
  choices.set({robot: null});
  orders.press("land");
  orders.press("land");
  assert.deepEqual(sent, []);
  assert.equal(said(), "no robot is chosen");
});

test("what is left of the five seconds never goes below nothing", () => {
  let ms = 0;
  const clicks = new SecondClick(() => ms);
  assert.equal(clicks.left_s(), 0);
  clicks.click("R1", "hold");
  ms = 2000;
  assert.equal(clicks.left_s(), 3);
  ms = 9000;
  assert.equal(clicks.left_s(), 0);
});
