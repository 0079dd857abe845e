// SPDX-License-Identifier: Apache-2.0
// The arm at one pose: tubes from origin to origin, a short cylinder along each joint's axis, and the
// frames of base and tool if asked for.
import { ArrowHelper, CylinderGeometry, Group, Mesh, MeshLambertMaterial, Quaternion, SphereGeometry, Vector3 } from "three";
import type { Frames } from "../types";
import type { Tones } from "./theme";

const kUp = new Vector3(0, 1, 0);
const kMm = 1e-3; // of a metre

const vector = ([x, y, z]: number[]): Vector3 => new Vector3(x, y, z).multiplyScalar(kMm);

function tube(from: Vector3, to: Vector3, radius: number, material: MeshLambertMaterial): Mesh {
  const way = to.clone().sub(from), length = way.length();
  const mesh = new Mesh(new CylinderGeometry(radius, radius, length, 14), material);
  mesh.position.copy(from).addScaledVector(way, 0.5);
  mesh.quaternion.copy(new Quaternion().setFromUnitVectors(kUp, way.divideScalar(length || 1)));
  return mesh;
}

export function makeArm(frames: Frames, reach: number, tones: Tones, withFrames: boolean): Group {
  const group = new Group();
  const radius = 0.016 * reach;
  const link = new MeshLambertMaterial({ color: tones.muted }), joint = new MeshLambertMaterial({ color: tones.ink });
  const origins = frames.origins_mm.map(vector);
  origins.forEach((at, i) => {
    const ball = new Mesh(new SphereGeometry(1.05 * radius, 14, 10), link);
    ball.position.copy(at);
    group.add(ball);
    const next = origins[i + 1];
    if (next && at.distanceTo(next) > 1e-6) group.add(tube(at, next, radius, link));
    const axis = frames.axes[i]?.[2];
    if (axis && i > 0 && i < origins.length - 2) {
      const half = new Vector3(axis[0], axis[1], axis[2]).multiplyScalar(1.7 * radius);
      group.add(tube(at.clone().sub(half), at.clone().add(half), 1.45 * radius, joint));
    }
  });
  if (withFrames)
    for (const i of [0, origins.length - 1])
      [tones.vermilion, tones.green, tones.blue].forEach((colour, k) => {
        const way = frames.axes[i]?.[k];
        if (way) group.add(new ArrowHelper(new Vector3(way[0], way[1], way[2]), origins[i], 0.12 * reach, colour));
      });
  return group;
}

export function disposeTree(group: Group): void {
  group.traverse((object) => {
    const mesh = object as Partial<Mesh>;
    mesh.geometry?.dispose();
    for (const material of [mesh.material].flat()) material?.dispose();
  });
}
