import { type Camera, Frustum, Group, Matrix4, Points, Sphere, Vector3 } from 'three';
import type { MapMessage } from '../protocol/messages';
import { drawnCounts } from './level_of_detail';
import { pointGeometry, shuffled } from './point_buffers';
import { pointMaterial, pointUniforms } from './point_material';

interface Chunk {
  points: Points;
  count: number;
  voxel: number;
}

/** The static map: one cloud per cube of space, drawn with as many points as the image needs. */
export class MapLayer {
  readonly group = new Group();
  private readonly chunks = new Map<string, Chunk>();
  private readonly material = pointMaterial({ size: 0.05, saturation: 0.9 });
  private readonly frustum = new Frustum();
  private readonly matrix = new Matrix4();

  set({ chunk, points, colors, voxel, remove }: MapMessage): void {
    this.drop(chunk);
    if (remove || points.length < 3) return;
    const mixed = shuffled(points, colors);
    const cloud = new Points(pointGeometry(mixed.points, mixed.colors), this.material);
    const entry = { points: cloud, count: mixed.points.length / 3, voxel };
    cloud.onBeforeRender = () => this.setSize(entry);
    this.chunks.set(chunk, entry);
    this.group.add(cloud);
  }

  /** Colors by height in the scene frame, blue at `low` to red at `high` [m]; or the points' own colors. */
  setHeights(shown: boolean, low: number, high: number): void {
    this.material.uniforms.byHeight.value = shown;
    this.material.uniforms.heights.value.set(low, Math.max(0.1, high - low));
  }

  clear(): void {
    for (const key of [...this.chunks.keys()]) this.drop(key);
  }

  /** Selects the number of points per chunk for this view; returns the total. */
  choose(camera: Camera, budget: number): number {
    this.frustum.setFromProjectionMatrix(
      this.matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse),
    );
    const visible = [...this.chunks.values()].filter((chunk) => this.frustum.intersectsSphere(this.sphere(chunk)));
    const orthographic = pointUniforms.orthographic.value;
    camera.getWorldPosition(eye);
    const views = visible.map((chunk) => {
      const sphere = this.sphere(chunk);
      const away = eye.distanceTo(sphere.center) - sphere.radius;
      return { count: chunk.count, voxel: chunk.voxel, distance: orthographic ? 1 : Math.max(0.5, away) };
    });
    const counts = drawnCounts(views, pointUniforms.pixelsPerMetre.value, budget);
    visible.forEach((chunk, i) => chunk.points.geometry.setDrawRange(0, counts[i]));
    return counts.reduce((sum, count) => sum + count, 0);
  }

  /** In the scene frame. */
  forEachSphere(use: (sphere: Sphere) => void): void {
    for (const chunk of this.chunks.values()) use(this.sphere(chunk));
  }

  /** A subset of the points in memory order, to measure the map. */
  forEachSample(every: number, use: (x: number, y: number, z: number) => void): void {
    for (const { points } of this.chunks.values()) {
      const positions = points.geometry.getAttribute('position').array;
      for (let i = 0; i + 2 < positions.length; i += 3 * every) use(positions[i], positions[i + 1], positions[i + 2]);
    }
  }

  /** Fewer points are drawn larger, so that surfaces stay closed; a random sample needs larger ones. */
  private setSize({ points, count, voxel }: Chunk): void {
    const share = Math.min(1, points.geometry.drawRange.count / count);
    this.material.uniforms.size.value = Math.min(5, (1.9 - 0.5 * share) / Math.sqrt(share)) * voxel;
    this.material.uniformsNeedUpdate = true;
  }

  private sphere({ points }: Chunk): Sphere {
    return world.copy(points.geometry.boundingSphere as Sphere).applyMatrix4(this.group.matrixWorld);
  }

  private drop(key: string): void {
    const chunk = this.chunks.get(key);
    if (!chunk) return;
    this.group.remove(chunk.points);
    chunk.points.geometry.dispose();
    this.chunks.delete(key);
  }
}

const world = new Sphere();
const eye = new Vector3();
