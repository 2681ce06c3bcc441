import { type CameraMode, kCameraModes, type Settings } from '../state/settings';
import { h, part } from './dom';
import { icon } from './icons';

const kWords: Record<CameraMode, [string, string]> = {
  follow: ['Follow', 'Behind the sensor (1)'],
  orbit: ['Orbit', 'Whole scene, side view (2)'],
  top: ['Top', 'Whole scene, top view (3)'],
};

/** Selects the camera mode of the scene. */
export class ViewModes {
  private readonly buttons = new Map<CameraMode, HTMLElement>();

  constructor(settings: Settings, reset: () => void) {
    for (const mode of kCameraModes) {
      const [name, title] = kWords[mode];
      const button = h('button', { type: 'button', title, 'data-mode': mode, click: () => (settings.camera = mode) }, name);
      this.buttons.set(mode, button);
      part('view-modes').append(button);
    }
    const title = 'Reset the view (0)';
    part('view-modes').append(h('button', { type: 'button', class: 'reset', title, 'aria-label': title, click: reset }, icon('home')));
    settings.on('camera', () => this.update(settings.camera));
    this.update(settings.camera);
  }

  private update(current: CameraMode): void {
    for (const [mode, button] of this.buttons) button.setAttribute('aria-pressed', String(mode === current));
  }
}
