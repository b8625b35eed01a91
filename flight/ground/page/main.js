/// Puts the page together: connection → store → picture and panels. The picture is drawn when something changed, words four times a second.

import {Choices, LAYERS} from "./choices.js";
import {CLASSES} from "./colours.js";
import {Connection} from "./connection.js";
import {el, say, show} from "./dom.js";
import {save, toCsv, toGeoJson, toJson} from "./export.js";
import {quantity} from "./format.js";
import {Health} from "./health.js";
import {keyList, listen} from "./keys.js";
import {Mission} from "./mission.js";
import {Now} from "./now.js";
import {Orders} from "./orders.js";
import {Robots} from "./robots.js";
import {Store} from "./store.js";
import {Table} from "./table.js";
import {Timeline} from "./timeline.js";
import {MOST, SCALES} from "./uncertainty.js";
import {legend, View} from "./view.js";

const WORDS_EVERY_MS = 250;
const HISTORY_S = 600, MOST_OBJECTS_OF_A_HISTORY = 1500;  // whole maps come: of a large one that is too much
const ON_DEMAND = {occupancy: "occupancy", points: "points"};  // heavy topics, by their layer
const NOT_SHOWN = new Set(["scene", "detections", "location"]);  // for other viewers

const at = id => document.getElementById(id);
const host = location.host, store = new Store(), choices = new Choices();
let mode = "live", link = {link: "opening", silent_s: 0};

const connection = new Connection({
  url: `${location.protocol === "https:" ? "wss" : "ws"}://${host}${location.pathname}${location.search}`,
  wanted: topic => {
    const kind = topic.split("/")[2];
    return !NOT_SHOWN.has(kind) && (!(kind in ON_DEMAND) || choices.layers[ON_DEMAND[kind]]);
  },
  onMessage: (topic, message, time_s) => store.take(topic, message, time_s),
  onState: takeLink,
});
const live = () => mode, call = (service, request) => connection.call(service, request);

const view = new View({canvas: at("canvas"), labels: at("labels"), scale: at("scale"), store, choices});
const goTo = (robot, id) => view.goTo(robot, id);
const table = new Table(at("objects"), {store, choices, goTo, history: askHistory, host});
const orders = new Orders(at("orders"), {choices, send: (robot, kind) => call("order", {robot, kind}), may: mayOrder});
const timeline = new Timeline(at("timeline"), {store, call});
const panels = {mission: new Mission(at("mission"), {store, choices, host, goTo}), health: new Health(at("health"), {store, choices, host})};
const now = new Now(at("now"), {store, choices, host, mode: live});
const robots = new Robots({bar: at("robots"), panel: at("fleet"), store, choices, view, mode: live});

function takeLink(state) {
  const before = link.link;
  link = state;
  mode = state.server?.metadata?.mode ?? mode;
  for (const {topic} of connection.channels.values()) store.know(topic);
  if (before !== "open" && state.link === "open") store.changed.add("robots");
  sayLink();
  orders.update();  // with the alarm: no order may seem to be possible without a link
}

function sayLink() {
  const words = {opening: `opens ${host}`, open: mode === "run" ? "a finished run" : "live", silent: "link hangs", lost: "link lost"}[link.link];
  say(at("link"), words);
  at("link").dataset.link = link.link;
  document.body.dataset.mode = mode;
  document.body.dataset.link = link.link;
  show(at("alarm"), link.link === "silent" || link.link === "lost");
  const silent = (performance.now() - connection.heard) / 1000;
  say(at("alarm"), link.link === "lost" ? `Link to ${host} lost: what is shown is old. Trying again by itself.`
    : `Nothing from ${host} for ${quantity(silent, "s", 1)}: what is shown is old. Trying again by itself.`);
}

function mayOrder() {
  if (mode === "run") return "a finished run takes no orders";
  if (link.link !== "open") return "no link: an order would not arrive";
  return connection.services.has("order") ? "" : "this server takes no orders";
}

function askHistory(robot, id) {
  const kept = store.robots.get(robot);
  if (kept.asked?.has(id) || kept.objects.size > MOST_OBJECTS_OF_A_HISTORY || !connection.services.has("history")) return null;
  (kept.asked ??= new Set()).add(id);
  return call("history", {topic: `/${robot}/objects`, seconds: HISTORY_S}).then(({messages}) => kept.seedSizes(id, messages)).catch(() => kept.asked.delete(id));
}

// Tabs of the panels.
const tabs = [...document.querySelectorAll("[role=tab]")];
function open(name) {
  for (const tab of tabs) {
    const chosen = tab.dataset.panel === name;
    tab.setAttribute("aria-selected", String(chosen));
    tab.tabIndex = chosen ? 0 : -1;
    show(at(tab.dataset.panel), chosen);
  }
  words(new Set());
}
for (const tab of tabs) {
  tab.addEventListener("click", () => open(tab.dataset.panel));
  tab.addEventListener("keydown", event => {
    const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
    if (!step) return;
    event.stopPropagation();
    const next = tabs[(tabs.indexOf(tab) + step + tabs.length) % tabs.length];
    open(next.dataset.panel);
    next.focus();
  });
}
choices.on(({object}) => object && at("objects").hidden && open("objects"));

