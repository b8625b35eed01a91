/// The page in a real browser against npm's FoxgloveServer: node --test tests/ground_page/in_browser.js

import assert from "node:assert/strict";
import test, {after, before} from "node:test";
import {launch, open} from "./browser.js";
import {assertDrawn, drawnObjects} from "./drawn.js";
import {MadeRun} from "./made_run.js";
import {MockServer} from "./mock_server.js";
import {peers} from "./peers.js";

peers();
let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

/// A page at a made server; both end with the test.
async function flying(t, {server = {}, run = {}, page = {}, robots = 1, waits = true} = {}) {
  const runs = Array.from({length: robots}, (_, i) => new MadeRun({robot: `R${i + 1}`, shift: [0.2 * i, 0], ...run}));
  const made = await new MockServer({runs, begin_s: 20, ...server}).start();
  const opened = await open(browser, `http://127.0.0.1:${made.port}/?key=made`, page);
  t.after(async () => {
    await opened.context.close();
    await made.stop();
  });
  if (waits) await opened.page.waitForFunction(() => document.querySelectorAll(".rows .row:not([hidden])").length > 3);
  return {...opened, server: made, runs};
}

const alarmed = (page, shown) => page.waitForFunction(wanted => document.getElementById("alarm").hidden !== wanted, shown, {polling: 50});

/// The first frames compile shaders, and nothing else is done meanwhile.
const drawing = page => page.waitForFunction(() => saker.view.scene.drawn > 6, null, {polling: 50});

/// The run stands still, and the page shows it as it stands.
async function still(page, server) {
  server.playing = false;
  await new Promise(done => setTimeout(done, 600));  // a whole map comes twice a second
  await page.waitForFunction(utime => saker.store.robots.get("R1").newest.objects.utime === utime && !saker.store.changed.has("/R1/objects") && !saker.view.scene.gliding && saker.view.framed,
    server.sent["/R1/objects"].utime, {polling: 100});
  await page.waitForTimeout(400);
}

test("the page loads without an error and asks no other host", async t => {
  const {errors, requests, server, page} = await flying(t);
  await page.waitForTimeout(1500);
  assert.deepEqual(errors, []);
  assert.ok(requests.some(address => address === `ws://127.0.0.1:${server.port}/?key=made`), "the key goes along");
  assert.deepEqual(requests.filter(address => new URL(address).host !== `127.0.0.1:${server.port}`), []);
});

test("the vehicle is shown within 5 s of opening", async t => {
  const begun = Date.now(), {page} = await flying(t, {waits: false});
  await page.waitForFunction(() => saker.view.robots.get("R1")?.vehicle.place && saker.view.scene.drawn > 1, null, {polling: 50});
  console.log(`vehicle shown after ${Date.now() - begun} ms`);
  assert.ok(Date.now() - begun < 5000, `${Date.now() - begun} ms`);
});

test("objects in the picture and in the table equal those that were sent", async t => {
  const {page, server} = await flying(t);
  await still(page, server);
  const sent = server.sent["/R1/objects"].objects;
  assertDrawn(await drawnObjects(page), sent);
  const rows = await page.evaluate(() => saker.table.shown().map(({id, size}) => [id, size]));
  assert.equal(rows.length, sent.length);
  const car = sent.find(({shape}) => shape === "cuboid"), words = await page.textContent(`.rows .row[data-id="${car.id}"] .length`);
  assert.ok(words.startsWith(`${car.size[0].toFixed(2)}\u00a0±`), words);
});

test("hold and return need two clicks, are sent once and shown as acknowledged", async t => {
  const {page, server} = await flying(t);
  await page.click(".order[data-kind=hold]");
  assert.match(await page.textContent(".said"), /Press again/);
  await page.waitForTimeout(300);
  assert.deepEqual(server.received, []);
  await page.click(".order[data-kind=hold]");
  await page.waitForFunction(() => /hold acknowledged by R1 after/.test(document.querySelector(".said").textContent));
  await page.waitForFunction(() => document.querySelector(".ladder [aria-current]")?.dataset.level === "hold");
  await page.keyboard.press("Shift+B");
  await page.keyboard.press("Shift+B");
  await page.waitForFunction(() => /return acknowledged by R1 after/.test(document.querySelector(".said").textContent));
  assert.deepEqual(server.received, [{robot: "R1", kind: "hold"}, {robot: "R1", kind: "return"}]);
});

