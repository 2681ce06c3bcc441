import type { FrameMessage, TrajectoryMessage } from '../protocol/messages';
import { Rows } from './growable';

/** Poses T_world_camera by frame, with stamps and ground truth if known. */
export class Trajectory {
  /** tx ty tz qx qy qz qw. */
  readonly poses = new Rows(7);
  readonly truth = new Rows(3);
  private readonly seconds = new Rows(1);
  /** Counts how often known poses were replaced. */
  edition = 0;
  private firstStampNs: bigint | null = null;

  get frames(): number {
    return this.poses.length;
  }

  set({ firstFrame, poses, stamps, truth }: TrajectoryMessage): void {
    if (firstFrame < this.poses.length) ++this.edition;
    this.poses.write(firstFrame, poses);
    if (stamps) this.seconds.write(firstFrame, Array.from(stamps, (ms) => ms / 1000));
    if (truth) this.truth.write(firstFrame, truth);
  }

  add({ frame, pose, truth, stampNs }: FrameMessage): void {
    if (pose) this.poses.write(frame, pose);
    if (truth) this.truth.write(frame, truth);
    if (stampNs === null) return;
    this.firstStampNs ??= stampNs - this.elapsedNs(frame); // exact where the frame's own time is known
    if (Number.isFinite(this.seconds.row(frame)[0])) return;
    this.seconds.write(frame, [Number(stampNs - this.firstStampNs) / 1e9]);
  }

  /** Seconds since the first frame; null if unknown. */
  time(frame: number): number | null {
    if (frame < 0 || frame >= this.seconds.length) return null;
    const seconds = this.seconds.row(frame)[0];
    return Number.isFinite(seconds) ? seconds : null;
  }

  /** Time since the first frame, of the last known stamp up to this frame. */
  private elapsedNs(frame: number): bigint {
    for (let i = Math.min(frame, this.seconds.length - 1); i >= 0; --i) {
      const seconds = this.time(i);
      if (seconds !== null) return BigInt(Math.round(seconds * 1e9));
    }
    return 0n;
  }
}
