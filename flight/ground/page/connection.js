/// The Foxglove WebSocket protocol, version 1, from the client's side: subscribes to channels in JSON, calls services, says when
/// the link is lost and comes back by itself.
///
/// Reads frames of the server, makes calls of `onMessage(topic, data, time_s)` and `onState({link, silent_s, server})`.
/// Source: the protocol's specification, https://github.com/foxglove/ws-protocol/blob/main/docs/spec.md. Knows no page.

export const PROTOCOLS = ["foxglove.websocket.v1", "foxglove.sdk.v1"];
export const SILENT_AFTER_MS = 1200;   // a server says something at least twice a second: then the page says that the link hangs
export const GIVEN_UP_AFTER_MS = 4000; // then the socket is closed and opened anew
const LISTEN_MS = 100;                 // how often that is looked at
const RETRY_MS = [250, 500, 1000];     // then every second
const CALL_MS = 15000;                 // a service that has not answered after this has failed

const MESSAGE = 1, SERVICE_RESPONSE = 3;            // opcodes from the server
const LAST = 5;                                     // of those that there are: time, assets and playback say nothing that we ask for
const SERVICE_REQUEST = 2;                          // opcode to the server
const text = new TextDecoder(), bytes = new TextEncoder();

/// A message's parts: {subscription, time_ns, payload}; the time is a BigInt, ns of the server's clock.
export function readMessage(view) {
  return {
    subscription: view.getUint32(1, true),
    time_ns: view.getBigUint64(5, true),
    payload: new Uint8Array(view.buffer, view.byteOffset + 13, view.byteLength - 13),
  };
}

/// A service's answer: {service, call, encoding, payload}.
export function readAnswer(view) {
  const named = view.getUint32(9, true);
  const at = view.byteOffset + 13;
  return {
    service: view.getUint32(1, true),
    call: view.getUint32(5, true),
    encoding: text.decode(new Uint8Array(view.buffer, at, named)),
    payload: new Uint8Array(view.buffer, at + named, view.byteLength - 13 - named),
  };
}

/// The frame of a call in JSON.
export function writeCall(service, call, request) {
  const encoding = bytes.encode("json"), payload = bytes.encode(JSON.stringify(request));
  const frame = new Uint8Array(13 + encoding.length + payload.length);
  const view = new DataView(frame.buffer);
  view.setUint8(0, SERVICE_REQUEST);
  view.setUint32(1, service, true);
  view.setUint32(5, call, true);
  view.setUint32(9, encoding.length, true);
  frame.set(encoding, 13);
  frame.set(payload, 13 + encoding.length);
  return frame;
}

export class Connection {
  /// `wanted(topic)` says which channels are subscribed to; `resubscribe` asks it again.
  constructor({url, wanted = () => true, onMessage, onState, WebSocket = globalThis.WebSocket, now = () => performance.now()}) {
    Object.assign(this, {url, wanted, onMessage, onState, WebSocket, now});
    this.channels = new Map();       // by the server's id
    this.services = new Map();       // by name
    this.subscriptions = new Map();  // by our id: the channel
    this.calls = new Map();          // waiting: by our id
    this.next = 1;
    this.tries = 0;
    this.link = "opening";
    this.server = null;
    this.unreadable = 0;  // messages that were not what they should be
  }

  open() {
    this.watch ??= setInterval(() => this.#listen(), LISTEN_MS);
    this.#connect();
  }

  close() {
    clearInterval(this.watch);
    clearTimeout(this.retry);
    this.ended = true;
    this.socket?.close();
  }

  #connect() {
    this.heard = this.now();
    const socket = new this.WebSocket(this.url, PROTOCOLS);
    socket.binaryType = "arraybuffer";
    socket.onmessage = ({data}) => this.socket === socket && this.#take(data);
    socket.onclose = () => this.socket === socket && this.#lose();
    socket.onerror = () => {};  // a close follows
    this.socket = socket;
  }

  #lose() {
    for (const {fail} of this.calls.values()) fail(new Error("the link was lost before the answer came"));
    this.calls.clear();
    for (const map of [this.channels, this.services, this.subscriptions]) map.clear();
    this.socket = this.server = null;
    if (this.ended) return;
    this.#say("lost");
    this.retry = setTimeout(() => this.#connect(), RETRY_MS[Math.min(this.tries++, RETRY_MS.length - 1)]);
  }

