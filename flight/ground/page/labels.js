/// Words in the picture: robots, places in the tour, the object that is chosen, the gain of the chosen viewpoint.

import {el, say, show} from "./dom.js";

export class Labels {
  constructor(parent, scene) {
    Object.assign(this, {parent, scene, pool: [], wanted: []});
  }

  /// [{point (Vector3 in `map`), text, kind}]; kinds are classes of the style sheet.
  set(labels) {
    this.wanted = labels;
    while (this.pool.length < labels.length) this.pool.push(this.parent.appendChild(el("span", {class: "label"})));
    this.pool.forEach((node, i) => {
      if (i >= labels.length) return show(node, false);
      say(node, labels[i].text);
      node.className = `label ${labels[i].kind}`;
      if (labels[i].colour) node.style.setProperty("--of", labels[i].colour);
      return undefined;
    });
    this.place();
  }

  /// After the camera has moved.
  place() {
    this.wanted.forEach(({point}, i) => {
      const at = this.scene.toScreen(point);
      show(this.pool[i], at !== null);
      if (at) this.pool[i].style.transform = `translate(${at[0].toFixed(1)}px, ${at[1].toFixed(1)}px)`;
    });
  }
}
