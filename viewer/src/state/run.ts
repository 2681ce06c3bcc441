import type { FrameMessage, Hello, LoopsMessage, MapMessage, Message, StateMessage } from '../protocol/messages';
import { Emitter } from './emitter';
import { SeriesTable } from './series';
import { Tracks } from './tracks';
import { Trajectory } from './trajectory';

export type RunEvents = {
  /** A run begins, or is sent again after a reconnect: all earlier data are discarded. */
  hello: { hello: Hello; again: boolean };
  /** The whole trajectory, series or tracks were received. */
  history: void;
  frame: FrameMessage;
  map: MapMessage;
  playback: StateMessage;
  error: string;
};

const kStopped: StateMessage = { type: 'state', playing: false, frame: 0, speed: 1, ended: false, dropped: 0, files: null };

/** State of the displayed run: the sum of the received messages. */
export class Run extends Emitter<RunEvents> {
  hello: Hello | null = null;
  frame: FrameMessage | null = null;
  playback = kStopped;
  /** A live run has ended: its results are available. */
  private over = false;
  trajectory = new Trajectory();
  series = new SeriesTable();
  tracks = new Tracks();
  loops: LoopsMessage | null = null;

  /** Frames still arrive from the sensor. */
  get live(): boolean {
    return this.hello?.live === true && !this.over;
  }

  /** Number of available frames. */
  get frames(): number {
    // Of a live run the number was only expected; all poses are sent at its end.
    return Math.max(this.hello?.live ? 0 : (this.hello?.frames ?? 0), this.trajectory.frames);
  }

  apply(message: Message): void {
    switch (message.type) {
      case 'hello':
        return this.begin(message);
      case 'trajectory':
        this.trajectory.set(message);
        return this.emit('history', undefined);
      case 'series':
        this.series.set(message);
        return this.emit('history', undefined);
      case 'tracks':
        this.tracks.set(message, this.hello?.classes ?? []);
        return this.emit('history', undefined);
      case 'loops':
        this.loops = message;
        return this.emit('history', undefined);
      case 'frame':
        return this.show(message);
      case 'map':
        return this.emit('map', message);
      case 'state':
        this.playback = message;
        this.over ||= message.files !== null;
        return this.emit('playback', message);
      case 'error':
        return this.emit('error', message.message);
    }
  }

  private begin(hello: Hello): void {
    const again = this.hello !== null && this.hello.run === hello.run && this.hello.name === hello.name;
    this.hello = hello;
    this.frame = null;
    this.over = false;
    this.playback = kStopped;
    this.trajectory = new Trajectory();
    this.series = new SeriesTable();
    this.tracks = new Tracks();
    this.loops = null;
    this.emit('hello', { hello, again });
  }

  private show(frame: FrameMessage): void {
    this.frame = frame;
    this.trajectory.add(frame);
    this.series.add(frame.frame, frame.series);
    this.tracks.add(frame.frame, frame.objects);
    this.emit('frame', frame);
  }
}
