/// As much of a document as the page's panels use, for tests without a browser: elements, attributes, classes, text, events. `made()` puts a new
/// one into `globalThis.document`.

class Made extends EventTarget {
  constructor(tag) {
    super();
    Object.assign(this, {tagName: tag.toUpperCase(), childNodes: [], parent: null, attributes: new Map(), scrollTop: 0, clientHeight: 400});
    this.style = {setProperty: (name, value) => { this.style[name] = value; }};
    this.dataset = new Proxy({}, {
      get: (_, name) => this.attributes.get(`data-${String(name)}`),
      set: (_, name, value) => (this.attributes.set(`data-${name}`, String(value)), true),
    });
    this.classList = {
      contains: name => this.className.split(" ").includes(name),
      toggle: (name, on = !this.classList.contains(name)) => {
        const others = this.className.split(" ").filter(word => word && word !== name);
        this.className = [...others, ...(on ? [name] : [])].join(" ");
      },
    };
  }

  get children() { return this.childNodes.filter(child => typeof child !== "string"); }
  get firstElementChild() { return this.children[0] ?? null; }
  get nextElementSibling() {
    const among = this.parent?.children ?? [];
    return among[among.indexOf(this) + 1] ?? null;
  }

  setAttribute(name, value) { this.attributes.set(name, String(value)); }
  getAttribute(name) { return this.attributes.get(name) ?? null; }
  toggleAttribute(name, on) {
    if (on) this.attributes.set(name, "");
    else this.attributes.delete(name);
  }

  remove() {
    if (this.parent) this.parent.childNodes = this.parent.childNodes.filter(child => child !== this);
    this.parent = null;
  }
  insertBefore(node, before) {
    if (typeof node !== "string") {
      node.remove();
      node.parent = this;
    }
    const at = before ? this.childNodes.indexOf(before) : this.childNodes.length;
    this.childNodes.splice(at, 0, node);
    return node;
  }
  appendChild(node) { return this.insertBefore(node, null); }
  append(...nodes) { for (const node of nodes) this.appendChild(node instanceof Made ? node : String(node)); }
  replaceChildren(...nodes) {
    for (const child of this.children) child.remove();
    this.childNodes = [];
    this.append(...nodes);
  }

  get textContent() { return this.childNodes.map(child => (typeof child === "string" ? child : child.textContent)).join(""); }
  set textContent(text) { this.replaceChildren(...(text === "" ? [] : [text])); }

  /// Elements below it, itself not among them, that are so.
  all(so) { return this.children.flatMap(child => [...(so(child) ? [child] : []), ...child.all(so)]); }
  byClass(name) { return this.all(node => node.classList.contains(name)); }

  /// An event with these properties; false where its default is prevented.
  fire(type, properties = {}) { return this.dispatchEvent(Object.assign(new Event(type, {cancelable: true}), properties)); }
  click() { if (!this.disabled) this.fire("click"); }
}

// Properties that are attributes of the same name, or of another.
for (const [property, attribute] of [["className", "class"], ["title", "title"], ["value", "value"], ["id", "id"]]) {
  Object.defineProperty(Made.prototype, property, {
    get() { return this.attributes.get(attribute) ?? ""; },
    set(value) { this.attributes.set(attribute, String(value)); },
  });
}
for (const property of ["hidden", "disabled"]) {
  Object.defineProperty(Made.prototype, property, {
    get() { return this.attributes.has(property); },
    set(on) { this.toggleAttribute(property, on); },
  });
}

/// A new document, which the page's modules find, and what else they ask a browser for.
export function made() {
  const document = new Made("document");
  document.createElement = tag => new Made(tag);
  document.createElementNS = (_, tag) => new Made(tag);
  globalThis.document = document;
  globalThis.ResizeObserver = class { observe() {} };
  globalThis.matchMedia = () => ({matches: false});
  return document.appendChild(new Made("main"));
}

/// Promises that are fulfilled are gone through.
export const settled = () => new Promise(done => setImmediate(done));

/// Text as it is read: no-break spaces are spaces.
export const plain = text => text.replaceAll("\u00a0", " ");
