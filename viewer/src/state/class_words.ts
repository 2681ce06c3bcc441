const kPlurals: Record<string, string> = { person: 'people', agv: 'AGVs', vehicle: 'vehicles', unknown: 'unknown' };
const kSingulars: Record<string, string> = { agv: 'AGV' };

/** Name of a class for a number of objects: "people" for two, "AGV" for one. */
export function classWord(count: number, name: string): string {
  return count === 1 ? className(name) : (kPlurals[name] ?? `${name}s`);
}

/** Name of a class in a sentence. */
export function className(name: string): string {
  return kSingulars[name] ?? name;
}
