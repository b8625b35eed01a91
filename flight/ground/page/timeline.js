/// The slider of a finished run: play, pause, how fast, where. Reads /playback; calls the services `play` and `seek`.

import {el, say, show} from "./dom.js";
import {duration} from "./format.js";

const SPEEDS = [0.25, 0.5, 1, 2, 4, 10, 30];
const SEEK_EVERY_MS = 150;  // while the slider is dragged

export class Timeline {
  constructor(parent, {store, call}) {
    Object.assign(this, {parent, store, call, speed: 1});
    this.button = el("button", {class: "play", onclick: () => this.toggle()}, "Play");
    this.slider = el("input", {type: "range", min: 0, max: 1, step: 0.1, "aria-label": "Time of the run, s", oninput: () => this.#drag(), onchange: () => this.#drop(),
      onpointerup: () => this.#drop(), onpointercancel: () => this.#drop(), onblur: () => this.#drop()});  // back where it was there is no change
    this.speeds = el("select", {"aria-label": "Speed", onchange: () => this.setSpeed(Number(this.speeds.value))}, SPEEDS.map(speed => el("option", {value: speed}, `${speed}\u00a0×`)));
    this.text = el("output", {});
    parent.append(this.button, this.slider, this.text, this.speeds);
  }

  update() {
    const playback = this.store.playback;
    show(this.parent, playback !== null);
    if (!playback || this.dragging) return;
    const {begin_s, end_s, t_s, playing, speed} = playback;
    this.slider.min = begin_s;
    this.slider.max = end_s;
    this.slider.value = t_s;
    this.speeds.value = String(SPEEDS.reduce((a, b) => (Math.abs(b - speed) < Math.abs(a - speed) ? b : a)));
    this.speed = speed;
    say(this.button, playing ? "Pause" : t_s >= end_s - 0.05 ? "Again" : "Play");
    this.button.setAttribute("aria-pressed", String(playing));
    this.#words(t_s);
  }

  #words(t_s) {
    const {begin_s, end_s} = this.store.playback;
    say(this.text, `${duration(t_s - begin_s)} of ${duration(end_s - begin_s)}`);
    this.slider.setAttribute("aria-valuetext", this.text.textContent);
    this.slider.style.setProperty("--part", `${(100 * (t_s - begin_s)) / Math.max(1e-9, end_s - begin_s)}%`);
  }

  async #ask(service, request) {
    try {
      this.store.playback = await this.call(service, request);
      this.update();
    } catch (error) {
      say(this.text, error.message);
    }
  }

  async toggle() {
    const {playing, t_s, begin_s, end_s} = this.store.playback ?? {};
    if (!playing && t_s >= end_s - 0.05) await this.#ask("seek", {t_s: begin_s});
    return this.#ask("play", {playing: !playing, speed: this.speed});
  }

  setSpeed(speed) {
    this.speed = speed;
    return this.#ask("play", {playing: this.store.playback.playing, speed});
  }

  step(seconds) {
    const {t_s, begin_s, end_s} = this.store.playback;
    return this.#ask("seek", {t_s: Math.min(end_s, Math.max(begin_s, t_s + seconds))});
  }

  #drag() {
    this.dragging = true;
    this.#words(Number(this.slider.value));
    const now = performance.now();
    if (now - (this.sought ?? 0) < SEEK_EVERY_MS) return;
    this.sought = now;
    this.call("seek", {t_s: Number(this.slider.value)}).catch(() => {});
  }

  async #drop() {
    if (!this.dragging || this.dropping) return;
    this.dropping = true;
    await this.#ask("seek", {t_s: Number(this.slider.value)});
    this.dragging = this.dropping = false;
  }
}
