/// The robot itself: a quadrotor with its nose, and a plumb line to the ground.

import * as THREE from "three";

const ARM_M = 0.45, SIZE = 1.6;  // a little larger than it is: it must be found

export class VehicleLayer {
  constructor(odom, colour) {
    this.odom = odom;
    this.body = new THREE.Group();
    const paint = new THREE.MeshLambertMaterial({color: colour}), dark = new THREE.MeshLambertMaterial({color: "#1f2933"});
    this.body.add(new THREE.Mesh(new THREE.BoxGeometry(0.5, 0.3, 0.16), paint));
    const nose = new THREE.Mesh(new THREE.ConeGeometry(0.16, 0.5, 4).rotateZ(-Math.PI / 2), paint);
    nose.position.x = 0.5;
    this.body.add(nose);
    for (const [i, j] of [[1, 1], [1, -1], [-1, 1], [-1, -1]]) {
      const rotor = new THREE.Mesh(new THREE.CylinderGeometry(0.24, 0.24, 0.03, 20).rotateX(Math.PI / 2), dark);
      rotor.position.set(i * ARM_M, j * ARM_M, 0.1);
      const arm = new THREE.Mesh(new THREE.BoxGeometry(ARM_M * 1.4, 0.06, 0.05), paint);
      arm.position.set((i * ARM_M) / 2, (j * ARM_M) / 2, 0.05);
      arm.rotation.z = Math.atan2(j, i);
      this.body.add(rotor, arm);
    }
    for (const part of this.body.children) part.userData.first = true;
    this.body.scale.setScalar(SIZE);
    this.plumb = new THREE.Line(new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), new THREE.Vector3(0, 0, -1)]), new THREE.LineBasicMaterial({color: colour}));
    this.shadow = new THREE.Mesh(new THREE.CircleGeometry(0.5, 24), new THREE.MeshBasicMaterial({color: colour, transparent: true, opacity: 0.35, depthWrite: false}));
    for (const part of [this.body, this.plumb, this.shadow]) {
      part.visible = false;
      odom.add(part);
    }
    this.place = null;  // in `map`, once known
  }

  /// A pose of /R1/odometry; `floor_m` is the height of the ground, in the same frame.
  set({position, orientation}, floor_m) {
    this.body.position.fromArray(position);
    this.body.quaternion.fromArray(orientation);
    this.plumb.position.fromArray(position);
    this.plumb.scale.z = Math.max(0.01, position[2] - floor_m);
    this.shadow.position.set(position[0], position[1], floor_m + 0.03);
    for (const part of [this.body, this.plumb, this.shadow]) part.visible = true;
    this.place = this.body.getWorldPosition(new THREE.Vector3());
  }
}
