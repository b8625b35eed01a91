/// A server as saker-ground is one, for tests of the page alone: its files, and the topics and services of flight/viewers/topics.md, spoken by npm's
/// FoxgloveServer, an independent implementation of the protocol. By hand: node tests/ground_page/mock_server.js [--run] [--robots N] [--port P]

import {createReadStream, existsSync} from "node:fs";
import {createServer} from "node:http";
import {extname, normalize} from "node:path";
import {pathToFileURL} from "node:url";
import {MadeRun} from "./made_run.js";
import {peers, ROOT} from "./peers.js";

const {FoxgloveServer, WebSocketServer} = peers();
const TYPES = {".html": "text/html; charset=utf-8", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".json": "application/json"};
const PERIODS = {objects: 5, odometry: 1, tf: 1, state: 2, link: 5, verdict: 5, path: 10, trajectory: 10, plan: 10, mission: 5, health: 10, site: 10, occupancy: 10, points: 5};  // in ticks
const TICK_MS = 100;
const encoder = new TextEncoder(), decoder = new TextDecoder();

export class MockServer {
  /// `runs`: MadeRuns; `mode`: "live" or "run"; `playing`: whether their time goes on from the start; `periods`: ticks between two messages of a topic; `time(t)`: the run's time when it begins.
  constructor({runs, mode = "live", begin_s = 0, speed = 1, playing = true, periods = {}, tick_ms = TICK_MS, answer_ms = 120}) {
    Object.assign(this, {runs, mode, t: begin_s, speed, playing, tick_ms, answer_ms, periods: {...PERIODS, ...periods}});
    this.received = [];  // orders
    this.sent = {};      // newest by topic
    this.tick = 0;
    this.counts = {};
  }

  async start(port = 0) {
    this.http = createServer((request, response) => serve(request, response));
    this.sockets = new WebSocketServer({server: this.http, handleProtocols: protocols => this.foxglove.handleProtocols(protocols)});
    this.#speak();
    this.sockets.on("connection", (socket, request) => this.foxglove.handleConnection(socket, request.url));
    await new Promise(done => this.http.listen(port, "127.0.0.1", done));
    this.port = this.http.address().port;
    this.timer = setInterval(() => this.#tick(), this.tick_ms);
    return this;
  }

  #speak() {
    this.foxglove = new FoxgloveServer({name: "saker-ground", capabilities: ["services"], supportedEncodings: ["json"], metadata: {mode: this.mode}, sessionId: "made"});
    this.channels = new Map();
    const kinds = [...Object.keys(PERIODS), "log", "orders"];
    for (const {robot} of this.runs) for (const kind of kinds) this.#advertise(`/${robot}/${kind}`);
    if (this.mode === "run") this.#advertise("/playback");
    this.foxglove.on("subscribe", id => {
      const topic = [...this.channels].find(([, other]) => other === id)[0];
      if (this.sent[topic]) this.#send(topic, this.sent[topic]);
    });
    this.services = new Map();
    for (const name of ["order", "history", ...(this.mode === "run" ? ["play", "seek"] : [])]) this.services.set(this.foxglove.addService({name, type: name, requestSchema: "", responseSchema: ""}), name);
    this.foxglove.on("serviceCallRequest", (request, socket) => this.#answer(request, socket));
  }

  #advertise(topic) {
    this.channels.set(topic, this.foxglove.addChannel({topic, encoding: "json", schemaName: topic, schema: "{}", schemaEncoding: "jsonschema"}));
  }

