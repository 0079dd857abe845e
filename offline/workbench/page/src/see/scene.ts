// SPDX-License-Identifier: Apache-2.0
// The 3-D view, in metres, z up, without perspective: an arrow is as long wherever it stands. Drawn when
// something changed, never in a loop.
import {
  AmbientLight, Box3, BufferAttribute, BufferGeometry, Color, DirectionalLight, GridHelper, Group, Mesh, MeshBasicMaterial,
  OrthographicCamera, Points, PointsMaterial, Scene, TorusGeometry, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Columns3, Frames, Poses } from "../types";
import { disposeTree, makeArm } from "./arm";
import { Arrows, type Arrow } from "./arrows";
import { spreadOrder } from "./spread";
import type { Tones } from "./theme";

export type Eye = "orbit" | "top" | "side" | "front";
export type Shown = "both" | "before" | "after";

export const kMovingArrows = 1600, kStillArrows = 3200; // drawn at most: software GL needs 60 ms for 3000
const kSettle = 250;                                   // [ms] after the last move until all are drawn
const kMm = 1e-3;
const kFill = 0.92; // of the half view: where the outermost point stands
const kPickRadius = 14; // [px]

const kEyes: Record<Eye, [number, number, number]> = {
  orbit: [1.0, -1.3, 0.8], top: [0, -1e-4, 1], side: [0, -1, 0], front: [1, 0, 0],
};

export interface Content {
  poses: Poses;
  shown: Shown;
  factor: number;
  heldOnly: boolean;
  brushed: Set<number> | null;
  region: Set<number>; // rows of the worst region, if it is highlighted
  tones: Tones;
}

const at3 = (columns: Columns3, i: number): Vector3 | null => {
  const [x, y, z] = [columns[0][i], columns[1][i], columns[2][i]];
  return x === null || y === null || z === null ? null : new Vector3(x, y, z).multiplyScalar(kMm);
};

/** Whether the processor draws: then smooth edges would double the time of a frame. */
function isSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const name = gl?.getExtension("WEBGL_debug_renderer_info");
  const software = name ? /swiftshader|llvmpipe|software/i.test(String(gl?.getParameter(name.UNMASKED_RENDERER_WEBGL))) : false;
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return software;
}

export class View3d {
  /** Says how many arrows are drawn, and of how many. */
  onThinned: (drawn: number, of: number) => void = () => undefined;
  onPick: (index: number) => void = () => undefined;

  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera();
  private readonly controls: OrbitControls;
  private readonly content = new Group();
  private arm = new Group();
  private readonly ring: Mesh<TorusGeometry, MeshBasicMaterial>;
  private arrows: Arrows[] = [];
  private arrowCount = 0;
  private poses: Poses | null = null;
  private reach = 1;
  private middle = new Vector3();
  private extent = 1; // [m]: from the middle to the farthest point
  private asked = 0;
  private settle = 0;
  private moving = false;
  private eye: Eye = "orbit";
  private touched = false; // turned or zoomed by hand since

