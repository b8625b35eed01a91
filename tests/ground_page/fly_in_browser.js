/// The page before a real flight, in a real browser: node fly_in_browser.js ADDRESS. Sees the vehicle, compares its objects with those that an
/// independent client hears, sends the flight into a hold and home, and watches its map stay. ground_browser_test.py flies.

import assert from "node:assert/strict";
import {availableParallelism, loadavg} from "node:os";
import {launch, open} from "./browser.js";
import {assertDrawn, drawnObjects} from "./drawn.js";
import {peers} from "./peers.js";

const {FoxgloveClient, WebSocket} = peers();
const address = process.argv[2];
if (!address) process.exit(0);  // asked whether all is there that it needs

/// The maps that were heard, by their time: {utime: objects}.
function listen() {
  const client = new FoxgloveClient({ws: new WebSocket(address.replace("http", "ws"), [FoxgloveClient.SUPPORTED_SUBPROTOCOL])}), maps = new Map();
  client.on("error", error => { throw error; });
  client.on("advertise", list => list.filter(({topic}) => topic === "/R1/objects").forEach(({id}) => client.subscribe(id)));
  client.on("message", ({data}) => {
    const {utime, objects} = JSON.parse(new TextDecoder().decode(data));
    maps.set(utime, objects);
  });
  return {client, maps};
}

/// The picture at a moment when it shows the newest map, which was heard, too.
async function shown(page, maps) {
  for (let i = 0; i < 100; ++i) {
    const settled = () => page.evaluate(() => saker.store.changed.has("/R1/objects") || saker.view.scene.gliding ? 0 : saker.store.robots.get("R1").newest.objects?.utime ?? 0);
    const before = await settled(), drawn = await drawnObjects(page);
    if (before && before === await settled() && maps.has(before) && drawn.length > 0) return {drawn, heard: maps.get(before)};
    await page.waitForTimeout(100);
  }
  throw new Error(`no map that stands still; ${maps.size} heard`);
}

async function order(page, kind) {
  await page.click(`.order[data-kind=${kind}]`);
  await page.click(`.order[data-kind=${kind}]`);
  await page.waitForFunction(wanted => new RegExp(`${wanted} acknowledged by R1 after`).test(document.querySelector(".said").textContent), kind, {timeout: 15000});
  console.log(await page.textContent(".said"));
}

const browser = await launch();
try {
  const {page, errors, requests} = await open(browser, address);
  await page.waitForFunction(() => saker.view.robots.get("R1")?.vehicle.place && saker.view.scene.drawn > 1, null, {polling: 50});
  const opened_ms = await page.evaluate(() => performance.now());
  console.log(`vehicle shown after ${opened_ms.toFixed(0)} ms`);
  if (loadavg()[0] <= availableParallelism()) assert.ok(opened_ms < 5000, `vehicle shown after ${opened_ms} ms`);  // else other work is measured
  const {client, maps} = listen();
  await page.waitForFunction(() => saker.store.robots.get("R1").objects.size > 1, null, {timeout: 60000, polling: 100});
  const {drawn, heard} = await shown(page, maps);
  assertDrawn(drawn, heard);
  console.log(`${drawn.length} objects as they were sent`);
  await order(page, "hold");
  await page.waitForFunction(() => document.querySelector(".ladder [aria-current]")?.dataset.level === "hold", null, {timeout: 5000});
  await order(page, "return");
  await page.waitForFunction(() => /mission is over/.test(document.body.textContent), null, {timeout: 60000, polling: 200});
  assert.ok(await page.evaluate(() => saker.store.robots.get("R1").objects.size > 1), "the map stays");
  assert.deepEqual(errors, []);
  assert.deepEqual(requests.filter(asked => new URL(asked).host !== new URL(address).host), []);
  client.close();
} finally {
  await browser.close();
}
process.exit(0);
