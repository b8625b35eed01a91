/// Objects of a map as they are: cuboids with their front, cylinders, local ground planes; instanced, so that ten thousand are three calls, or, where
/// WebGL is computed by the processor, in one mesh each.
///
/// Reads objects of /R1/objects (m, frame of the group they are put into); `pick` says which one a ray hits.

import * as THREE from "three";
import {Batch} from "./batch.js";
import {ofClass} from "./colours.js";

const UP = new THREE.Vector3(0, 0, 1);
const FRONT_M = 0.9;  // length of the mark at a cuboid's front, at most a third of it

// Edges are drawn darker than faces, and a cuboid's front carries an arrow on top and a light band before: its heading is seen from everywhere.
const VERTEX = {
  "#include <common>": `#include <common>
    varying vec3 vPlace; varying vec3 vSize; varying vec3 vNormalOf;
    #ifndef USE_INSTANCING
      attribute vec3 unitPlace; attribute vec3 unitNormal; attribute vec3 unitSize;
    #endif`,
  "#include <begin_vertex>": `#include <begin_vertex>
    #ifdef USE_INSTANCING
      vPlace = position; vNormalOf = normal;
      vSize = vec3(length(instanceMatrix[0].xyz), length(instanceMatrix[1].xyz), length(instanceMatrix[2].xyz));
    #else
      vPlace = unitPlace; vNormalOf = unitNormal; vSize = unitSize;
    #endif`,
};
const CUBOID_FRAGMENT = {
  "#include <common>": "#include <common>\nvarying vec3 vPlace; varying vec3 vSize; varying vec3 vNormalOf;",
  "#include <color_fragment>": `#include <color_fragment>
    vec3 off = (0.5 - abs(vPlace)) * vSize;            // metres to the faces
    vec3 along = mix(off, vec3(1e3), step(0.5, abs(vNormalOf)));
    float near = min(along.x, min(along.y, along.z));
    float pixel = max(fwidth(vPlace.x * vSize.x), max(fwidth(vPlace.y * vSize.y), fwidth(vPlace.z * vSize.z)));
    float front = min(${FRONT_M.toFixed(1)}, vSize.x / 3.0);
    float fromFront = (0.5 - vPlace.x) * vSize.x;
    float aside = abs(vPlace.y) * vSize.y;
    float arrow = step(0.5, vNormalOf.z) * step(aside * (front / (vSize.y * 0.42)), fromFront - 0.12) * step(fromFront, front + 0.12) * step(aside, vSize.y * 0.42);
    float band = step(0.5, vNormalOf.x) * step(abs(vPlace.z), 0.22);
    diffuseColor.rgb = mix(diffuseColor.rgb, vec3(1.0), 0.82 * max(arrow, band));
    diffuseColor.rgb = mix(diffuseColor.rgb * 0.32, diffuseColor.rgb, smoothstep(0.7 * pixel, 1.7 * pixel, near));`,
};

function marked(material, fragment) {
  material.onBeforeCompile = shader => {
    for (const [where, what] of Object.entries(VERTEX)) shader.vertexShader = shader.vertexShader.replace(where, what);
    for (const [where, what] of Object.entries(fragment)) shader.fragmentShader = shader.fragmentShader.replace(where, what);
  };
  return material;
}

/// Instances of one shape, as many as are needed. `batched`: drawn as one mesh; the instances say where they are, and are what a ray hits.
class Instances {
  constructor(group, geometry, material, batched = false) {
    Object.assign(this, {group, geometry, material, mesh: null, ids: []});
    this.batch = batched ? new Batch(group, geometry, material) : null;
    if (batched) material.vertexColors = true;
  }

  reserve(count) {
    if (this.mesh && this.mesh.instanceMatrix.count >= count) return;
    if (this.mesh) {
      this.group.remove(this.mesh);
      this.mesh.dispose();
    }
    const room = Math.max(64, 2 ** Math.ceil(Math.log2(count + 1)));
    this.mesh = new THREE.InstancedMesh(this.geometry, this.material, room);
    this.mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
    this.mesh.setColorAt(0, new THREE.Color());
    this.mesh.frustumCulled = false;
    this.mesh.visible = !this.batch;
    this.group.add(this.mesh);
  }

  finish(ids) {
    this.ids = ids;
    if (!this.mesh) return;
    this.mesh.count = ids.length;
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
    this.mesh.boundingSphere = null;
    this.batch?.set(this.mesh.instanceMatrix.array, this.mesh.instanceColor?.array, ids.length);
  }
}