  /** Throws if the browser has no WebGL. */
  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: !isSoftware(), preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => this.moved());
    this.controls.addEventListener("start", () => { this.touched = true; });
    const sun = new DirectionalLight(0xffffff, 2);
    sun.position.set(0.6, -1, 1.4);
    this.ring = new Mesh(new TorusGeometry(1, 0.16, 8, 40), new MeshBasicMaterial({ depthTest: false }));
    this.ring.renderOrder = 2;
    this.ring.visible = false;
    this.scene.add(new AmbientLight(0xffffff, 1.6), sun, this.content, this.arm, this.ring);
    let down: [number, number] = [0, 0];
    canvas.addEventListener("pointerdown", (event) => { down = [event.clientX, event.clientY]; });
    canvas.addEventListener("pointerup", (event) => {
      if (Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4) this.pickAt(event);
    });
  }

  resize(width: number, height: number): void {
    if (width < 1 || height < 1) return;
    this.renderer.setSize(width, height, false);
    this.frame();
    if (!this.touched) this.lookFrom(this.eye);
    this.draw();
  }

  /** Looks from one side at everything. */
  lookFrom(eye: Eye): void {
    const [x, y, z] = kEyes[eye];
    this.eye = eye;
    this.touched = false;
    const centre = this.middle;
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).add(new Vector3(x, y, z).setLength(4 * this.reach));
    this.camera.zoom = 1;
    this.controls.enableRotate = eye === "orbit";
    this.frame();
    this.controls.update();
    this.fill();
    this.draw();
  }

  turn(dx: number, dy: number): void {
    const arm = this.camera.position.clone().sub(this.controls.target);
    arm.applyAxisAngle(new Vector3(0, 0, 1), dx);
    const side = new Vector3().crossVectors(this.camera.up, arm).normalize();
    const tilted = arm.clone().applyAxisAngle(side, dy);
    if (Math.abs(tilted.clone().normalize().z) < 0.995) arm.copy(tilted);
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
    this.touched = true;
    this.moved();
  }

  zoom(times: number): void {
    this.touched = true;
    this.camera.zoom *= times;
    this.camera.updateProjectionMatrix();
    this.moved();
  }

  showPoses(content: Content): void {
    const { poses, tones } = content;
    const first = this.poses === null || this.poses.reach_mm !== poses.reach_mm;
    this.poses = poses;
    this.reach = Math.max(1e-3, (poses.reach_mm ?? 1000) * kMm);
    this.measure(poses);
    this.renderer.setClearColor(new Color(tones.paper));
    this.clear();
    const grid = new GridHelper(2 * this.reach, 10, tones.muted, tones.grid);
    grid.rotateX(Math.PI / 2);
    this.content.add(grid);
    this.addPoints(content);
    this.addArrows(content);
    if (first) this.lookFrom(this.eye);
    this.draw();
  }

  showArm(frames: Frames, tones: Tones, withFrames: boolean): void {
    disposeTree(this.arm);
    this.scene.remove(this.arm);
    this.arm = makeArm(frames, this.reach, tones, withFrames);
    this.scene.add(this.arm);
    this.draw();
  }

  showPicked(index: number, tones: Tones): void {
    const point = this.poses && index >= 0 ? at3(this.poses.point_mm, index) : null;
    this.ring.visible = point !== null;
    if (point) {
      this.ring.position.copy(point);
      this.ring.scale.setScalar(0.03 * this.reach);
      this.ring.material.color.set(tones.ink);
    }
    this.draw();
  }

  dispose(): void {
    cancelAnimationFrame(this.asked);
    clearTimeout(this.settle);
    this.clear();
    disposeTree(this.arm);
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private clear(): void {
    for (const arrows of this.arrows) arrows.dispose();
    this.arrows = [];
    disposeTree(this.content);
    this.content.clear();
  }

  private drawn(content: Content): number[] {
    const { poses, heldOnly, brushed, region } = content;
    const keep = [...poses.row.keys()].filter((i) =>
      (!heldOnly || poses.set[i] === "held") && (brushed === null || brushed.has(i)));
    const place = new Map(keep.map((i, k) => [i, k]));
    const worst = [...keep].sort((a, b) => (poses.after_norm_mm[b] ?? -1) - (poses.after_norm_mm[a] ?? -1)).slice(0, 50);
    const first = [...worst, ...keep.filter((i) => region.has(poses.row[i]))];
    return spreadOrder(keep.length, first.map((i) => place.get(i) ?? 0)).map((k) => keep[k]);
  }

  private addPoints(content: Content): void {
    const { poses, region, tones } = content;
    const inside = new Set(this.drawn(content));
    const shown = (keep: (i: number) => boolean, colour: string, size: number): void => {
      const places: number[] = [];
      poses.row.forEach((_, i) => {
        const p = at3(poses.point_mm, i);
        if (p && keep(i)) places.push(p.x, p.y, p.z);
      });
      const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(places), 3));
      this.content.add(new Points(geometry, new PointsMaterial({ color: colour, size, sizeAttenuation: false })));
    };
    const isRegion = (i: number): boolean => region.has(poses.row[i]);
    shown((i) => !inside.has(i), tones.grid, 2);
    shown((i) => inside.has(i) && !isRegion(i), tones.muted, 3);
    shown((i) => inside.has(i) && isRegion(i), tones.purple, 6);
  }

  private addArrows(content: Content): void {
    const { poses, shown, factor, tones } = content;
    const order = this.drawn(content);
    this.arrowCount = 0;
    const kinds: [Columns3, string, Shown][] = [[poses.before_mm, tones.vermilion, "before"], [poses.after_mm, tones.blue, "after"]];
    for (const [errors, tone, name] of kinds) {
      if (shown !== "both" && shown !== name) continue;
      const colour = new Color(tone);
      const list: Arrow[] = [];
      for (const i of order) {
        const from = at3(poses.point_mm, i), along = at3(errors, i)?.multiplyScalar(factor);
        if (from && along && along.length() > 0) list.push({ from, along });
      }
      const arrows = new Arrows(list, 0.0026 * this.extent, colour);
      this.arrows.push(arrows);
      this.content.add(arrows.group);
      this.arrowCount = Math.max(this.arrowCount, list.length);
    }
  }

  /** Finds the ball around the base and every measured point. */
  private measure(poses: Poses): void {
    const box = new Box3(new Vector3(), new Vector3());
    const points = poses.row.map((_, i) => at3(poses.point_mm, i)).filter((p): p is Vector3 => p !== null);
    for (const p of points) box.expandByPoint(p);
    box.getCenter(this.middle);
    this.extent = points.reduce((far, p) => Math.max(far, p.distanceTo(this.middle)), this.middle.length()) || this.reach;
  }

  /** Shifts and zooms until base and measured points fill the view. */
  private fill(): void {
    this.camera.updateMatrixWorld();
    const seen = new Box3();
    seen.expandByPoint(new Vector3().project(this.camera));
    this.poses?.row.forEach((_, i) => {
      const p = this.poses ? at3(this.poses.point_mm, i) : null;
      if (p) seen.expandByPoint(p.project(this.camera));
    });
    const middle = seen.getCenter(new Vector3()), size = seen.getSize(new Vector3());
    const right = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0), up = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
    const shift = right.multiplyScalar(middle.x * this.camera.right).addScaledVector(up, middle.y * this.camera.top);
    this.camera.position.add(shift);
    this.controls.target.add(shift);
    this.controls.update();
    this.camera.zoom = 2 * kFill / Math.max(size.x, size.y, 1e-3);
    this.camera.updateProjectionMatrix();
  }

  private frame(): void {
    const { width, height } = this.canvas;
    const aspect = height > 0 ? width / height : 1;
    const half = 1.08 * this.extent / Math.min(1, aspect);
    Object.assign(this.camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half, near: 0.001 * this.reach, far: 20 * this.reach });
    this.camera.updateProjectionMatrix();
  }

  private moved(): void {
    this.moving = true;
    clearTimeout(this.settle);
    this.settle = window.setTimeout(() => {
      this.moving = false;
      this.draw();
    }, kSettle);
    this.draw();
  }

  private draw(): void {
    cancelAnimationFrame(this.asked);
    this.asked = requestAnimationFrame(() => {
      const most = Math.floor((this.moving ? kMovingArrows : kStillArrows) / Math.max(1, this.arrows.length));
      const n = Math.min(most, this.arrowCount);
      for (const arrows of this.arrows) arrows.show(n);
      this.onThinned(n, this.arrowCount);
      this.ring.quaternion.copy(this.camera.quaternion);
      this.renderer.render(this.scene, this.camera);
    });
  }

  private pickAt(event: PointerEvent): void {
    const poses = this.poses;
    if (!poses) return;
    const box = this.canvas.getBoundingClientRect();
    let best = -1, nearest = kPickRadius;
    poses.row.forEach((_, i) => {
      const p = at3(poses.point_mm, i)?.project(this.camera);
      if (!p) return;
      const far = Math.hypot((p.x + 1) / 2 * box.width + box.left - event.clientX, (1 - p.y) / 2 * box.height + box.top - event.clientY);
      if (far < nearest) [best, nearest] = [i, far];
    });
    if (best >= 0) this.onPick(best);
  }
}

