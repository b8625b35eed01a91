import assert from "node:assert/strict";
import test from "node:test";
import {Connection, GIVEN_UP_AFTER_MS, PROTOCOLS, readAnswer, readMessage, SILENT_AFTER_MS, writeCall} from "../../flight/ground/page/connection.js";

class Socket {
  static made = [];
  constructor(url, protocols) {
    Object.assign(this, {url, protocols, sent: []});
    Socket.made.push(this);
  }
  send(data) { this.sent.push(data); }
  close() { this.closed = true; }
  text(message) { this.onmessage({data: JSON.stringify(message)}); }
  message(subscription, object) {
    const payload = new TextEncoder().encode(JSON.stringify(object)), view = new DataView(new ArrayBuffer(13 + payload.length));
    view.setUint8(0, 1);
    view.setUint32(1, subscription, true);
    view.setBigUint64(5, 12_500_000_000n, true);
    new Uint8Array(view.buffer).set(payload, 13);
    this.onmessage({data: view.buffer});
  }
  answer(call, object) {
    const payload = new TextEncoder().encode(JSON.stringify(object)), view = new DataView(new ArrayBuffer(17 + payload.length));
    view.setUint8(0, 3);
    view.setUint32(1, 5, true);
    view.setUint32(5, call, true);
    view.setUint32(9, 4, true);
    new Uint8Array(view.buffer).set(new TextEncoder().encode("json"), 13);
    new Uint8Array(view.buffer).set(payload, 17);
    this.onmessage({data: view.buffer});
  }
}

const CHANNELS = [{id: 9, topic: "/R1/objects", encoding: "json"}, {id: 10, topic: "/R1/points", encoding: "json"}, {id: 11, topic: "/R1/raw", encoding: "cbor"}];

function opened(t, more = {}) {
  t.mock.timers.enable({apis: ["setInterval", "setTimeout"]});
  const clock = {ms: 0}, messages = [], states = [];
  const connection = new Connection({url: "ws://here/", WebSocket: Socket, now: () => clock.ms, onMessage: (...parts) => messages.push(parts), onState: state => states.push(state.link), ...more});
  connection.open();
  const socket = Socket.made.at(-1);
  const pass = ms => {
    for (let passed = 0; passed < ms; passed += 100) {
      clock.ms += 100;
      t.mock.timers.tick(100);
    }
  };
  socket.text({op: "serverInfo", name: "saker-ground", capabilities: []});
  socket.text({op: "advertise", channels: CHANNELS});
  return {connection, socket, messages, states, pass};
}

test("it offers both protocols and subscribes to wanted channels in JSON alone", t => {
  const {socket, connection} = opened(t, {wanted: topic => topic !== "/R1/points"});
  assert.deepEqual(socket.protocols, PROTOCOLS);
  assert.deepEqual(JSON.parse(socket.sent[0]), {op: "subscribe", subscriptions: [{id: 1, channelId: 9}]});
  connection.wanted = topic => topic === "/R1/points";
  connection.resubscribe();
  assert.deepEqual(socket.sent.slice(1).map(JSON.parse), [{op: "subscribe", subscriptions: [{id: 2, channelId: 10}]}, {op: "unsubscribe", subscriptionIds: [1]}]);
});

test("a message arrives with its topic and time", t => {
  const {socket, messages} = opened(t);
  socket.message(1, {total: 3});
  assert.deepEqual(messages, [["/R1/objects", {total: 3}, 12.5]]);
});

test("garbage is counted and changes nothing", t => {
  const {socket, connection, messages} = opened(t);
  t.mock.method(console, "warn", () => {});
  socket.onmessage({data: "{"});
  socket.onmessage({data: new Uint8Array([77, 1, 2]).buffer});
  socket.onmessage({data: new Uint8Array([1, 0]).buffer});
  assert.equal(connection.unreadable, 3);
  socket.message(1, {});
  assert.equal(messages.length, 1);
});

test("a closed link is said at once and opened again by itself", t => {
  const {socket, states, pass} = opened(t);
  socket.onclose();
  assert.equal(states.at(-1), "lost");
  const before = Socket.made.length;
  pass(500);
  assert.equal(Socket.made.length, before + 1);
  Socket.made.at(-1).text({op: "serverInfo", name: "saker-ground"});
  assert.equal(states.at(-1), "open");
});

test("a link that hangs is said within 2 s, and given up later", t => {
  const {socket, states, pass} = opened(t);
  socket.message(1, {});
  pass(SILENT_AFTER_MS);
  assert.equal(states.at(-1), "open");
  pass(500);
  assert.equal(states.at(-1), "silent");
  pass(GIVEN_UP_AFTER_MS);
  assert.ok(socket.closed);
  assert.equal(states.at(-1), "lost");
});

test("a server at which nobody flies may be silent", t => {
  const {states, pass} = opened(t);
  pass(10000);
  assert.equal(states.at(-1), "open");
});

test("a run that is paused may be silent", t => {
  const {socket, states, pass} = opened(t);
  socket.text({op: "serverInfo", name: "saker-ground", metadata: {mode: "run"}});
  socket.message(1, {});
  pass(10000);
  assert.equal(states.at(-1), "open");
});

test("a call waits for its own answer", async t => {
  const {socket, connection} = opened(t);
  socket.text({op: "advertiseServices", services: [{id: 5, name: "order"}]});
  const first = connection.call("order", {kind: "hold"}), second = connection.call("order", {kind: "land"});
  const [one, two] = socket.sent.slice(-2).map(frame => new DataView(frame.buffer).getUint32(5, true));
  socket.answer(two, {state: "refused"});
  socket.answer(one, {state: "acknowledged"});
  assert.deepEqual([await first, await second], [{state: "acknowledged"}, {state: "refused"}]);
});

