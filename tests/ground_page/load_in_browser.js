/// How much the page bears, in headless chromium with WebGL by software: 1,000 objects at 10 Hz, 10,000 open within 5 s. Prints figures.

import assert from "node:assert/strict";
import test, {after, before} from "node:test";
import {launch, open} from "./browser.js";
import {MadeRun} from "./made_run.js";
import {MockServer} from "./mock_server.js";
import {peers} from "./peers.js";

peers();
const MEASURED_MS = 4000;
let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

async function loaded(t, objects, periods) {
  const server = await new MockServer({runs: [new MadeRun({more: objects, all: true})], begin_s: 20, periods}).start();
  const begun = Date.now(), {page, context, errors} = await open(browser, `http://127.0.0.1:${server.port}/`);
  t.after(async () => {
    await context.close();
    await server.stop();
  });
  await page.waitForFunction(count => saker.store.robots.get("R1")?.objects.size === count && saker.view.robots.get("R1").objects.cuboids.ids.length + saker.view.robots.get("R1").objects.cylinders.ids.length === count && saker.view.scene.drawn > 1,
    objects, {polling: 50, timeout: 20000});
  return {page, server, errors, open_ms: Date.now() - begun};
}

test("1,000 objects are drawn anew ten times a second", async t => {
  const {page, server, errors} = await loaded(t, 1000, {objects: 1});
  await page.waitForTimeout(3000);  // the first frames compile shaders
  const [maps, drawn] = [server.counts["/R1/objects"], await page.evaluate(() => saker.view.scene.drawn)];
  await page.waitForTimeout(MEASURED_MS);
  const sent = ((server.counts["/R1/objects"] - maps) / MEASURED_MS) * 1000, rate = ((await page.evaluate(() => saker.view.scene.drawn) - drawn) / MEASURED_MS) * 1000;
  console.log(`1,000 objects: ${sent.toFixed(1)} maps a second sent, ${rate.toFixed(1)} pictures a second drawn, coarseness ${await page.evaluate(() => saker.view.scene.coarse)}`);
  assert.ok(rate >= 10 || rate >= 0.9 * sent, `${rate} pictures a second of ${sent} maps`);
  assert.deepEqual(errors, []);
});

test("10,000 objects are open within 5 s", async t => {
  const {page, open_ms, errors} = await loaded(t, 10000, {objects: 20});
  console.log(`10,000 objects: open after ${open_ms} ms, ${await page.evaluate(() => document.querySelectorAll(".rows .row").length)} rows in the page`);
  assert.ok(open_ms < 5000, `${open_ms} ms`);
  assert.ok(await page.evaluate(() => document.querySelectorAll(".rows .row").length) < 60);
  assert.deepEqual(errors, []);
});
