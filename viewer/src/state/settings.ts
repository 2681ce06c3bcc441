import { Emitter } from './emitter';

export const kLayers = [
  'map',
  'heights',
  'scan',
  'boxes',
  'labels',
  'trails',
  'trajectory',
  'loops',
  'rejected',
  'truth',
  'camera',
  'grid',
  'ceiling',
  'masks',
] as const;
export type Layer = (typeof kLayers)[number];

export const kCameraModes = ['follow', 'orbit', 'top'] as const;
export type CameraMode = (typeof kCameraModes)[number];

type SettingEvents = { layer: Layer; camera: CameraMode };

const kKey = 'mms-viewer-3'; // counts up with the layers
const kHiddenAtFirst: Layer[] = ['heights', 'rejected', 'ceiling'];

/** Display settings of the user, stored in the browser. */
export class Settings extends Emitter<SettingEvents> {
  private readonly hidden: Set<Layer>;
  private mode: CameraMode = 'follow';

  constructor(private readonly storage: Pick<Storage, 'getItem' | 'setItem'> | null) {
    super();
    const saved = read(storage);
    this.hidden = new Set(saved.hidden ?? kHiddenAtFirst);
    this.mode = saved.camera ?? 'follow';
  }

  get camera(): CameraMode {
    return this.mode;
  }

  set camera(mode: CameraMode) {
    this.mode = mode;
    this.save();
    this.emit('camera', mode);
  }

  shows(layer: Layer): boolean {
    return !this.hidden.has(layer);
  }

  toggle(layer: Layer): void {
    if (!this.hidden.delete(layer)) this.hidden.add(layer);
    this.save();
    this.emit('layer', layer);
  }

  private save(): void {
    try {
      this.storage?.setItem(kKey, JSON.stringify({ hidden: [...this.hidden], camera: this.mode }));
    } catch {
      // If storage is full or forbidden, the settings are not stored.
    }
  }
}

function read(storage: Pick<Storage, 'getItem'> | null): { hidden?: Layer[]; camera?: CameraMode } {
  try {
    const saved = JSON.parse(storage?.getItem(kKey) ?? '{}') as { hidden?: unknown; camera?: unknown };
    return {
      hidden: Array.isArray(saved.hidden) ? kLayers.filter((layer) => (saved.hidden as unknown[]).includes(layer)) : undefined,
      camera: kCameraModes.find((mode) => mode === saved.camera),
    };
  } catch {
    return {};
  }
}