test("a call fails with the server's words, without a service, with the link, and in time", async t => {
  const {socket, connection} = opened(t);
  await assert.rejects(connection.call("order", {}), /no service order/);
  socket.text({op: "advertiseServices", services: [{id: 5, name: "order"}]});
  const told = connection.call("order", {}), slow = connection.call("order", {});
  socket.text({op: "serviceCallFailure", serviceId: 5, callId: new DataView(socket.sent.at(-2).buffer).getUint32(5, true), message: "no key"});
  await assert.rejects(told, /no key/);
  t.mock.timers.tick(15000);
  await assert.rejects(slow, /no answer within 15 s/);
});

test("a call under way fails when the link is lost", async t => {
  const {socket, connection} = opened(t);
  socket.text({op: "advertiseServices", services: [{id: 5, name: "order"}]});
  const call = connection.call("order", {});
  socket.onclose();
  await assert.rejects(call, /link was lost/);
});

test("frames have the protocol's bytes", () => {
  const frame = writeCall(258, 3, {a: 1});
  assert.deepEqual([...frame.slice(0, 17)], [2, 2, 1, 0, 0, 3, 0, 0, 0, 4, 0, 0, 0, ...new TextEncoder().encode("json")]);
  assert.equal(new TextDecoder().decode(frame.slice(17)), '{"a":1}');
  const {service, call, encoding, payload} = readAnswer(new DataView(frame.buffer));
  assert.deepEqual([service, call, encoding, payload.length], [258, 3, "json", 7]);
  const view = new DataView(new ArrayBuffer(14));
  view.setUint32(1, 7, true);
  view.setBigUint64(5, 5n, true);
  assert.deepEqual([readMessage(view).subscription, readMessage(view).time_ns, readMessage(view).payload.length], [7, 5n, 1]);
});

test("an answer that cannot be read ends its call, and is counted", async t => {
  const {socket, connection} = opened(t);
  t.mock.method(console, "warn", () => {});
  socket.text({op: "advertiseServices", services: [{id: 5, name: "order"}]});
  const call = connection.call("order", {});
  const frame = writeCall(5, new DataView(socket.sent.at(-1).buffer).getUint32(5, true), {});
  frame[0] = 3;
  frame[frame.length - 1] = 0x7b;  // "{{"
  socket.onmessage({data: frame.buffer});
  await assert.rejects(call, /cannot be read/);
  assert.equal(connection.unreadable, 1);
});

test("an answer whose lengths are beyond it is garbage", t => {
  const {socket, connection} = opened(t);
  t.mock.method(console, "warn", () => {});
  const frame = writeCall(5, 1, {});
  frame[0] = 3;
  new DataView(frame.buffer).setUint32(9, 0xffffffff, true);
  socket.onmessage({data: frame.buffer});
  assert.equal(connection.unreadable, 1);
});

test("an answer that nobody waits for is none", t => {
  const {socket, connection} = opened(t);
  socket.answer(99, {});
  assert.equal(connection.unreadable, 0);
});

test("a channel that is taken back says nothing more and may come again", t => {
  const {socket, messages} = opened(t);
  socket.text({op: "unadvertise", channelIds: [9]});
  socket.message(1, {});
  assert.equal(messages.length, 0);
  socket.text({op: "advertise", channels: [CHANNELS[0]]});
  assert.equal(JSON.parse(socket.sent.at(-1)).subscriptions[0].channelId, 9);
});

test("a channel that is advertised twice is subscribed to once", t => {
  const {socket} = opened(t);
  const before = socket.sent.length;
  socket.text({op: "advertise", channels: CHANNELS});
  assert.equal(socket.sent.length, before);
});

test("a service that is taken back cannot be called", async t => {
  const {socket, connection} = opened(t);
  socket.text({op: "advertiseServices", services: [{id: 5, name: "order"}]});
  socket.text({op: "unadvertiseServices", serviceIds: [5]});
  await assert.rejects(connection.call("order", {}), /no service order/);
});

test("an order is not sent by a link that hangs", async t => {
  const {socket, connection, pass} = opened(t);
  socket.text({op: "advertiseServices", services: [{id: 5, name: "order"}]});
  socket.message(1, {});
  pass(2000);
  const before = socket.sent.length;
  await assert.rejects(connection.call("order", {}), /link is lost/);
  assert.equal(socket.sent.length, before);
});

test("a link that was silent is open with the next word", t => {
  const {socket, states, pass} = opened(t);
  socket.message(1, {});
  pass(2000);
  assert.equal(states.at(-1), "silent");
  socket.message(1, {});
  assert.equal(states.at(-1), "open");
});

test("what an old socket still says is not heard", t => {
  const {socket, messages, pass} = opened(t);
  socket.onclose();
  pass(500);
  socket.message(1, {});
  assert.equal(messages.length, 0);
});

test("it tries again at least once a second, without end", t => {
  const {socket, pass} = opened(t);
  socket.onclose();
  const tries = Socket.made.length;
  for (let i = 0; i < 20; ++i) {
    pass(1000);
    if (Socket.made.at(-1).onclose && !Socket.made.at(-1).closed) Socket.made.at(-1).onclose();
  }
  assert.ok(Socket.made.length - tries >= 10 && Socket.made.length - tries <= 21, `${Socket.made.length - tries}`);
});

test("one that is closed opens no more", t => {
  const {connection, socket, pass} = opened(t);
  connection.close();
  assert.ok(socket.closed);
  socket.onclose();
  const before = Socket.made.length;
  pass(5000);
  assert.equal(Socket.made.length, before);
});
