import type { SceneObject } from '../protocol/messages';
import { classColor } from '../scene/palette';
import { className } from '../state/class_words';
import type { Run } from '../state/run';
import { throttled } from '../state/throttled';
import { h, part, setText } from './dom';

/** The objects of the current frame: class and number, speed, distance from the sensor; nearest first. */
export class ObjectPanel {
  private readonly list = part('objects');

  constructor(private readonly run: Run) {
    const update = throttled(150, () => this.update());
    run.on('frame', update);
    run.on('hello', update);
    this.update();
  }

  private update(): void {
    const objects = this.run.frame?.objects ?? [];
    setText(part('object-count'), objects.length ? String(objects.length) : '');
    if (objects.length === 0) {
      const text = this.run.frame ? 'No objects in this frame.' : '';
      this.list.replaceChildren(h('p', { class: 'empty' }, text));
      return;
    }
    const rows = objects.map((object) => ({ object, away: this.distance(object) }));
    rows.sort((a, b) => a.away - b.away);
    this.list.replaceChildren(...rows.map(({ object, away }) => row(object, away)));
  }

  private distance({ center }: SceneObject): number {
    const pose = this.run.frame?.pose;
    return pose ? Math.hypot(center[0] - pose[0], center[1] - pose[1], center[2] - pose[2]) : NaN;
  }
}

function row(object: SceneObject, away: number): HTMLElement {
  const swatch = h('i', { class: 'swatch' });
  swatch.style.background = classColor(object.class);
  return h(
    'div',
    { class: object.seen ? 'object' : 'object unseen', title: object.seen ? '' : 'Unseen in this frame' },
    swatch,
    h('span', { class: 'object-name' }, `${className(object.class)} ${object.id}`),
    h('span', { class: 'number' }, object.moving ? `${Math.hypot(...object.velocity).toFixed(1)} m/s` : 'still'),
    h('span', { class: 'number faint' }, Number.isFinite(away) ? `${away.toFixed(1)} m` : ''),
  );
}
