import { kCameraModes, type Settings } from '../state/settings';
import { part } from './dom';
import { kRows } from './layer_panel';
import type { Player } from './player';

export interface Actions {
  player: Player;
  settings: Settings;
  picture(): void;
  resetView(): void;
}

/** The keys of help.ts. */
export function listenToKeys({ player, settings, picture, resetView }: Actions): void {
  const actions: Record<string, (event: KeyboardEvent) => void> = {
    ' ': () => player.toggle(),
    ArrowLeft: ({ shiftKey }) => player.step(shiftKey ? -10 : -1),
    ArrowRight: ({ shiftKey }) => player.step(shiftKey ? 10 : 1),
    Home: () => player.seek(0),
    End: () => player.end(),
    '+': () => player.changeSpeed(1),
    '-': () => player.changeSpeed(-1),
    '0': resetView,
    p: picture,
    '?': () => part<HTMLDialogElement>('help').showModal(),
  };
  kCameraModes.forEach((mode, i) => (actions[String(i + 1)] = () => (settings.camera = mode)));
  for (const { key, layer } of kRows) actions[key.toLowerCase()] = () => settings.toggle(layer);

  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || isTyping(event) || part<HTMLDialogElement>('help').open) return;
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}

/** Ignores keys that the focused control uses; those of the slider have the same effect. */
function isTyping({ target, key }: KeyboardEvent): boolean {
  if (target instanceof HTMLSelectElement) return true;
  return target instanceof HTMLButtonElement && key === ' ';
}