// Layers of the picture, and what may be saved.
const boxes = LAYERS.map(({name, key, text}) => {
  const box = el("input", {type: "checkbox", onchange: () => choices.toggle(name)});
  return {name, box, node: el("label", {}, box, ` ${text} `, el("kbd", {}, key))};
});
const uncertainty = el("button", {onclick: nextUncertainty});
at("layers").append(...boxes.map(({node}) => node), uncertainty);
function nextUncertainty() {
  choices.set({uncertainty: (choices.uncertainty + 1) % SCALES.length});
}
function sayChoices() {
  for (const {name, box} of boxes) box.checked = choices.layers[name];
  const scale = SCALES[choices.uncertainty];
  const words = scale === 0 ? "uncertainty off (u)" : scale === 1 ? "95 % ellipses and whiskers as they are (u)" : `95 % ellipses and whiskers ×${scale} (u)`;
  say(uncertainty, words);
  at("follow").setAttribute("aria-pressed", String(choices.follow));
  connection.resubscribe();
}
choices.on(sayChoices);
sayChoices();

const EXPORTS = {
  json: () => [toJson(table.shown()), "application/json"],
  csv: () => [toCsv(table.shown()), "text/csv"],
  geojson: () => [toGeoJson(table.shown(), robot => store.robots.get(robot).newest.site?.origin), "application/geo+json"],
};
for (const button of document.querySelectorAll("[data-export]")) {
  button.addEventListener("click", () => {
    const [text, type] = EXPORTS[button.dataset.export]();
    say(at("exported"), text === null ? "GeoJSON needs an origin: site.origin is not set" : `${table.shown().length} objects saved`);
    if (text !== null) save(`saker-objects.${button.dataset.export}`, text, type);
  });
}

at("keys").querySelector("div").append(keyList());
const VIEWS = {
  a: () => view.showAll(),
  t: () => view.fromAbove(),
  f: () => choices.set({follow: !choices.follow}),
  u: nextUncertainty,
  "?": () => at("keys").showModal(),
  Escape: () => choices.set({object: null}),
  " ": () => mode === "run" && timeline.toggle(),
  ArrowLeft: () => mode === "run" && timeline.step(-5),
  ArrowRight: () => mode === "run" && timeline.step(5),
};
listen({keys: VIEWS, order: kind => orders.press(kind), layer: name => choices.toggle(name), robot: index => store.names()[index] && choices.set({robot: store.names()[index]})});
for (const button of document.querySelectorAll("[data-key]")) button.addEventListener("click", () => VIEWS[button.dataset.key]());

// Words follow messages four times a second; the picture as often as the screen and the machine allow.
let changedWords = new Set(), wordsAt = 0;
function words(changed) {
  robots.update();
  now.update();
  orders.update();
  timeline.update();
  sayLink();
  if (!at("objects").hidden && (!changed.size || [...changed].some(topic => topic.endsWith("/objects")))) table.update();
  for (const [name, panel] of Object.entries(panels)) if (!at(name).hidden) panel.update();
  const classes = Object.entries(CLASSES).map(([name, {glyph, colour}]) => ({name, glyph, colour}));
  if (!at("legend").children.length) legend(at("legend"), classes);
  const objects = [...store.robots.values()].reduce((sum, robot) => sum + robot.objects.size, 0);
  show(at("empty"), objects === 0);
  const scale = SCALES[choices.uncertainty], few = objects > MOST ? `, of the nearest ${MOST} objects` : "";
  say(at("scaled"), scale === 0 ? "uncertainty not shown" : `yellow: 95 % of place; whiskers: 95 % of size${scale === 1 ? "" : `, ×${scale}`}${few}`);
  const first = choices.robot ?? "R1";
  say(at("empty"), store.robots.size ? `no data yet: waiting for ${first}_OBJECTS on ${host}` : `no data yet: waiting for a robot on ${host}`);
}
choices.on(() => words(new Set()));

function frame(time_ms) {
  requestAnimationFrame(frame);  // first: a message that cannot be shown does not end the page
  const changed = store.takeChanges();
  for (const topic of changed) changedWords.add(topic);
  if (time_ms - wordsAt > WORDS_EVERY_MS) {
    wordsAt = time_ms;
    const taken = changedWords;
    changedWords = new Set();
    words(taken.size ? taken : new Set(["time"]));
  }
  view.update(changed);
  view.draw(time_ms);
}

open("objects");
connection.open();
requestAnimationFrame(frame);
globalThis.saker = {store, choices, view, connection, table};  // for tests, and for whoever opens the console
