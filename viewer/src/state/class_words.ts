const kPlurals: Record<string, string> = { person: 'people', agv: 'AGVs', vehicle: 'vehicles', unknown: 'unknown' };
const kSingulars: Record<string, string> = { agv: 'AGV' };

/** What so many of a class are called: "people" of two, "AGV" of one. */
export function classWord(count: number, name: string): string {
  return count === 1 ? className(name) : (kPlurals[name] ?? `${name}s`);
}

/** A class as a word in a sentence. */
export function className(name: string): string {
  return kSingulars[name] ?? name;
}
