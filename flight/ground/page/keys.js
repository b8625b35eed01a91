/// The keyboard: one key for each layer and view, Shift and a letter for an order.

import {LAYERS} from "./choices.js";
import {el} from "./dom.js";
import {KINDS} from "./orders.js";

const VIEWS = [["a", "all in view"], ["t", "from above"], ["f", "follow the robot"], ["u", "uncertainty: as it is, ×10, off"], ["1 \u2026 9", "choose a robot"], ["Esc", "choose nothing"], ["?", "these keys"]];
const RUN = [["Space", "play or pause the run"], ["\u2190 \u2192", "5 s back or on"]];

/// `actions`: by key, and `order(kind)`, `layer(name)`, `robot(index)`, `step(s)`.
export function listen(actions) {
  document.addEventListener("keydown", event => {
    const typing = event.target.matches?.("input[type=search], select, textarea");
    if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
    const order = event.shiftKey && KINDS.find(({key}) => key === event.key.toUpperCase());
    const layer = !event.shiftKey && LAYERS.find(({key}) => key === event.key);
    if (order && event.repeat) event.preventDefault();  // a key that is held is no second press
    else if (order) actions.order(order.kind);
    else if (layer) actions.layer(layer.name);
    else if (/^[1-9]$/.test(event.key)) actions.robot(Number(event.key) - 1);
    else if (event.key === " " && event.target.matches?.("button, summary")) return;
    else if (event.key.startsWith("Arrow") && event.target.matches?.("input, canvas")) return;
    else if (event.key in actions.keys) actions.keys[event.key]();
    else return;
    event.preventDefault();
  });
}

/// The list of keys, for the dialog.
export function keyList() {
  const rows = [...VIEWS, ...LAYERS.map(({key, text}) => [key, text]), ...RUN, ...KINDS.map(({key, name, does}) => [`Shift+${key}`, `${name}: ${does} (twice)`])];
  return el("dl", {class: "keys"}, rows.flatMap(([key, does]) => [el("dt", {}, el("kbd", {}, key)), el("dd", {}, does)]));
}
