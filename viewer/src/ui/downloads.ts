import type { Run } from '../state/run';
import { h, part } from './dom';
import { icon } from './icons';

const kNames: Record<string, string> = {
  'static_map.ply': 'Static map',
  'semantic_map.ply': 'Map with object trajectories',
  'static_map.pcd': 'Static map',
  'trajectory.tum': 'Trajectory',
  'trajectory_kitti.txt': 'Trajectory, KITTI',
  'keyframes.tum': 'Keyframes',
  'objects.json': 'Objects',
  'metrics.json': 'Metrics',
  'timing.csv': 'Times',
  'report.html': 'Report',
  'config.yaml': 'Settings',
};

/** A menu of the run's files. */
export class Downloads {
  private readonly list = h('div', { class: 'menu-list', role: 'menu', hidden: true });
  private readonly button: HTMLElement;

  constructor(run: Run) {
    const title = 'Download the map, the trajectory and more';
    this.button = h(
      'button',
      { class: 'icon-button', type: 'button', title, 'aria-label': title, 'aria-haspopup': 'menu', click: () => this.open(this.list.hidden) },
      icon('download'),
    );
    part('downloads').append(this.button, this.list);
    run.on('hello', ({ hello }) => this.fill(hello.files));
    run.on('playback', ({ files }) => files && this.fill(files));
    document.addEventListener('pointerdown', (event) => {
      if (!part('downloads').contains(event.target as Node)) this.open(false);
    });
    document.addEventListener('keydown', (event) => event.key === 'Escape' && this.open(false));
    this.fill([]);
  }

  private open(open: boolean): void {
    this.list.hidden = !open;
    this.button.setAttribute('aria-expanded', String(open));
  }

  private fill(files: string[]): void {
    this.button.toggleAttribute('disabled', files.length === 0);
    this.list.replaceChildren(...files.map((file) => this.entry(file)));
  }

  private entry(file: string): HTMLElement {
    const page = file.endsWith('.html');
    return h(
      'a',
      {
        role: 'menuitem',
        href: `./files/${encodeURIComponent(file)}`,
        ...(page ? { target: '_blank', rel: 'noopener' } : { download: file }),
        click: () => this.open(false),
      },
      h('span', {}, kNames[file] ?? file),
      h('small', {}, file),
    );
  }
}

/** Downloads a file created in the page. */
export function save(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  h('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}
