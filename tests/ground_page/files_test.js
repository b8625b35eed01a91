import assert from "node:assert/strict";
import {createHash} from "node:crypto";
import {existsSync, readdirSync, readFileSync} from "node:fs";
import test from "node:test";

const PAGE = new URL("../../flight/ground/page/", import.meta.url);
const read = name => readFileSync(new URL(name, PAGE), "utf8");
const sources = readdirSync(PAGE).filter(name => /\.(js|css|html)$/.test(name));

test("the page's policy allows its own files and its import map, nothing else", () => {
  const html = read("index.html"), map = html.match(/<script type="importmap">(.*?)<\/script>/s)[1];
  const policy = html.match(/Content-Security-Policy" content="([^"]*)"/)[1];
  assert.ok(policy.includes(`'sha256-${createHash("sha256").update(map).digest("base64")}'`));
  assert.match(policy, /default-src 'none'/);
  assert.doesNotMatch(policy, /https?:|\*/);
});

test("no source names another host, but for namespaces and sources in comments", () => {
  for (const name of sources) {
    const code = read(name).replaceAll("http://www.w3.org/2000/svg", "").replace(/^\s*\/\/.*$/gm, "");
    assert.doesNotMatch(code, /https?:\/\/(?!\$)/, name);
  }
});

test("every module that is imported is there", () => {
  for (const name of sources.filter(source => source.endsWith(".js"))) {
    for (const [, module] of read(name).matchAll(/from "(\.[^"]+)"/g)) assert.ok(existsSync(new URL(module, PAGE)), `${name}: ${module}`);
  }
});

test("every module is asked for with the page, not when another one names it", () => {
  const asked = [...read("index.html").matchAll(/<link rel="modulepreload" href="([^"]+)">/g)].map(([, name]) => name);
  const own = readdirSync(PAGE).filter(name => name.endsWith(".js") && name !== "main.js");
  assert.deepEqual(asked.filter(name => !name.startsWith("vendor/")), own.sort());
  for (const name of ["three.module.js", "three.core.js", "OrbitControls.js"]) assert.ok(asked.includes(`vendor/${name}`), name);
});

test("lock files name no registry", () => {
  for (const folder of [PAGE, new URL(".", import.meta.url)]) {
    const lock = readFileSync(new URL("package-lock.json", folder), "utf8");
    assert.doesNotMatch(lock, /"resolved"|https?:/);
    assert.match(lock, /"integrity": "sha512-/);
  }
});

test("files and lines are short", () => {
  for (const name of sources) assert.ok(read(name).split("\n").length <= 400, name);
});
