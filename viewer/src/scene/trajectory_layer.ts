import { Color, Group } from 'three';
import { lowerBound } from '../state/tracks';
import type { Trajectory } from '../state/trajectory';
import { ColoredSegments, type LineLook } from './line_segments';
import { kColors } from './palette';

/** The past trajectory in full color, the rest of a finished run pale, and the ground truth. */
export class TrajectoryLayer {
  readonly estimate = new Group();
  readonly truth: ColoredSegments['object'];
  private readonly whole = new Way(kColors.trajectory, { width: 2, opacity: 0.35, behind: true });
  private readonly passed = new Way(kColors.trajectory, { width: 3 });
  private readonly reference = new Way(kColors.truth, { width: 5, opacity: 0.5, behind: true });

  constructor() {
    this.estimate.add(this.whole.line.object, this.passed.line.object);
    this.truth = this.reference.line.object;
  }

  clear(): void {
    for (const way of [this.whole, this.passed, this.reference]) way.clear();
  }

  /** Adds new poses and shows the trajectory up to a frame. */
  update(trajectory: Trajectory, frame: number): void {
    for (const way of [this.whole, this.passed]) way.extend(trajectory.poses.values, 7, trajectory.poses.length);
    this.reference.extend(trajectory.truth.values, 3, trajectory.truth.length);
    this.whole.showUntil(Infinity);
    this.passed.showUntil(frame);
    this.reference.showUntil(Infinity);
  }
}

/** A line through the rows of a growing table; rows with NaN are skipped. */
class Way {
  readonly line: ColoredSegments;
  private readonly color: Color;
  private rows = 0;
  private last = -1;
  /** Frame at the end of a line segment. */
  private ends: number[] = [];

  constructor(color: string, look: LineLook) {
    this.color = new Color(color);
    this.line = new ColoredSegments(look);
  }

  clear(): void {
    this.line.clear();
    this.line.commit();
    [this.rows, this.last, this.ends] = [0, -1, []];
  }

  extend(values: Float32Array, width: number, rows: number): void {
    for (; this.rows < rows; ++this.rows) {
      if (!Number.isFinite(values[this.rows * width])) continue;
      if (this.last >= 0) {
        this.line.add(values, this.last * width, values, this.rows * width, this.color);
        this.ends.push(this.rows);
      }
      this.last = this.rows;
    }
    this.line.commit();
  }

  showUntil(frame: number): void {
    let count = this.ends.length;
    if (frame < this.rows) count = lowerBound(this.ends, frame + 1);
    this.line.show(count);
  }
}
