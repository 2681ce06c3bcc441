import { BufferAttribute, BufferGeometry, Sphere, Vector3 } from 'three';

/** Colors as four bytes per point, as GPUs require alignment; gray if there are none. */
export function paddedColors(colors: ArrayLike<number> | null, count: number): Uint8Array {
  const padded = new Uint8Array(4 * count).fill(170);
  for (let i = 0; colors && i < count; ++i) {
    padded[4 * i] = colors[3 * i];
    padded[4 * i + 1] = colors[3 * i + 1];
    padded[4 * i + 2] = colors[3 * i + 2];
  }
  return padded;
}

/** The same points in an order in which every prefix is an even sample. */
export function shuffled(points: Float32Array, colors: Uint8Array | null): { points: Float32Array; colors: Uint8Array } {
  const count = Math.floor(points.length / 3);
  const order = permutation(count);
  const mixedPoints = new Float32Array(3 * count);
  const mixedColors = new Uint8Array(4 * count).fill(170);
  for (let to = 0; to < count; ++to) {
    const from = 3 * order[to];
    for (let k = 0; k < 3; ++k) {
      mixedPoints[3 * to + k] = points[from + k];
      if (colors) mixedColors[4 * to + k] = colors[from + k];
    }
  }
  return { points: mixedPoints, colors: mixedColors };
}

function permutation(count: number): Uint32Array {
  const order = Uint32Array.from({ length: count }, (_, i) => i);
  let state = 1;
  for (let i = count - 1; i > 0; --i) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    const j = Math.floor((state / 2 ** 32) * (i + 1));
    [order[i], order[j]] = [order[j], order[i]];
  }
  return order;
}

/** `colors` has four bytes per point. */
export function pointGeometry(points: Float32Array, colors: Uint8Array): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(points, 3));
  geometry.setAttribute('color', new BufferAttribute(colors, 4, true));
  geometry.boundingSphere = boundingSphere(points);
  return geometry;
}

function boundingSphere(points: Float32Array): Sphere {
  const low = new Vector3(Infinity, Infinity, Infinity);
  const high = new Vector3(-Infinity, -Infinity, -Infinity);
  const point = new Vector3();
  for (let i = 0; i + 2 < points.length; i += 3) {
    point.fromArray(points, i);
    low.min(point);
    high.max(point);
  }
  if (points.length === 0) return new Sphere();
  return new Sphere(low.clone().add(high).multiplyScalar(0.5), low.distanceTo(high) / 2);
}
