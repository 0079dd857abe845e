// SPDX-License-Identifier: Apache-2.0
// Error arrows, all of one kind in one draw call: flat, three triangles each, turned about their own axis so that they
// face the eye. One mesh without instances: software GL draws each instance by itself, which takes several times as long.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Group, Mesh, ShaderMaterial, Vector3 } from "three";

export interface Arrow { from: Vector3; along: Vector3 }

// Corners: place along the arrow (0 tail, 1 foot of the head, 2 tip), side, and how many radii from the axis.
const kCorners = [0, -1, 1, 0, 1, 1, 1, -1, 1, 1, 1, 1, 1, -1, 2.6, 1, 1, 2.6, 2, 0, 0];
const kTriangles = [0, 2, 1, 1, 2, 3, 4, 6, 5];

const kVertex = `
attribute vec3 from;
attribute vec3 along;
uniform float radius;
void main() {
  float size = max(length(along), 1e-9), head = min(7.0 * radius, 0.6 * size);
  vec3 way = along / size;
  vec3 eye = vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2]);
  vec3 side = cross(way, eye);
  if (length(side) < 1e-4) side = cross(way, vec3(viewMatrix[0][1], viewMatrix[1][1], viewMatrix[2][1]));
  float place = position.x < 0.5 ? 0.0 : position.x < 1.5 ? size - head : size;
  vec3 corner = from + place * way + position.y * position.z * radius * normalize(side);
  gl_Position = projectionMatrix * viewMatrix * vec4(corner, 1.0);
}`;
const kFragment = `
uniform vec3 colour;
void main() {
  gl_FragColor = vec4(colour, 1.0);
  #include <colorspace_fragment>
}`;

export class Arrows {
  readonly group = new Group();
  private readonly geometry = new BufferGeometry();
  private readonly material: ShaderMaterial;

  constructor(arrows: Arrow[], radius: number, colour: Color) {
    const corners = kCorners.length / 3;
    const place = new Float32Array(kCorners.length * arrows.length), index = new Uint32Array(kTriangles.length * arrows.length);
    const from = new Float32Array(place.length), along = new Float32Array(place.length);
    arrows.forEach((arrow, i) => {
      place.set(kCorners, kCorners.length * i);
      kTriangles.forEach((corner, k) => { index[kTriangles.length * i + k] = corners * i + corner; });
      for (let c = corners * i; c < corners * (i + 1); ++c) {
        arrow.from.toArray(from, 3 * c);
        arrow.along.toArray(along, 3 * c);
      }
    });
    this.geometry.setAttribute("position", new BufferAttribute(place, 3));
    this.geometry.setAttribute("from", new BufferAttribute(from, 3));
    this.geometry.setAttribute("along", new BufferAttribute(along, 3));
    this.geometry.setIndex(new BufferAttribute(index, 1));
    this.material = new ShaderMaterial({
      vertexShader: kVertex, fragmentShader: kFragment, side: DoubleSide, uniforms: { radius: { value: radius }, colour: { value: colour } },
    });
    const mesh = new Mesh(this.geometry, this.material);
    mesh.frustumCulled = false;
    this.group.add(mesh);
  }

  /** Draws the first n only. */
  show(n: number): void {
    this.geometry.setDrawRange(0, kTriangles.length * n);
  }

  dispose(): void {
    this.geometry.dispose();
    this.material.dispose();
  }
}
