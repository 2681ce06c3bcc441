import type { SceneObject, TracksMessage } from '../protocol/messages';

/** Positions of one object by frame. */
export interface Track {
  id: number;
  class: string;
  frames: number[];
  /** x y z per frame. */
  centers: number[];
}

/** Number of frames without observation after which the trajectory is interrupted. */
const kGap = 30;

/** Trajectories of all objects received so far. */
export class Tracks {
  private readonly byId = new Map<number, Track>();

  get all(): Iterable<Track> {
    return this.byId.values();
  }

  set({ ids, classes, track, frame, centers }: TracksMessage, classNames: string[]): void {
    for (let row = 0; row < track.length; ++row) {
      const id = ids[track[row]];
      if (id === undefined) continue;
      const name = classNames[classes[track[row]]] ?? 'object';
      insert(this.find(id, name), frame[row], centers.subarray(3 * row, 3 * row + 3));
    }
  }

  add(frame: number, objects: SceneObject[]): void {
    for (const object of objects) {
      if (object.seen) insert(this.find(object.id, object.class), frame, object.center);
    }
  }

  private find(id: number, name: string): Track {
    let track = this.byId.get(id);
    if (!track) {
      track = { id, class: name, frames: [], centers: [] };
      this.byId.set(id, track);
    }
    return track;
  }
}

/** Index of the first entry of `sorted` that is not below `value`. */
export function lowerBound(sorted: ArrayLike<number>, value: number): number {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

function insert(track: Track, frame: number, center: ArrayLike<number>): void {
  const at = lowerBound(track.frames, frame);
  const known = track.frames[at] === frame;
  if (!known) track.frames.splice(at, 0, frame);
  track.centers.splice(3 * at, known ? 3 : 0, center[0], center[1], center[2]);
}

/**
 * Calls `segment` for every piece of the track's way in the `length` frames up to `frame`, with the indices of its
 * ends in `centers` and its age from 0 (now) to 1 (about to vanish).
 */
export function forEachTrailSegment(
  track: Track,
  frame: number,
  length: number,
  segment: (from: number, to: number, age: number) => void,
): void {
  const last = lowerBound(track.frames, frame + 1) - 1;
  for (let i = last; i > 0 && track.frames[i] > frame - length; --i) {
    if (track.frames[i] - track.frames[i - 1] <= kGap) {
      segment(3 * (i - 1), 3 * i, Math.max(0, (frame - track.frames[i]) / length));
    }
  }
}
