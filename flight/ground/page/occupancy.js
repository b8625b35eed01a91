/// Occupied cells near the vehicle, as cubes; a foxglove.PointCloud of their centres with `resolution_m`.

import * as THREE from "three";
import {Batch} from "./batch.js";
import {pointsOf} from "./geometry.js";

export class OccupancyLayer {
  /// `batched`: drawn as one mesh, as in objects.js.
  constructor(group, batched = false) {
    this.group = group;
    this.box = new THREE.BoxGeometry(1, 1, 1);
    this.material = new THREE.MeshLambertMaterial({color: "#7d8794", transparent: true, opacity: 0.45});
    this.batch = batched ? new Batch(group, this.box, this.material) : null;
  }

  set(cloud, shown) {
    if (this.mesh) {
      this.group.remove(this.mesh);
      this.mesh.dispose();
      this.mesh = null;
    }
    this.batch?.set([], null, 0);
    if (!cloud || !shown) return;
    const points = pointsOf(cloud), count = points.length / 3, edge = (cloud.resolution_m ?? 0.25) * 0.92;
    this.mesh = new THREE.InstancedMesh(this.box, this.material, count);
    const matrix = new THREE.Matrix4();
    for (let i = 0; i < count; ++i) {
      matrix.makeScale(edge, edge, edge).setPosition(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
      this.mesh.setMatrixAt(i, matrix);
    }
    this.mesh.frustumCulled = false;
    this.batch?.set(this.mesh.instanceMatrix.array, null, count);
    this.mesh.visible = !this.batch;
    this.group.add(this.mesh);
  }
}