test("an order that is refused, and one that is not repeated, are shown as that", async t => {
  const {page, server} = await flying(t);
  await page.dblclick(".order[data-kind=abort]");
  await page.waitForFunction(() => /abort refused by R1: not while it flies its tour/.test(document.querySelector(".said").textContent));
  await page.click(".order[data-kind=land]");
  await page.waitForFunction(() => /nothing was sent/.test(document.querySelector(".said").textContent), null, {timeout: 8000});
  assert.deepEqual(server.received, [{robot: "R1", kind: "abort"}]);
});

test("a lost link is said within 2 s and comes back by itself", async t => {
  const {page, server, runs} = await flying(t), {port} = server;
  await drawing(page);
  let begun = Date.now();
  await server.stop();
  await alarmed(page, true);
  console.log(`lost link said after ${Date.now() - begun} ms`);
  assert.ok(Date.now() - begun < 2000, `${Date.now() - begun} ms`);
  assert.match(await page.textContent("#alarm"), /lost/);
  assert.ok(await page.isDisabled(".order[data-kind=hold]"));
  const again = await new MockServer({runs, begin_s: 30}).start(port);
  t.after(() => again.stop());
  begun = Date.now();
  await alarmed(page, false);
  console.log(`link back after ${Date.now() - begun} ms`);
  assert.ok(Date.now() - begun < 3000, `${Date.now() - begun} ms`);
  await page.waitForFunction(() => saker.store.robots.get("R1").newest.odometry.utime > 30e6);
});

test("a link that hangs is said within 2 s, and its end by itself", async t => {
  const {page, server} = await flying(t);
  await drawing(page);
  const begun = Date.now();
  server.frozen = true;
  await alarmed(page, true);
  console.log(`hanging link said after ${Date.now() - begun} ms`);
  assert.ok(Date.now() - begun < 2000, `${Date.now() - begun} ms`);
  server.frozen = false;
  await alarmed(page, false);
});

test("a phone's width has no horizontal scroll, and every panel fits", async t => {
  const {page, errors} = await flying(t, {page: {width: 360, height: 740, hasTouch: true, isMobile: true, deviceScaleFactor: 2}});
  for (const panel of ["objects", "mission", "health", "fleet"]) {
    await page.click(`[data-panel=${panel}]`);
    await page.waitForTimeout(200);
    const [inner, whole] = await page.evaluate(() => [innerWidth, document.documentElement.scrollWidth]);
    assert.equal(inner, 360, panel);
    assert.ok(whole <= 360, `${panel}: ${whole} px`);
  }
  assert.deepEqual(errors, []);
});

test("the table is sorted by its heads and gone through by keys", async t => {
  const {page, server} = await flying(t);
  await still(page, server);
  const lengths = () => page.evaluate(() => saker.table.rows.map(({size}) => size[0]));
  await page.click(".head [data-column=length]");
  const up = await lengths();
  assert.deepEqual(up, [...up].sort((a, b) => a - b));
  await page.focus(".head [data-column=length]");
  await page.keyboard.press("Enter");
  assert.deepEqual(await lengths(), [...up].reverse());
  assert.equal(await page.getAttribute(".head [data-column=length]", "aria-sort"), "descending");
  await page.focus(".scroller");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowDown");
  const [chosen, second] = await page.evaluate(() => [saker.choices.object.id, saker.table.rows[1].id]);
  assert.equal(chosen, second);
  assert.match(await page.textContent(".card h3"), new RegExp(` ${second}`));
  assert.match(await page.getAttribute(".card .plot .line", "d"), /^M/, "its size over time");
  await page.keyboard.press("End");
  assert.equal(await page.evaluate(() => saker.choices.object.id), await page.evaluate(() => saker.table.rows.at(-1).id));
  await page.keyboard.press("Escape");
  assert.equal(await page.evaluate(() => saker.choices.object), null);
});