  #send(topic, message) {
    this.sent[topic] = message;
    this.counts[topic] = (this.counts[topic] ?? 0) + 1;
    this.foxglove.sendMessage(this.channels.get(topic), BigInt(Math.round(this.t * 1e9)), encoder.encode(JSON.stringify(message)));
  }

  #tick() {
    if (this.frozen) return;  // a link that hangs
    if (this.playing) this.t += (this.tick_ms / 1000) * this.speed;
    if (this.mode === "run") this.t = Math.min(this.t, this.runs[0].end_s);
    for (const run of this.runs) this.#say(run, kind => this.tick % this.periods[kind] === 0);
    if (this.mode === "run" && this.tick % 2 === 0) this.#send("/playback", this.#playback());
    this.tick += 1;
  }

  #say(run, due) {
    const messages = run.messages(this.t);
    for (const [kind, message] of Object.entries(messages)) if (due(kind)) this.#send(`/${run.robot}/${kind}`, message);
    const {phase, text} = messages.mission;
    if (run.said !== phase) this.#send(`/${run.robot}/log`, {timestamp: {sec: 0, nsec: 0}, level: phase === "hold" ? 3 : 2, name: run.robot, message: `${run.said ?? "start"} → ${phase}: ${text}`, file: "", line: 0});
    run.said = phase;
  }

  #playback() {
    return {playing: this.playing && this.t < this.runs[0].end_s, speed: this.speed, t_s: this.t, begin_s: 0, end_s: this.runs[0].end_s};
  }

  #answer({serviceId, callId, data}, socket) {
    const name = this.services.get(serviceId), request = JSON.parse(decoder.decode(data));
    const reply = (response, later = 0) => setTimeout(() => this.foxglove.sendServiceCallResponse({serviceId, callId, encoding: "json", data: new DataView(encoder.encode(JSON.stringify(response)).buffer)}, socket), later);
    if (name === "order") return this.#order(request, reply);
    if (name === "history") return reply({topic: request.topic, messages: this.sent[request.topic] ? [{t_s: this.t - 2, message: this.sent[request.topic]}] : []});
    if (name === "play") Object.assign(this, {playing: request.playing, speed: request.speed ?? this.speed});
    if (name === "seek") {
      this.t = request.t_s;
      for (const run of this.runs) this.#say(run, () => true);
    }
    return reply(this.#playback());
  }

  #order({robot, kind}, reply) {
    this.received.push({robot, kind});
    const id = this.received.length, run = this.runs.find(other => other.robot === robot);
    const order = {id, t_s: Date.now() / 1000, robot, kind, by: "127.0.0.1", state: "sent", text: ""};
    this.#send(`/${robot}/orders`, order);
    const state = kind === "abort" ? "refused" : "acknowledged", text = kind === "abort" ? "not while it flies its tour" : "";
    if (kind === "hold") run.holds = {since: this.t, phase: "hold"};
    if (kind === "resume") run.holds = null;
    if (kind === "return") {
      run.holds = null;
      this.t = Math.max(this.t, run.tour_s);
    }
    reply({id, state, text, took_s: this.answer_ms / 1000}, this.answer_ms);
    setTimeout(() => this.#send(`/${robot}/orders`, {...order, state, text, took_s: this.answer_ms / 1000}), this.answer_ms);
  }

  /// Ends at once, as a server that is killed.
  async stop() {
    clearInterval(this.timer);
    for (const socket of this.sockets.clients) socket.terminate();
    this.sockets.close();
    this.http.closeAllConnections();
    await new Promise(done => this.http.close(done));
  }
}

function serve(request, response) {
  const path = normalize(decodeURIComponent(new URL(request.url, "http://x").pathname));
  const file = `${ROOT}flight/ground/page${path === "/" ? "/index.html" : path}`;
  if (path.includes("..") || !existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, {"content-type": TYPES[extname(file)] ?? "application/octet-stream", "cache-control": "no-store"});
  return createReadStream(file).pipe(response);
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  const option = (name, otherwise) => (process.argv.includes(name) ? Number(process.argv[process.argv.indexOf(name) + 1]) : otherwise);
  const runs = Array.from({length: option("--robots", 1)}, (_, i) => new MadeRun({robot: `R${i + 1}`, seed: 7, shift: [0.15 * i, 0.1 * i], more: option("--objects", 0), all: option("--objects", 0) > 0}));
  const server = await new MockServer({runs, mode: process.argv.includes("--run") ? "run" : "live", begin_s: option("--begin", 0)}).start(option("--port", 8765));
  console.log(`http://127.0.0.1:${server.port}/`);
}
