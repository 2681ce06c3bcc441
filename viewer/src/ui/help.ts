import { kColors } from '../scene/palette';
import { h, part } from './dom';
import { kRows } from './layer_panel';

const kKeys: [string, string][] = [
  ['Space', 'Play, pause'],
  ['← →', 'A frame back, on; with Shift ten'],
  ['Home End', 'First, last frame'],
  ['+ −', 'Faster, slower'],
  ['1 2 3', 'Follow, orbit, top view'],
  ['0', 'Back to where the view starts'],
  ['P', 'Save a picture of the scene'],
  ['?', 'This page'],
];

/** What the colours mean, how to move, and the keys. */
export function buildHelp(): void {
  const dialog = part<HTMLDialogElement>('help');
  const close = h('button', { class: 'button', type: 'button', click: () => dialog.close() }, 'Close');
  dialog.append(
    h('h2', {}, 'What you see'),
    h('p', {}, 'A camera or LiDAR moves through a place with people and vehicles. MMS-SLAM finds its way and maps what stands still.'),
    h(
      'ul',
      { class: 'meanings' },
      meaning(kColors.person, 'people, with number and speed'),
      meaning(kColors.vehicle, 'vehicles'),
      meaning(kColors.trajectory, 'the way of the sensor'),
      meaning(kColors.truth, 'the true way, where it is known'),
      meaning(kColors.staticScan, 'points of this frame that stand still'),
      meaning(kColors.dynamicScan, 'points of this frame that belong to something dynamic'),
    ),
    h('h2', {}, 'Moving'),
    h('p', {}, 'Drag to turn, scroll or pinch to come closer, drag with the right button or two fingers to shift. A click on a chart goes to that frame.'),
    h('h2', {}, 'Keys'),
    h('div', { class: 'keys' }, ...[...kKeys, ...kRows.map(({ key, name }): [string, string] => [key, name])].map(keyRow)),
    close,
  );
  dialog.addEventListener('click', (event) => event.target === dialog && dialog.close());
}

function meaning(color: string, text: string): HTMLElement {
  const swatch = h('i');
  swatch.style.background = color;
  return h('li', {}, swatch, text);
}

function keyRow([keys, text]: [string, string]): HTMLElement {
  const caps = keys.split(' ').map((key) => h('kbd', {}, key));
  return h('div', {}, h('span', {}, ...caps), text);
}