test("layers go by their keys, and uncertainty through its three sizes", async t => {
  const {page} = await flying(t);
  const rims = () => page.evaluate(() => saker.view.robots.get("R1").uncertainty.count);
  assert.ok(await rims() > 0);
  await page.keyboard.press("u");
  await page.keyboard.press("u");
  assert.equal(await rims(), 0);
  await page.keyboard.press("g");
  assert.equal(await page.evaluate(() => saker.view.robots.get("R1").geofence.lines.mesh), null);
  await page.keyboard.press("o");
  await page.waitForFunction(() => saker.view.robots.get("R1").occupancy.mesh?.count > 10);
});

test("a click in the picture chooses what is there", async t => {
  const {page, server} = await flying(t);
  await still(page, server);
  const [id, x, y] = await page.evaluate(() => {
    const {scene} = saker.view, {position, id} = [...saker.store.robots.get("R1").objects.values()].find(({shape}) => shape === "cuboid");
    const [u, v] = scene.toScreen(scene.toMap("R1/world", position)), box = scene.canvas.getBoundingClientRect();
    return [id, box.left + u, box.top + v];
  });
  await page.mouse.click(x, y);
  assert.equal(await page.evaluate(() => saker.choices.object?.id), id);
});

test("a finished run is played, sought and takes no orders", async t => {
  const {page, server} = await flying(t, {server: {mode: "run", begin_s: 5}});
  await page.waitForSelector("#timeline:not([hidden])");
  assert.ok(await page.isDisabled(".order[data-kind=hold]"));
  await page.keyboard.press("Space");
  await page.waitForFunction(() => document.querySelector(".play").textContent === "Play");
  assert.equal(server.playing, false);
  await page.fill("#timeline input", "40");
  await page.waitForFunction(() => Math.abs(saker.store.robots.get("R1").newest.odometry.utime / 1e6 - 40) < 0.2);
  await page.keyboard.press("Escape");
  await page.focus("body");
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press("ArrowLeft");
  await page.waitForFunction(() => Math.abs(saker.store.robots.get("R1").newest.odometry.utime / 1e6 - 35) < 0.2);
});

test("several robots have their colours, and their maps become one", async t => {
  const {page} = await flying(t, {robots: 2});
  const colours = await page.evaluate(() => [...document.querySelectorAll(".chip i")].map(mark => mark.style.background));
  assert.equal(new Set(colours).size, 2);
  await page.click("[data-panel=fleet]");
  await page.fill(".fader input", "100");
  await page.waitForFunction(() => saker.view.mergedMap.some(({robots}) => robots.length === 2));
  assert.ok(await page.evaluate(() => saker.view.merged.group.visible && !saker.view.robots.get("R1").objects.group.visible));
});

test("without data it says what it waits for", async t => {
  const {page, server} = await flying(t, {waits: false, server: {begin_s: 0, playing: false}});  // stands still from the start: nothing is mapped yet
  for (const node of ["#empty", "#objects .none"]) await page.waitForFunction(([one, port]) => document.querySelector(one).textContent === `no data yet: waiting for R1_OBJECTS on 127.0.0.1:${port}`, [node, server.port]);
});

test("what is shown can be saved", async t => {
  const {page, server} = await flying(t);
  await still(page, server);
  await page.fill("#objects input", "vehicle");
  for (const [kind, read] of [["json", text => JSON.parse(text).objects.length], ["geojson", text => JSON.parse(text).features.length], ["csv", text => text.trim().split("\n").length - 1]]) {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(`[data-export=${kind}]`)]);
    const chunks = [];
    for await (const chunk of await download.createReadStream()) chunks.push(chunk);
    assert.equal(read(Buffer.concat(chunks).toString()), server.sent["/R1/objects"].objects.filter(object => object.class === "vehicle").length, kind);
  }
});
