import { Color, Group } from 'three';
import type { LoopsMessage } from '../protocol/messages';
import type { Trajectory } from '../state/trajectory';
import { ColoredSegments } from './line_segments';
import { kColors } from './palette';

/** Lines between the frames of loops: those that correct the trajectory, and those that were rejected. */
export class LoopLayer {
  readonly group = new Group();
  private readonly accepted = new ColoredSegments({ width: 3 });
  private readonly rejected = new ColoredSegments({ width: 1, opacity: 0.5 });

  constructor() {
    this.group.add(this.rejected.object, this.accepted.object);
  }

  update(loops: LoopsMessage | null, { poses }: Trajectory): void {
    const [accepted, rejected] = [new Color(kColors.loop), new Color(kColors.rejectedLoop)];
    for (const lines of [this.accepted, this.rejected]) lines.clear();
    loops?.accepted.forEach((isAccepted, i) => {
      const [earlier, later] = loops.frames.subarray(2 * i, 2 * i + 2);
      if (!(Math.max(earlier, later) < poses.length)) return; // also without numbers
      const lines = isAccepted ? this.accepted : this.rejected;
      lines.add(poses.values, 7 * earlier, poses.values, 7 * later, isAccepted ? accepted : rejected);
    });
    for (const lines of [this.accepted, this.rejected]) lines.commit();
  }
}
