/** How much of every chunk is drawn. Chunks are shuffled, so the first points of one are an even sample of it. */

export interface ChunkView {
  count: number;
  /** Distance between neighbouring points [m]. */
  voxel: number;
  /** From the eye to the chunk's nearest point [m]. */
  distance: number;
}

/** More points than this for each pixel that a voxel covers are never drawn. */
const kPointsPerPixel = 2;
const kFewest = 64;

/**
 * Points to draw of each chunk, at most about `budget` together. `pixelsPerMetre` is the size of a metre at a distance
 * of one metre. What is far gives way first: its voxels are smaller than pixels.
 */
export function drawnCounts(chunks: ChunkView[], pixelsPerMetre: number, budget: number): number[] {
  const wanted = chunks.map(({ voxel, distance }) => kPointsPerPixel * ((voxel * pixelsPerMetre) / distance) ** 2);
  const drawn = (i: number, scale: number): number => {
    const { count } = chunks[i];
    return Math.min(count, Math.max(kFewest, Math.floor(count * Math.min(1, scale * wanted[i]))));
  };
  const total = (scale: number): number => {
    let sum = 0;
    for (let i = 0; i < chunks.length; ++i) sum += drawn(i, scale);
    return sum;
  };
  const counts = (scale: number): number[] => chunks.map((_, i) => drawn(i, scale));

  if (total(1) <= budget) return counts(1);
  let [low, high] = [-30, 0]; // powers of two: what is near can be wanted a thousandfold
  for (let i = 0; i < 16; ++i) {
    const middle = (low + high) / 2;
    if (total(2 ** middle) > budget) high = middle;
    else low = middle;
  }
  return counts(2 ** low);
}
