import { Color } from 'three';
import { forEachTrailSegment, type Tracks } from '../state/tracks';
import { ColoredSegments } from './line_segments';
import { classColor, kColors } from './palette';

/** Length of a trail [frames]. */
const kLength = 150;
const background = new Color(kColors.background);
const shade = new Color();

/** Past trajectories of the objects, fading with age. */
export class TrailLayer {
  private readonly lines = new ColoredSegments({ width: 2.5 });
  readonly object = this.lines.object;

  update(tracks: Tracks, frame: number): void {
    this.lines.clear();
    for (const track of tracks.all) {
      const color = new Color(classColor(track.class));
      forEachTrailSegment(track, frame, kLength, (from, to, age) => {
        this.lines.add(track.centers, from, track.centers, to, shade.copy(color).lerp(background, age * 0.9));
      });
    }
    this.lines.commit();
  }
}
