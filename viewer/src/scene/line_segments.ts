import { type Color, Group, InstancedInterleavedBuffer, InterleavedBufferAttribute } from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';

/** In steps of the depth buffer: several centimeters at a distance of a few meters. */
const kBehind = 2000;

export interface LineLook {
  /** Width on the screen [px]. */
  width: number;
  opacity?: number;
  /** Lies behind another line at the same position. */
  behind?: boolean;
}

/** Colored line segments of any width, in growing buffers: append, or clear and fill again. */
export class ColoredSegments {
  /** Visibility is set by its owner. */
  readonly object = new Group();
  private readonly line: LineSegments2;
  private readonly geometry = new LineSegmentsGeometry();
  private positions!: InstancedInterleavedBuffer;
  private colors!: InstancedInterleavedBuffer;
  private capacity = 0;
  private used = 0;
  private written = 0;

  constructor(look: LineLook) {
    const material = new LineMaterial({ linewidth: look.width, vertexColors: true });
    material.transparent = look.opacity !== undefined;
    material.opacity = look.opacity ?? 1;
    material.polygonOffset = look.behind === true;
    material.polygonOffsetUnits = kBehind;
    this.line = new LineSegments2(this.geometry, material);
    this.line.frustumCulled = false;
    this.object.add(this.line);
    this.reserve(64);
    this.commit();
  }

  get count(): number {
    return this.used;
  }

  clear(): void {
    this.used = this.written = 0;
  }

  add(a: ArrayLike<number>, aAt: number, b: ArrayLike<number>, bAt: number, color: Color): void {
    this.reserve(this.used + 1);
    const at = 6 * this.used++;
    const [positions, colors] = [this.positions.array, this.colors.array];
    for (let k = 0; k < 3; ++k) {
      positions[at + k] = a[aAt + k];
      positions[at + 3 + k] = b[bAt + k];
    }
    color.toArray(colors, at);
    color.toArray(colors, at + 3);
  }

  /** Uploads added segments to the GPU. */
  commit(): void {
    for (const buffer of [this.positions, this.colors]) {
      // Ranges that are left were not uploaded: nothing was drawn since.
      const from = Math.min(6 * this.written, ...buffer.updateRanges.map(({ start }) => start));
      buffer.clearUpdateRanges();
      if (6 * this.used > from) buffer.addUpdateRange(from, 6 * this.used - from);
      buffer.needsUpdate = this.used > this.written;
    }
    this.written = this.used;
    this.show(this.used);
  }

  /** Draws only the first `count` segments. */
  show(count: number): void {
    this.geometry.instanceCount = Math.max(0, Math.min(count, this.used));
    this.line.visible = this.geometry.instanceCount > 0;
  }

  private reserve(count: number): void {
    if (count <= this.capacity) return;
    this.capacity = Math.max(count, 2 * this.capacity);
    this.geometry.dispose(); // frees the old buffers on the GPU
    this.positions = this.enlarge(this.positions, 'instanceStart', 'instanceEnd');
    this.colors = this.enlarge(this.colors, 'instanceColorStart', 'instanceColorEnd');
    this.written = 0;
  }

  private enlarge(old: InstancedInterleavedBuffer | undefined, start: string, end: string): InstancedInterleavedBuffer {
    const array = new Float32Array(6 * this.capacity);
    if (old) array.set(old.array as Float32Array);
    const buffer = new InstancedInterleavedBuffer(array, 6, 1);
    this.geometry.setAttribute(start, new InterleavedBufferAttribute(buffer, 3, 0));
    this.geometry.setAttribute(end, new InterleavedBufferAttribute(buffer, 3, 3));
    return buffer;
  }
}
