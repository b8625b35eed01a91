/// Three helpers for building a page by hand.

/// An element: el("button", {class: "x", onclick: f, "aria-label": "…"}, child, "text", …).
export function el(tag, properties = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat().filter(child => child !== null && child !== undefined));
  return node;
}

/// Writes only what changed: selections and screen readers stay as they are.
export function say(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

export function show(node, shown) {
  if (node.hidden === shown) node.hidden = !shown;
}

/// Makes the children of `parent` those of `keys` in order; makes and updates each by its key, and keeps what is there. A key counts once.
export function keyed(parent, keys, make, update) {
  const there = new Map([...parent.children].map(child => [child.dataset.key, child]));
  let at = null;
  for (const key of new Set(keys)) {
    let node = there.get(String(key));
    if (node) there.delete(String(key));
    else {
      node = make(key);
      node.dataset.key = key;
    }
    const wanted = at ? at.nextElementSibling : parent.firstElementChild;
    if (wanted !== node) parent.insertBefore(node, wanted);
    update?.(node, key);
    at = node;
  }
  for (const node of there.values()) node.remove();
}
