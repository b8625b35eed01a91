/// What the picture shows of R1's objects, against a message of them.

import assert from "node:assert/strict";

/// [{id, size, place}] as the meshes have them, m.
export const drawnObjects = page => page.evaluate(() => ["cuboids", "cylinders"].flatMap(shape => {
  const {mesh, ids} = saker.view.robots.get("R1").objects[shape];
  return ids.map((id, i) => ({id, size: [0, 1, 2].map(k => Math.hypot(...mesh.instanceMatrix.array.slice(16 * i + 4 * k, 16 * i + 4 * k + 3))), place: [...mesh.instanceMatrix.array.slice(16 * i + 12, 16 * i + 15)]}));
}));

export function assertDrawn(drawn, sent) {
  assert.deepEqual(drawn.map(({id}) => id).sort((a, b) => a - b), sent.map(({id}) => id).sort((a, b) => a - b));
  for (const object of sent) {
    const {size, place} = drawn.find(({id}) => id === object.id), round = object.shape === "cylinder";
    const [wanted, at] = round ? [[2 * object.radius, 2 * object.radius, object.height], object.root.map((v, k) => v + (object.height / 2) * object.axis[k])] : [object.size, object.position];
    size.forEach((v, k) => assert.ok(Math.abs(v - wanted[k]) < 1e-3, `size of ${object.id}: ${size}`));
    place.forEach((v, k) => assert.ok(Math.abs(v - at[k]) < 1e-3, `place of ${object.id}: ${place}`));
  }
}
