/// Many of one shape as one mesh. WebGL by software begins anew with each instance, which takes it as long as some hundred vertices do.
///
/// Reads matrices and colours as an InstancedMesh keeps them; makes vertices in the group's frame, m, each with its place, normal and size in the unit shape.

import * as THREE from "three";
import {writeVertices} from "./geometry.js";

const PARTS = {position: 3, normal: 3, color: 3, unitPlace: 3, unitNormal: 3, unitSize: 3};

export class Batch {
  /// `geometry`: of the unit shape, indexed; `material`: takes colours of vertices.
  constructor(group, geometry, material) {
    this.unit = {position: geometry.attributes.position.array, normal: geometry.attributes.normal.array};
    this.index = geometry.index.array;
    this.room = 0;
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.mesh.frustumCulled = false;
    group.add(this.mesh);
  }

  set(matrices, colours, count) {
    if (count > this.room) this.#reserve(Math.max(64, 2 ** Math.ceil(Math.log2(count))));
    const {geometry} = this.mesh, {attributes} = geometry;
    if (count) writeVertices(this.unit, matrices, colours, count, Object.fromEntries(Object.keys(PARTS).map(name => [name, attributes[name].array])));
    for (const name of Object.keys(attributes)) attributes[name].needsUpdate = true;
    geometry.setDrawRange(0, count * this.index.length);
    this.mesh.visible = count > 0;
  }

  #reserve(room) {
    this.room = room;
    this.mesh.geometry.dispose();
    const geometry = new THREE.BufferGeometry(), corners = this.unit.position.length / 3, indices = new Uint32Array(room * this.index.length);
    for (const [name, numbers] of Object.entries(PARTS)) geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(room * corners * numbers), numbers).setUsage(THREE.DynamicDrawUsage));
    for (let i = 0; i < room; ++i) for (let k = 0; k < this.index.length; ++k) indices[i * this.index.length + k] = i * corners + this.index[k];
    geometry.setIndex(new THREE.BufferAttribute(indices, 1));
    this.mesh.geometry = geometry;
  }

  dispose() {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
  }
}
