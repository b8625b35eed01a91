// npm's @foxglove/ws-protocol client against saker-ground: a made robot flies, every channel is subscribed to and decoded, each message
// by its schema; services are called. node peer_test.js BIN [TOPIC…]; the topics that have to say something.
import assert from "node:assert";
import {spawn} from "node:child_process";
import {once} from "node:events";
import {mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {createInterface} from "node:readline";
import {peers, Schemas} from "./peers.js";

const {FoxgloveClient, WebSocket, ...others} = peers();
const BIN = process.argv[2];
const SILENT = new Set(["/R1/orders"]); // until somebody orders something
const folder = mkdtempSync(`${tmpdir()}/saker_peer_`);
const ended = [];
const start = (name, ...words) => {
  const child = spawn(`${BIN}/${name}`, words, {stdio: ["ignore", "pipe", "inherit"]});
  ended.push(() => child.kill("SIGKILL"));
  return child;
};

async function run() {
  start("made_robot", "R1", "60", "12");
  const ground = start("saker-ground", "--port", "0", "--set", `ground.folder=${folder}`, "--set", "site.origin=[47.1, 8.2, 90]");
  const [address] = await once(createInterface({input: ground.stdout}), "line");
  const client = new FoxgloveClient({ws: new WebSocket(address.replace("http", "ws"), [FoxgloveClient.SUPPORTED_SUBPROTOCOL])});
  const schemas = new Schemas(others);
  const channels = new Map(), heard = new Map(), wrong = new Set(), services = new Map();
  client.on("error", (error) => wrong.add(`error: ${error.message ?? error}`));
  client.on("advertise", (list) => {
    for (const channel of list) channels.set(client.subscribe(channel.id), channel);
  });
  client.on("advertiseServices", (list) => list.forEach((s) => services.set(s.name, s)));
  client.on("message", ({subscriptionId, timestamp, data}) => {
    const {topic, schemaName, schema, encoding, schemaEncoding} = channels.get(subscriptionId);
    assert.deepStrictEqual([encoding, schemaEncoding], ["json", "jsonschema"]);
    assert(Math.abs(Number(timestamp) / 1e6 - Date.now()) < 60000);
    const fault = schemas.wrong(schemaName, schema, JSON.parse(new TextDecoder().decode(data)));
    if (fault) wrong.add(`${topic}: ${fault}`);
    heard.set(topic, (heard.get(topic) ?? 0) + 1);
  });
  const silent = () => [...channels.values()].map((c) => c.topic).filter((t) => !heard.has(t) && !SILENT.has(t));
  const until = Date.now() + 15000;
  while ((channels.size === 0 || silent().some((t) => t !== "/R1/detections" && t !== "/R1/occupancy")) && Date.now() < until)
    await new Promise((done) => setTimeout(done, 100));
  assert.deepStrictEqual([...wrong], []);
  assert.deepStrictEqual(silent().sort(), ["/R1/detections", "/R1/occupancy"]); // which the made robot does not say
  const answer = new Promise((done) => client.on("serviceCallResponse", done));
  const payload = new TextEncoder().encode('{"topic": "/R1/state", "seconds": 10}');
  client.sendServiceCallRequest({serviceId: services.get("history").id, callId: 7, encoding: "json", data: payload});
  const {callId, encoding, data} = await answer;
  assert.deepStrictEqual([callId, encoding], [7, "json"]);
  assert(JSON.parse(new TextDecoder().decode(data)).messages.length > 0);
  client.close();
  console.log(`${heard.size} topics, ${[...heard.values()].reduce((a, b) => a + b)} messages, each as its schema says`);
}

try {
  await run();
} finally {
  ended.forEach((end) => end());
  rmSync(folder, {recursive: true, force: true});
}
process.exit(0);
