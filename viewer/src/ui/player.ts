import type { Command } from '../protocol/messages';
import type { Run } from '../state/run';
import { throttled } from '../state/throttled';
import { h, part, setText } from './dom';
import { clock, frameOf } from './format';
import { icon } from './icons';

const kSpeeds = [0.25, 0.5, 1, 2, 4, 8];
/** Shortest time between two seeks while the handle is dragged [ms]. */
const kSeekEvery = 60;

/** Play, pause, step, seek and speed; in a live run, return to the newest frame. */
export class Player {
  private readonly toggleButton = h('button', { class: 'play', type: 'button', click: () => this.toggle() });
  private readonly range = h('input', {
    type: 'range',
    id: 'scrub',
    min: '0',
    max: '0',
    step: '1',
    value: '0',
    'aria-label': 'Frame',
  });
  private readonly time = h('span', { class: 'time' });
  private readonly frames = h('span', { class: 'frames' });
  private readonly speed = h('select', { id: 'speed', title: 'Speed (+ and -)', 'aria-label': 'Speed' });
  private readonly live = h('button', { class: 'live', type: 'button', title: 'Show the newest frame', click: () => this.goLive() }, 'Live');
  private dragged: number | null = null;
  private readonly sendSeek = throttled(kSeekEvery, () => {
    if (this.dragged !== null) this.send({ type: 'seek', frame: this.dragged });
  });

  constructor(
    private readonly run: Run,
    private readonly send: (command: Command) => void,
  ) {
    this.build();
    run.on('hello', () => this.update());
    run.on('history', () => this.update());
    run.on('playback', () => this.update());
    run.on('frame', () => this.update());
    this.update();
  }

  toggle(): void {
    this.send({ type: this.run.playback.playing ? 'pause' : 'play' });
  }

  /** One frame is a step, more are a jump. */
  step(frames: number): void {
    if (Math.abs(frames) === 1) this.send({ type: 'step', by: frames });
    else this.seek(this.frame + frames);
  }

  seek(frame: number): void {
    this.send({ type: 'seek', frame: Math.max(0, Math.min(this.last, frame)) });
  }

  end(): void {
    this.seek(this.last);
  }

  changeSpeed(steps: number): void {
    const at = kSpeeds.findIndex((speed) => speed >= this.run.playback.speed);
    const next = kSpeeds[Math.max(0, Math.min(kSpeeds.length - 1, (at < 0 ? kSpeeds.length - 1 : at) + steps))];
    this.send({ type: 'speed', value: next });
  }

  private get frame(): number {
    return this.run.frame?.frame ?? this.run.playback.frame;
  }

  private get last(): number {
    return Math.max(0, this.run.frames - 1);
  }

  private build(): void {
    for (const speed of kSpeeds) this.speed.append(h('option', { value: String(speed) }, `${speed}×`));
    this.speed.addEventListener('change', () => this.send({ type: 'speed', value: Number(this.speed.value) }));
    this.range.addEventListener('input', () => this.drag());
    this.range.addEventListener('change', () => this.drop());
    const button = (name: 'back' | 'forward', title: string, frames: number): HTMLElement =>
      h('button', { class: 'icon-button', type: 'button', title, 'aria-label': title, click: () => this.step(frames) }, icon(name));
    part('player').append(
      h(
        'div',
        { class: 'buttons' },
        button('back', 'Previous frame (←)', -1),
        this.toggleButton,
        button('forward', 'Next frame (→)', 1),
      ),
      this.range,
      h('div', { class: 'where' }, this.time, this.frames),
      this.speed,
      this.live,
    );
  }

  private drag(): void {
    this.dragged = Number(this.range.value);
    this.sendSeek();
    this.update();
  }

  /** Sends the place itself: a throttled seek may still wait and would find no handle dragged. */
  private drop(): void {
    this.dragged = null;
    this.seek(Number(this.range.value));
  }

  private goLive(): void {
    this.send({ type: 'play' });
  }

  private update(): void {
    const { playback, trajectory } = this.run;
    const frame = this.dragged ?? this.frame;
    this.range.max = String(this.last);
    this.range.value = String(frame);
    this.range.style.setProperty('--done', `${(100 * frame) / Math.max(1, this.last)}%`);
    const [now, end] = [trajectory.time(frame), trajectory.time(this.last)];
    setText(this.time, now === null ? '' : `${clock(now)} / ${clock(end ?? now)}`);
    setText(this.frames, this.run.frame ? frameOf(frame, this.run.frames) : '');
    this.speed.hidden = this.run.live;
    this.speed.value = String(playback.speed);
    this.updateLive(frame);
    this.updateButton();
    part('player').classList.toggle('idle', this.run.frame === null);
  }

  private updateLive(frame: number): void {
    this.live.hidden = !this.run.live;
    this.live.classList.toggle('behind', !this.run.playback.playing || frame < this.last - 30);
  }

  private updateButton(): void {
    const { playing, ended } = this.run.playback;
    const [name, title] = playing
      ? (['pause', 'Pause (space)'] as const)
      : ended
        ? (['replay', 'Replay (space)'] as const)
        : (['play', 'Play (space)'] as const);
    if (this.toggleButton.title === title) return;
    this.toggleButton.title = title;
    this.toggleButton.setAttribute('aria-label', title);
    this.toggleButton.replaceChildren(icon(name));
  }
}