const rotation = new THREE.Quaternion(), matrix = new THREE.Matrix4(), place = new THREE.Vector3(), size = new THREE.Vector3(), axis = new THREE.Vector3();

/// Pose and size of an object's mesh.
export function matrixOf(object) {
  if (object.shape === "cylinder") {
    axis.fromArray(object.axis ?? [0, 0, 1]);
    rotation.setFromUnitVectors(UP, axis.normalize());
    place.fromArray(object.root).addScaledVector(axis, object.height / 2);
    size.set(2 * object.radius, 2 * object.radius, object.height);
  } else {
    rotation.fromArray(object.rotation);
    place.fromArray(object.position);
    size.fromArray(object.size);
  }
  return matrix.compose(place, rotation, size);
}

export class ObjectLayer {
  /// Ground planes go into `below`, which stays where the objects fade; `batched`: as `Instances` has it.
  constructor(group, below = group, batched = false) {
    this.group = group;
    const lit = () => new THREE.MeshLambertMaterial();
    this.cuboids = new Instances(group, new THREE.BoxGeometry(1, 1, 1), marked(lit(), CUBOID_FRAGMENT), batched);
    this.cylinders = new Instances(group, new THREE.CylinderGeometry(0.5, 0.5, 1, 12).rotateX(Math.PI / 2), lit(), batched);
    const earth = new THREE.MeshBasicMaterial({color: "#e2dccf"});
    this.planes = new Instances(below, new THREE.CircleGeometry(1, 20), earth);
  }

  /// `colourOf(object)` gives a CSS colour.
  set(objects, ground = [], colourOf = object => object.colour ?? ofClass(object.class).colour) {
    const colour = new THREE.Color();
    for (const [instances, shape] of [[this.cuboids, "cuboid"], [this.cylinders, "cylinder"]]) {
      const shown = objects.filter(object => (object.shape === "cylinder") === (shape === "cylinder"));
      if (shown.length) instances.reserve(shown.length);
      shown.forEach((object, i) => {
        instances.mesh.setMatrixAt(i, matrixOf(object));
        const given = colourOf(object);
        if (Array.isArray(given)) colour.setRGB(...given, THREE.SRGBColorSpace);
        else colour.set(given);
        instances.mesh.setColorAt(i, colour);
      });
      instances.finish(shown.map(({id}) => id));
    }
    this.#setGround(ground);
  }

  #setGround(ground) {
    if (ground.length) this.planes.reserve(ground.length);
    const colour = new THREE.Color("#ffffff");
    ground.forEach(({normal, point, radius}, i) => {
      rotation.setFromUnitVectors(UP, axis.fromArray(normal));
      this.planes.mesh.setMatrixAt(i, matrix.compose(place.fromArray(point), rotation, size.set(radius, radius, 1)));
      this.planes.mesh.setColorAt(i, colour);
    });
    this.planes.finish(ground.map((_, i) => i));
    if (this.planes.mesh) this.planes.mesh.renderOrder = -1;
  }

  setOpacity(opacity) {
    for (const {material} of [this.cuboids, this.cylinders]) {
      material.opacity = opacity;
      if (material.transparent !== opacity < 1) [material.transparent, material.needsUpdate] = [opacity < 1, true];
      material.depthWrite = opacity > 0.5;
    }
    this.group.visible = opacity > 0.01;
  }

  /// {id, distance} of the nearest object on a ray; null: none.
  pick(caster) {
    if (!this.group.visible) return null;
    let best = null;
    for (const {mesh, ids} of [this.cuboids, this.cylinders]) {
      const hit = mesh && caster.intersectObject(mesh, false)[0];
      if (hit && (!best || hit.distance < best.distance)) best = {id: ids[hit.instanceId], distance: hit.distance};
    }
    return best;
  }
}

/// A dark hull about the object that is chosen.
export class Highlight {
  constructor() {
    this.material = new THREE.MeshBasicMaterial({color: "#111111", side: THREE.BackSide});
    this.box = new THREE.Mesh(new THREE.BoxGeometry(1, 1, 1), this.material);
    this.tube = new THREE.Mesh(new THREE.CylinderGeometry(0.5, 0.5, 1, 16).rotateX(Math.PI / 2), this.material);
  }

  set(group, object, margin_m = 0.1) {
    for (const mesh of [this.box, this.tube]) mesh.removeFromParent();
    if (!object) return;
    const mesh = object.shape === "cylinder" ? this.tube : this.box;
    matrixOf(object).decompose(mesh.position, mesh.quaternion, mesh.scale);
    mesh.scale.addScalar(2 * margin_m);
    group.add(mesh);
  }
}