  #say(link) {
    this.link = link;
    this.onState?.({link, silent_s: (this.now() - this.heard) / 1000, server: this.server});
  }

  #listen() {
    if (!this.socket) return;
    const silent = this.now() - this.heard;
    if (this.server && (this.spoke !== this.socket || this.server.metadata?.mode === "run")) return;  // nobody flies, or a run is paused: nothing to say
    if (silent > GIVEN_UP_AFTER_MS) {
      const socket = this.socket;
      this.#lose();  // at once: the close of a link that hangs takes its time
      socket.close();
    } else if (silent > SILENT_AFTER_MS && this.link !== "lost") this.#say("silent");  // lost it stays until the server speaks
  }

  #take(data) {
    this.heard = this.now();
    if (this.link === "silent") this.#say("open");
    try {
      if (typeof data === "string") this.#takeText(JSON.parse(data));
      else this.#takeBinary(new DataView(data));
    } catch (error) {
      this.unreadable += 1;
      console.warn(`unreadable message: ${error.message}`);
    }
  }

  #takeText(message) {
    switch (message.op) {
      case "serverInfo":
        this.server = message;
        this.tries = 0;
        return this.#say("open");
      case "advertise":
        for (const channel of message.channels) this.channels.set(channel.id, channel);
        return this.resubscribe();
      case "unadvertise":
        for (const id of message.channelIds) this.#forget(id);
        return undefined;
      case "advertiseServices":
        for (const service of message.services) this.services.set(service.name, service);
        return this.onState?.({link: this.link, silent_s: 0, server: this.server});
      case "unadvertiseServices":
        for (const [name, {id}] of this.services) if (message.serviceIds.includes(id)) this.services.delete(name);
        return undefined;
      case "serviceCallFailure":
        return this.#settle(message.callId, ({fail}) => fail(new Error(message.message)));
      default:
        return undefined;
    }
  }

  #takeBinary(view) {
    const opcode = view.getUint8(0);
    this.spoke = this.socket;
    if (opcode === MESSAGE) {
      const {subscription, time_ns, payload} = readMessage(view);
      const channel = this.subscriptions.get(subscription);
      if (channel) this.onMessage(channel.topic, JSON.parse(text.decode(payload)), Number(time_ns) / 1e9);
    } else if (opcode === SERVICE_RESPONSE) {
      const answer = readAnswer(view);
      this.#settle(answer.call, ({done, fail}) => {
        try {
          done(JSON.parse(text.decode(answer.payload)));
        } catch (error) {
          fail(new Error("the answer cannot be read"));
          throw error;
        }
      });
    } else if (opcode === 0 || opcode > LAST) throw new Error(`opcode ${opcode}`);
  }

  #settle(call, how) {
    const waiting = this.calls.get(call);
    if (!waiting) return;
    this.calls.delete(call);
    clearTimeout(waiting.timer);
    how(waiting);
  }

  #forget(channelId) {
    this.channels.delete(channelId);
    for (const [id, channel] of this.subscriptions) if (channel.id === channelId) this.subscriptions.delete(id);
  }

  /// Subscribes to what is wanted and not yet subscribed to, and leaves what is not wanted any more.
  resubscribe() {
    const subscribed = new Set([...this.subscriptions.values()].map(({id}) => id));
    const add = [], leave = [];
    for (const channel of this.channels.values()) {
      if (channel.encoding !== "json" || subscribed.has(channel.id) || !this.wanted(channel.topic, channel)) continue;
      this.subscriptions.set(this.next, channel);
      add.push({id: this.next++, channelId: channel.id});
    }
    for (const [id, channel] of this.subscriptions) {
      if (this.wanted(channel.topic, channel)) continue;
      this.subscriptions.delete(id);
      leave.push(id);
    }
    if (add.length) this.#send({op: "subscribe", subscriptions: add});
    if (leave.length) this.#send({op: "unsubscribe", subscriptionIds: leave});
  }

  #send(message) {
    this.socket?.send(JSON.stringify(message));
  }

  /// Calls a service. Fails where there is none of that name, the link is lost, or no answer came in time.
  call(name, request) {
    const service = this.services.get(name);
    if (!service || this.link !== "open") return Promise.reject(new Error(service ? "the link is lost" : `no service ${name} at this server`));
    const call = this.next++;
    return new Promise((done, fail) => {
      const timer = setTimeout(() => {
        this.calls.delete(call);
        fail(new Error(`no answer within ${CALL_MS / 1000} s`));
      }, CALL_MS);
      this.calls.set(call, {done, fail, timer});
      this.socket.send(writeCall(service.id, call, request));
    });
  }
}
