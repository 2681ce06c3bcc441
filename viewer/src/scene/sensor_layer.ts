import { Color, Group, Points, type ShaderMaterial } from 'three';
import type { Intrinsics, Scan } from '../protocol/messages';
import { ColoredSegments } from './line_segments';
import { kColors } from './palette';
import { paddedColors, pointGeometry } from './point_buffers';
import { pointMaterial } from './point_material';

/** Length of the drawn view frustum [m]. */
const kReach = 0.7;

/** Corners of the arrow of a LiDAR: x is ahead, z up. */
const kArrow = [0.4, -0.25, 0, 0, 0, 0.1, 0.4, 0.25, 0, 0, 0, -0.1];

/** Sensor frustum and current scan, static points cyan and dynamic ones orange. */
export class SensorLayer {
  readonly group = new Group();
  readonly scan = new Group();
  private readonly frustum = new ColoredSegments({ width: 2 });
  readonly camera = this.frustum.object;
  private readonly looks: ShaderMaterial[] = [
    pointMaterial({ size: 0.012, smallest: 1, tint: kColors.staticScan, tintShare: 0.5, nearer: 0.01 }),
    pointMaterial({ size: 0.03, smallest: 2, tint: kColors.dynamicScan, tintShare: 0.95, whole: true, nearer: 0.01 }),
  ];

  constructor() {
    this.group.matrixAutoUpdate = false;
    this.group.add(this.scan, this.camera);
  }

  /** tx ty tz qx qy qz qw, T_world_camera. */
  setPose(pose: ArrayLike<number>): void {
    this.group.position.fromArray(pose as number[], 0);
    this.group.quaternion.fromArray(pose as number[], 3);
    this.group.updateMatrix();
  }

  /** Null for a sensor without an image: it gets an arrow. */
  setIntrinsics(image: Intrinsics | null): void {
    const color = new Color(kColors.camera);
    const points = [0, 0, 0, ...(image ? imageCorners(image) : kArrow)];
    this.frustum.clear();
    for (let i = 1; i <= 4; ++i) {
      this.frustum.add(points, 0, points, 3 * i, color);
      this.frustum.add(points, 3 * i, points, 3 * ((i % 4) + 1), color);
    }
    this.frustum.commit();
  }

  setScan(scan: Scan | null): void {
    for (const cloud of this.scan.children) (cloud as Points).geometry.dispose();
    this.scan.clear();
    if (!scan) return;
    for (const dynamic of [0, 1]) {
      const part = select(scan, dynamic);
      if (part.points.length === 0) continue;
      this.scan.add(new Points(pointGeometry(part.points, part.colors), this.looks[dynamic]));
    }
  }
}

/** The image corners at the frustum's end, in the camera frame. */
function imageCorners({ width, height, fx, fy, cx, cy }: Intrinsics): number[] {
  const corners = [[0, 0], [width, 0], [width, height], [0, height]];
  return corners.flatMap(([u, v]) => [((u - cx) / fx) * kReach, ((v - cy) / fy) * kReach, kReach]);
}

function select({ points, colors, dynamic }: Scan, wanted: number): { points: Float32Array; colors: Uint8Array } {
  const count = points.length / 3;
  const chosen = Array.from({ length: count }, (_, i) => i).filter((i) => (dynamic?.[i] ? 1 : 0) === wanted);
  const part = new Float32Array(3 * chosen.length);
  const shades = colors ? new Uint8Array(3 * chosen.length) : null;
  chosen.forEach((from, to) => {
    part.set(points.subarray(3 * from, 3 * from + 3), 3 * to);
    shades?.set((colors as Uint8Array).subarray(3 * from, 3 * from + 3), 3 * to);
  });
  return { points: part, colors: paddedColors(shades, chosen.length) };
}
