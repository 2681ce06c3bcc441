import { Color } from 'three';
import type { LoopsMessage } from '../protocol/messages';
import type { Trajectory } from '../state/trajectory';
import { ColoredSegments } from './line_segments';
import { kColors } from './palette';

/** Lines between the frames of loops: those that correct the trajectory, and those that were rejected. */
export class LoopLayer {
  private readonly closed = new ColoredSegments({ width: 3 });
  private readonly refused = new ColoredSegments({ width: 1, opacity: 0.5 });
  readonly accepted = this.closed.object;
  readonly rejected = this.refused.object;

  update(loops: LoopsMessage | null, { poses }: Trajectory): void {
    const [accepted, rejected] = [new Color(kColors.loop), new Color(kColors.rejectedLoop)];
    for (const lines of [this.closed, this.refused]) lines.clear();
    loops?.accepted.forEach((isAccepted, i) => {
      const [earlier, later] = loops.frames.subarray(2 * i, 2 * i + 2);
      if (!(Math.max(earlier, later) < poses.length)) return; // also without numbers
      const lines = isAccepted ? this.closed : this.refused;
      lines.add(poses.values, 7 * earlier, poses.values, 7 * later, isAccepted ? accepted : rejected);
    });
    for (const lines of [this.closed, this.refused]) lines.commit();
  }
}
