const kPlurals: Record<string, string> = { person: 'people', agv: 'AGVs', vehicle: 'vehicles' };
const kSingulars: Record<string, string> = { agv: 'AGV' };

/** "2 people", "1 AGV". */
export function counted(count: number, name: string): string {
  return `${count} ${count === 1 ? className(name) : (kPlurals[name] ?? `${name}s`)}`;
}

/** A class as a word in a sentence. */
export function className(name: string): string {
  return kSingulars[name] ?? name;
}
