import { kColors } from '../scene/palette';
import { h, part } from './dom';
import { kRows } from './layer_panel';

const kKeys: [string, string][] = [
  ['Space', 'Play, pause'],
  ['← →', 'Previous, next frame; with Shift ten frames'],
  ['Home End', 'First, last frame'],
  ['+ −', 'Faster, slower'],
  ['1 2 3', 'Follow, orbit, top view'],
  ['0', 'Reset the view'],
  ['P', 'Save an image of the scene'],
  ['?', 'This page'],
];

/** Meaning of the colors, mouse controls, and keys. */
export function buildHelp(): void {
  const dialog = part<HTMLDialogElement>('help');
  const close = h('button', { class: 'button', type: 'button', click: () => dialog.close() }, 'Close');
  dialog.append(
    h('h2', {}, 'Scene'),
    h('p', {}, 'A camera or LiDAR moves through a place with people and vehicles. MMS-SLAM estimates its trajectory and maps the static scene.'),
    h(
      'ul',
      { class: 'meanings' },
      meaning(kColors.person, 'people, with number and speed'),
      meaning(kColors.vehicle, 'vehicles'),
      meaning(kColors.trajectory, 'trajectory of the sensor'),
      meaning(kColors.truth, 'ground truth, if known'),
      meaning(kColors.loop, 'loops: places that were recognized'),
      meaning(kColors.staticScan, 'static points of this frame'),
      meaning(kColors.dynamicScan, 'dynamic points of this frame'),
    ),
    h('h2', {}, 'Navigation'),
    h('p', {}, 'Drag to rotate, scroll or pinch to zoom, drag with the right button or two fingers to pan. A click on a chart goes to that frame.'),
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
