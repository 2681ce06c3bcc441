import { kColors } from '../scene/palette';
import type { Run } from '../state/run';
import type { Layer, Settings } from '../state/settings';
import { h, part } from './dom';

interface Row {
  layer: Layer;
  name: string;
  key: string;
  /** Colors of the layer in the scene: the panel is also the legend. */
  colors: string[];
  hint: string;
}

export const kRows: Row[] = [
  { layer: 'map', name: 'Static map', key: 'M', colors: ['#8fa3b8'], hint: 'Static points in the colors of the camera, or the intensity of the LiDAR' },
  { layer: 'heights', name: 'Map by height', key: 'H', colors: [kColors.low, kColors.high], hint: 'Static points in colors by their height above the floor' },
  {
    layer: 'scan',
    name: 'Current scan',
    key: 'S',
    colors: [kColors.staticScan, kColors.dynamicScan],
    hint: 'This frame: static points cyan, dynamic ones orange',
  },
  { layer: 'boxes', name: 'Objects', key: 'B', colors: [kColors.person, kColors.vehicle], hint: 'People red, vehicles green' },
  { layer: 'labels', name: 'Labels', key: 'L', colors: [], hint: 'Class, number and speed' },
  { layer: 'trails', name: 'Trails', key: 'R', colors: [kColors.person, kColors.vehicle], hint: 'Where objects came from' },
  { layer: 'trajectory', name: 'Trajectory', key: 'T', colors: [kColors.trajectory], hint: 'Trajectory of the sensor' },
  { layer: 'loops', name: 'Loops', key: 'O', colors: [kColors.loop], hint: 'Places that were recognized' },
  { layer: 'rejected', name: 'Rejected loops', key: 'X', colors: [kColors.rejectedLoop], hint: 'Pairs of places that failed a check' },
  { layer: 'truth', name: 'Truth', key: 'G', colors: [kColors.truth], hint: 'Where the sensor really was' },
  { layer: 'camera', name: 'Sensor', key: 'C', colors: [kColors.camera], hint: 'Where the sensor looks' },
  { layer: 'masks', name: 'Image masks', key: 'K', colors: [kColors.person, kColors.vehicle], hint: 'What was found in the image; overruled masks are blue' },
  { layer: 'grid', name: 'Floor grid', key: 'F', colors: ['#4a5d75'], hint: 'One line per meter' },
  { layer: 'ceiling', name: 'Upper part', key: 'U', colors: [], hint: 'Also show points more than 1 m above the sensor' },
];

/** One switch per layer. */
export class LayerPanel {
  private readonly switches = new Map<Layer, HTMLElement>();

  constructor(
    run: Run,
    private readonly settings: Settings,
  ) {
    for (const row of kRows) part('layers').append(this.row(row));
    settings.on('layer', () => this.update());
    run.on('hello', ({ hello }) => {
      this.switches.get('truth')?.toggleAttribute('disabled', !hello.hasTruth);
      this.switches.get('masks')?.toggleAttribute('disabled', hello.image === null);
      this.showLoops(run);
    });
    run.on('history', () => this.showLoops(run));
    this.update();
  }

  private row({ layer, name, key, colors, hint }: Row): HTMLElement {
    const swatches = h('span', { class: 'swatches' });
    for (const color of colors.slice(0, 2)) {
      const swatch = h('i');
      swatch.style.background = color;
      swatches.append(swatch);
    }
    const button = h(
      'button',
      { class: 'layer', type: 'button', role: 'switch', title: hint, 'data-layer': layer, click: () => this.settings.toggle(layer) },
      h('span', { class: 'knob' }),
      h('span', { class: 'layer-name' }, name),
      swatches,
      h('kbd', {}, key),
    );
    this.switches.set(layer, button);
    return button;
  }

  private showLoops({ loops }: Run): void {
    const accepted = loops?.accepted.reduce((sum, one) => sum + one, 0) ?? 0;
    const rejected = (loops?.accepted.length ?? 0) - accepted;
    const show = (layer: Layer, count: number, what: string): void => {
      this.switches.get(layer)?.toggleAttribute('disabled', count === 0);
      this.switches.get(layer)?.setAttribute('title', `${count} ${what}`);
    };
    show('loops', accepted, 'places were recognized');
    show('rejected', rejected, 'pairs of places failed a check');
  }

  private update(): void {
    for (const [layer, button] of this.switches) button.setAttribute('aria-checked', String(this.settings.shows(layer)));
  }
}
