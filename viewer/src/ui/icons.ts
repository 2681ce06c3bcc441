/** Line icons of 24 by 24. */
const kPaths = {
  play: 'M7 4.5v15l12-7.5z',
  pause: 'M8 5v14M16 5v14',
  forward: 'M6 5v14l9-7zM18.5 5v14',
  back: 'M18 5v14l-9-7zM5.5 5v14',
  replay: 'M4.5 12a7.5 7.5 0 1 0 2.4-5.500M4.5 4v4.500H9',
  camera: 'M4 8h3.500l1.5-2.500h6L16.5 8H20v11H4zM12 16.500a3.2 3.2 0 1 0 0-6.4 3.2 3.2 0 0 0 0 6.400z',
  download: 'M12 4v11M7.5 11l4.5 4.500L16.5 11M5 19.500h14',
  help: 'M9.2 9.300a2.9 2.9 0 1 1 4.2 2.600c-1 .5-1.4 1.1-1.4 2.100M12 17.300v.2M12 21a9 9 0 1 0 0-18 9 9 0 0 0 0 18z',
  home: 'M4 11l8-7 8 7M6.5 9.500V20h11V9.5',
  eye: 'M2.5 12S6 5.5 12 5.5 21.5 12 21.5 12 18 18.5 12 18.5 2.5 12 2.5 12zM12 14.700a2.7 2.7 0 1 0 0-5.4 2.7 2.7 0 0 0 0 5.400z',
  chart: 'M4 4v16h16M8 15l3.5-4.5 3 2.500L20 7',
  layers: 'M12 4l9 4.7-9 4.7-9-4.700zM3.5 13.300L12 17.800l8.5-4.5',
  people: 'M12 11.500a3.5 3.5 0 1 0 0-7 3.5 3.5 0 0 0 0 7zM5 20c.4-3.7 3-5.7 7-5.700s6.6 2 7 5.7',
} as const;
export type IconName = keyof typeof kPaths;

const kFilled: IconName[] = ['play'];

export function icon(name: IconName): SVGElement {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '0 0 24 24');
  svg.setAttribute('class', kFilled.includes(name) ? 'icon filled' : 'icon');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  path.setAttribute('d', kPaths[name]);
  svg.append(path);
  return svg;
}
