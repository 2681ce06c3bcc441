/** Share of every chunk to draw. Chunks are shuffled, so the first points are an even sample. */

export interface ChunkView {
  count: number;
  /** Distance between adjacent points [m]. */
  voxel: number;
  /** From the camera to the chunk's nearest point [m]. */
  distance: number;
}

/** Largest number of points per pixel that a voxel covers. */
const kPointsPerPixel = 2;
const kMinPoints = 64;

/**
 * Number of points to draw per chunk, about `budget` in total. `pixelsPerMetre` is the size of a meter at a distance of
 * one meter. Distant chunks are reduced first: their voxels are smaller than pixels.
 */
export function drawnCounts(chunks: ChunkView[], pixelsPerMetre: number, budget: number): number[] {
  const wanted = chunks.map(({ voxel, distance }) => kPointsPerPixel * ((voxel * pixelsPerMetre) / distance) ** 2);
  const drawn = (i: number, scale: number): number => {
    const { count } = chunks[i];
    return Math.min(count, Math.max(kMinPoints, Math.floor(count * Math.min(1, scale * wanted[i]))));
  };
  const total = (scale: number): number => {
    let sum = 0;
    for (let i = 0; i < chunks.length; ++i) sum += drawn(i, scale);
    return sum;
  };
  const counts = (scale: number): number[] => chunks.map((_, i) => drawn(i, scale));

  if (total(1) <= budget) return counts(1);
  let [low, high] = [-30, 0]; // powers of two: the range covers near chunks
  for (let i = 0; i < 16; ++i) {
    const middle = (low + high) / 2;
    if (total(2 ** middle) > budget) high = middle;
    else low = middle;
  }
  return counts(2 ** low);
}
