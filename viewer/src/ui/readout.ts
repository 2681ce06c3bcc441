import { classColor } from '../scene/palette';
import { classWord } from '../state/class_words';
import type { Run } from '../state/run';
import { kInterval } from '../state/series';
import { h, part, setText } from './dom';
import { quantity } from './format';

interface Tile {
  value: HTMLElement;
  label: HTMLElement;
  root: HTMLElement;
}

/** Five numbers of the run, over the scene. */
export class Readout {
  private readonly status = tile('tile status');
  private readonly objects = tile('tile');
  private readonly dynamic = tile('tile');
  private readonly error = tile('tile');
  private readonly time = tile('tile optional');
  private shownCounts: string | null = null;

  constructor(private readonly run: Run) {
    const tiles = [this.status, this.objects, this.dynamic, this.error, this.time];
    part('readout').append(...tiles.map(({ root }) => root));
    run.on('hello', () => this.update());
    run.on('frame', () => this.update());
    this.update();
  }

  private update(): void {
    const { frame } = this.run;
    part('readout').hidden = frame === null;
    if (!frame) return;
    this.status.root.dataset.status = frame.lost ? 'lost' : frame.status;
    fill(this.status, statusWord(frame.status, frame.lost), 'localization');
    setText(this.objects.label, 'tracked');
    this.showCounts();
    fill(this.dynamic, quantity(this.value('dynamic_share'), 'ratio'), 'dynamic');
    const [error, drift] = [this.value('error_cm'), this.value('drift_cm')];
    this.error.root.hidden = (error ?? drift) === undefined;
    fill(this.error, quantity(error ?? drift, 'cm'), error === undefined ? 'from the start' : 'position error');
    fill(this.time, quantity(this.value(kInterval), 'ms'), 'a frame');
  }

  /** From the frame, or else from the run's history. */
  private value(name: string): number | undefined {
    const { frame, series } = this.run;
    if (!frame) return undefined;
    const value = frame.series[name] ?? series.all.find((one) => one.name === name)?.values.row(frame.frame)[0];
    return value === undefined || value === null || !Number.isFinite(value) ? undefined : value;
  }

  private showCounts(): void {
    const byClass = new Map<string, number>();
    for (const object of this.run.frame?.objects ?? []) byClass.set(object.class, (byClass.get(object.class) ?? 0) + 1);
    const text = [...byClass].map(([name, count]) => `${name} ${count}`).join();
    if (text === this.shownCounts) return;
    this.shownCounts = text;
    const counts = [...byClass].map(([name, count]) => classCount(count, name));
    this.objects.value.replaceChildren(...(counts.length ? counts : ['nobody']));
  }
}

/** "2 people"; on narrow screens a dot in the color of the class replaces the word. */
function classCount(count: number, name: string): HTMLElement {
  const dot = h('i');
  dot.style.background = classColor(name);
  const word = classWord(count, name);
  return h('span', { class: 'count', title: word }, dot, String(count), h('span', { class: 'word' }, ` ${word}`));
}

function statusWord(status: string, lost: boolean): string {
  if (lost) return 'Lost';
  return status ? status[0].toUpperCase() + status.slice(1) : 'Unknown';
}

function tile(className: string): Tile {
  const [value, label] = [h('b'), h('span')];
  return { value, label, root: h('div', { class: className }, value, label) };
}

function fill({ value, label }: Tile, text: string, name: string): void {
  setText(value, text);
  setText(label, name);
}
