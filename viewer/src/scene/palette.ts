/** Colors with a meaning; style.css has the same for the page. */
export const kColors = {
  background: '#0a0e14',
  person: '#ff4d5e',
  vehicle: '#3ddc84',
  object: '#ffb84d',
  overruled: '#5b7cff',
  trajectory: '#4db8ff',
  truth: '#f2e3b6',
  loop: '#c6ff4d',
  rejectedLoop: '#a8506e',
  staticScan: '#62d6e8',
  dynamicScan: '#ff9f43',
  camera: '#ffffff',
  grid: '#2a3646',
  low: '#4040ff',
  high: '#ff4040',
} as const;

/** Red for people, green for all vehicles, amber for unknown classes. */
export function classColor(name: string): string {
  if (name === 'person') return kColors.person;
  return ['vehicle', 'agv', 'car', 'truck', 'forklift', 'robot'].includes(name) ? kColors.vehicle : kColors.object;
}
