/// Orders to the chosen robot: the first click asks, the second within five seconds sends; then it waits for the acknowledgement and says what came.

import {el, say, show} from "./dom.js";
import {duration} from "./format.js";

export const KINDS = [
  {kind: "hold", name: "Hold", key: "H", does: "stays where it is"},
  {kind: "resume", name: "Resume", key: "R", does: "goes on with what was interrupted"},
  {kind: "return", name: "Return", key: "B", does: "flies home and lands there"},
  {kind: "land", name: "Land", key: "L", does: "lands where it is"},
  {kind: "abort", name: "Abort", key: "A", does: "ends the mission and lands where it is"},
];
const SECOND_CLICK_MS = 5000;

/// What a click on an order does, without a page: the first asks, the second sends. `now` in ms.
export class SecondClick {
  constructor(now) {
    this.now = now;
    this.asked = null;
  }

  /// "ask" or "send" for this robot and kind.
  click(robot, kind) {
    const again = this.isAsked(robot, kind);
    this.asked = again ? null : {robot, kind, until: this.now() + SECOND_CLICK_MS};
    return again ? "send" : "ask";
  }

  isAsked(robot, kind) {
    return this.asked !== null && this.asked.robot === robot && this.asked.kind === kind && this.now() < this.asked.until;
  }

  left_s() {
    return this.asked ? Math.max(0, (this.asked.until - this.now()) / 1000) : 0;
  }

  forget() {
    this.asked = null;
  }
}

export class Orders {
  /// `send(robot, kind)` gives a promise of {state, text, took_s}; `may()` says "" or why no order can be given.
  constructor(parent, {choices, send, may}) {
    Object.assign(this, {choices, send, may, clicks: new SecondClick(() => performance.now()), waiting: new Set()});
    this.buttons = KINDS.map(({kind, name, key, does}) => el("button", {class: "order", "data-kind": kind, title: `${does} (Shift+${key}, twice)`, onclick: () => this.press(kind)}, name));
    this.said = el("p", {class: "said", role: "status", "aria-live": "assertive"});
    const once = event => event.repeat && event.preventDefault();  // a key that is held is no second click
    parent.append(el("div", {class: "buttons", role: "group", "aria-label": "Orders", onkeydown: once}, this.buttons), this.said);
    choices.on(what => what.robot !== undefined && this.clicks.forget());
  }

  async press(kind) {
    const robot = this.choices.robot, {name, does} = KINDS.find(one => one.kind === kind);
    const not = robot ? this.may() : "no robot is chosen";
    if (not) return this.#say("bad", not);
    if (this.clicks.click(robot, kind) === "ask") return this.#say("ask", `${name} ${robot}? It ${does}. Press again to send.`);
    const begun = performance.now(), sent = {robot, kind};
    this.waiting.add(sent);
    this.#say("sent", `${kind} sent to ${robot}: waiting for its acknowledgement`);
    try {
      const {state, text, took_s} = await this.send(robot, kind);
      const words = {acknowledged: `${kind} acknowledged by ${robot} after ${duration(took_s ?? (performance.now() - begun) / 1000)}`, refused: `${kind} refused by ${robot}: ${text}`,
        silent: `${robot} did not answer ${kind}${text ? `: ${text}` : ""}`}[state] ?? `${kind}: ${state} ${text ?? ""}`;
      this.#say(state === "acknowledged" ? "good" : "bad", words);
    } catch (error) {
      this.#say("bad", `${kind} to ${robot} failed: ${error.message}`);
    } finally {
      this.waiting.delete(sent);
      this.update();
    }
    return undefined;
  }

  #say(kind, text) {
    this.said.className = `said ${kind}`;
    say(this.said, text);
    this.update();
  }

  update() {
    const robot = this.choices.robot, not = robot ? this.may() : "no robot is chosen";
    this.buttons.forEach((button, i) => {
      const {kind, name} = KINDS[i], asked = robot && this.clicks.isAsked(robot, kind);
      button.disabled = Boolean(not) || [...this.waiting].some(sent => sent.robot === robot && sent.kind === kind);
      button.classList.toggle("asked", Boolean(asked));
      say(button, asked ? `${name}: again (${Math.ceil(this.clicks.left_s())} s)` : name);
    });
    if (this.said.classList.contains("ask") && !this.clicks.left_s()) {
      this.said.className = "said";
      say(this.said, "nothing was sent");
    }
    if (!not && this.said.textContent === this.not) say(this.said, "");
    if (not && (!this.said.textContent || this.said.textContent === this.not)) {
      this.said.className = "said";
      say(this.said, not);
    }
    this.not = not;
    show(this.said, this.said.textContent !== "");
  }
}
