import type { Command } from '../protocol/messages';
import type { Run } from './run';

/** The user's position and speed in the run, sent to the server after a reconnect. */
export class Place {
  private frame = 0;
  private playing = true;
  private speed = 1;

  constructor(
    run: Run,
    private readonly send: (command: Command) => void,
  ) {
    run.on('hello', ({ hello, again }) => again && this.restore(hello.live));
    run.on('frame', ({ frame }) => (this.frame = frame));
    run.on('playback', ({ playing, speed }) => Object.assign(this, { playing, speed }));
  }

  private restore(live: boolean): void {
    if (live && this.playing) return; // it shows the newest frame
    if (!this.playing) this.send({ type: 'pause' });
    if (this.speed !== 1) this.send({ type: 'speed', value: this.speed });
    this.send({ type: 'seek', frame: this.frame });
  }
}
