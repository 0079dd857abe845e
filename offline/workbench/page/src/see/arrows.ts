// SPDX-License-Identifier: Apache-2.0
// Error arrows: a shaft and a head each, all of one kind in two draw calls.
import { BufferGeometry, ConeGeometry, CylinderGeometry, Color, Group, InstancedMesh, Matrix4, MeshBasicMaterial, Quaternion, Vector3 } from "three";

const kSides = 5;
const kHead = 2.6, kHeadLength = 7; // times the radius of the shaft
const kUp = new Vector3(0, 1, 0);

export interface Arrow { from: Vector3; along: Vector3; colour: Color }

function unit(geometry: BufferGeometry): BufferGeometry {
  return geometry.translate(0, 0.5, 0);
}

export class Arrows {
  readonly group = new Group();
  private readonly shafts: InstancedMesh;
  private readonly heads: InstancedMesh;

  constructor(arrows: Arrow[], radius: number) {
    const material = new MeshBasicMaterial();
    this.shafts = new InstancedMesh(unit(new CylinderGeometry(1, 1, 1, kSides, 1, true)), material, arrows.length);
    this.heads = new InstancedMesh(unit(new ConeGeometry(1, 1, kSides, 1, true)), material, arrows.length);
    const matrix = new Matrix4(), turn = new Quaternion(), size = new Vector3(), at = new Vector3(), way = new Vector3();
    arrows.forEach(({ from, along, colour }, i) => {
      const length = along.length();
      const head = Math.min(kHeadLength * radius, 0.6 * length);
      way.copy(along).divideScalar(length || 1);
      turn.setFromUnitVectors(kUp, way);
      size.set(radius, Math.max(length - head, 1e-9), radius);
      this.shafts.setMatrixAt(i, matrix.compose(from, turn, size));
      at.copy(from).addScaledVector(way, length - head);
      size.set(kHead * radius, Math.max(head, 1e-9), kHead * radius);
      this.heads.setMatrixAt(i, matrix.compose(at, turn, size));
      this.shafts.setColorAt(i, colour);
      this.heads.setColorAt(i, colour);
    });
    for (const mesh of [this.shafts, this.heads]) {
      mesh.frustumCulled = false;
      this.group.add(mesh);
    }
  }

  /** Draws the first n only. */
  show(n: number): void {
    this.shafts.count = this.heads.count = n;
  }

  dispose(): void {
    for (const mesh of [this.shafts, this.heads]) {
      mesh.geometry.dispose();
      (mesh.material as MeshBasicMaterial).dispose();
      mesh.dispose();
    }
  }
}
