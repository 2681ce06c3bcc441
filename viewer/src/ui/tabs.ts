import { h, part } from './dom';
import { icon, type IconName } from './icons';

const kTabs: [string, string, IconName][] = [
  ['image', 'Camera', 'eye'],
  ['charts', 'Charts', 'chart'],
  ['objects', 'Objects', 'people'],
  ['layers', 'Layers', 'layers'],
];

/** On narrow screens one panel at a time; style.css shows the one in #app[data-tab]. */
export class Tabs {
  constructor(changed: () => void) {
    const app = part('app');
    const buttons = kTabs.map(([panel, name, image]) =>
      h(
        'button',
        {
          type: 'button',
          role: 'tab',
          'data-tab': panel,
          click: () => {
            app.dataset.tab = panel;
            update();
            changed();
          },
        },
        icon(image),
        h('span', {}, name),
      ),
    );
    const update = (): void => {
      for (const button of buttons) button.setAttribute('aria-selected', String(button.dataset.tab === app.dataset.tab));
    };
    part('tabs').append(...buttons);
    update();
  }
}
