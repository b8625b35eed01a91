import assert from "node:assert/strict";
import test from "node:test";
import {Store} from "../../flight/ground/page/store.js";
import {Timeline} from "../../flight/ground/page/timeline.js";
import {made, plain, settled} from "./made_document.js";

const RUN = {begin_s: 100, end_s: 200, t_s: 120, playing: false, speed: 1};

/// A timeline at a server that does what is asked; `asked` is what.
function timeline(playback = RUN, fails = null) {
  const parent = made(), store = new Store(() => 0), asked = [];
  store.playback = playback;
  const call = async (service, request) => {
    asked.push([service, request]);
    if (fails) throw new Error(fails);
    return {...store.playback, ...request};
  };
  const line = new Timeline(parent, {store, call});
  line.update();
  const [button] = parent.all(({tagName}) => tagName === "BUTTON"), [slider] = parent.all(({tagName}) => tagName === "INPUT");
  const text = () => plain(parent.all(({tagName}) => tagName === "OUTPUT")[0].textContent);
  return {parent, store, asked, timeline: line, button, slider, text};
}

test("without a run there is no timeline", () => {
  const {parent} = timeline(null);
  assert.equal(parent.hidden, true);
});

test("it says where the run stands, from its beginning", () => {
  const {parent, slider, text} = timeline();
  assert.equal(parent.hidden, false);
  assert.deepEqual([slider.min, slider.max, slider.value], [100, 200, "120"]);
  assert.equal(text(), "20 s of 1 min 40 s");
});

test("the button says what it will do", () => {
  const words = playback => timeline({...RUN, ...playback}).button.textContent;
  assert.equal(words({}), "Play");
  assert.equal(words({playing: true}), "Pause");
  assert.equal(words({t_s: 200}), "Again");
});

test("Play asks for playing, Pause for none", async () => {
  const {asked, button, store} = timeline();
  button.click();
  await settled();
  assert.equal(store.playback.playing, true);
  button.click();
  await settled();
  assert.deepEqual(asked.map(([service, {playing}]) => [service, playing]), [["play", true], ["play", false]]);
});

test("Again begins from the beginning", async () => {
  const {asked, button} = timeline({...RUN, t_s: 200});
  button.click();
  await settled();
  assert.deepEqual(asked[0], ["seek", {t_s: 100}]);
  assert.equal(asked[1][0], "play");
});

test("a step stays within the run", async () => {
  const {asked, timeline: line} = timeline({...RUN, t_s: 102});
  await line.step(-5);
  await line.step(500);
  assert.deepEqual(asked.map(([, {t_s}]) => t_s), [100, 200]);
});

test("the speed that is nearest is shown; another one is asked for", async () => {
  const {asked, parent} = timeline({...RUN, speed: 3.9});
  const [speeds] = parent.all(({tagName}) => tagName === "SELECT");
  assert.equal(speeds.value, "4");
  speeds.value = "10";
  speeds.fire("change");
  await settled();
  assert.deepEqual(asked, [["play", {playing: false, speed: 10}]]);
});

test("while the slider is dragged what the server says does not move it", async () => {
  const {slider, store, timeline: line} = timeline();
  slider.value = 150;
  slider.fire("input");
  store.playback = {...RUN, t_s: 121};
  line.update();
  assert.equal(slider.value, "150");
  slider.fire("change");
  await settled();
  assert.equal(store.playback.t_s, 150);
});

/// The browser says no change then, and the timeline would stand for ever.
test("a slider that is dragged and put back is let go", async () => {
  const {slider, store, timeline: line} = timeline();
  slider.fire("input");
  slider.fire("pointerup");
  await settled();
  store.playback = {...RUN, t_s: 130};
  line.update();
  assert.equal(slider.value, "130");
});

test("a slider that is let go asks once, though the browser says it twice", async () => {
  const {slider, asked} = timeline();
  slider.fire("input");
  const before = asked.length;
  slider.fire("pointerup");
  slider.fire("change");
  await settled();
  assert.equal(asked.length, before + 1);
});

test("dragging asks no more often than the server can follow", t => {
  let ms = 1000;
  t.mock.method(performance, "now", () => ms);
  const {slider, asked} = timeline();
  for (let i = 0; i < 30; ++i) {
    slider.fire("input");
    ms += 10;
  }
  assert.equal(asked.length, 2);  // 300 ms: at 0 and 150 ms
});

test("what the server refuses is said", async () => {
  const {button, text} = timeline(RUN, "the link is lost");
  button.click();
  await settled();
  assert.equal(text(), "the link is lost");
});
