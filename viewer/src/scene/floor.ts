import { Color, Mesh, PlaneGeometry, ShaderMaterial } from 'three';
import { kColors } from './palette';
import { pointUniforms } from './point_material';

const kBin = 0.05;

/**
 * Height of the floor: the most frequent height below the sensor's start, which is at height 0. Null if too few points
 * lie below it.
 */
export function floorHeight(heights: Iterable<number>): number | null {
  const bins = new Map<number, number>();
  for (const height of heights) {
    if (height > -0.1) continue;
    const bin = Math.round(height / kBin);
    bins.set(bin, (bins.get(bin) ?? 0) + 1);
  }
  let [best, most] = [0, 0];
  for (const [bin, count] of bins) if (count > most) [best, most] = [bin, count];
  return most < 20 ? null : best * kBin;
}

/** Heights of the colors: from the floor to that below which nearly all points lie, at least 2 m. */
export function heightRange(heights: number[], floor: number): [number, number] {
  const sorted = Float64Array.from(heights).sort();
  return [floor, Math.max(floor + 2, sorted[Math.floor(0.98 * sorted.length)] ?? floor)];
}

const kVertex = /* glsl */ `
  varying vec3 at;
  varying vec3 eye;
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    at = world.xyz;
    eye = cameraPosition;
    gl_Position = projectionMatrix * viewMatrix * world;
  }`;

const kFragment = /* glsl */ `
  uniform vec3 color;
  uniform float haze;
  varying vec3 at;
  varying vec3 eye;
  float lines(float cell) {
    vec2 p = at.xz / cell;
    vec2 width = fwidth(p);
    vec2 from = abs(fract(p - 0.5) - 0.5) / width;
    return (1.0 - min(min(from.x, from.y), 1.0)) * (1.0 - smoothstep(0.15, 0.5, max(width.x, width.y)));
  }
  void main() {
    float fade = 1.0 - smoothstep(0.5 * haze, 2.5 * haze, distance(at, eye));
    float alpha = max(0.35 * lines(1.0), 0.7 * max(lines(5.0), lines(25.0))) * fade;
    if (alpha < 0.01) discard;
    gl_FragColor = vec4(color, alpha);
  }`;

/** A grid of meters on the floor, bold every five meters, in the scene frame (y up). */
export function floorGrid(): Mesh {
  const plane = new PlaneGeometry(600, 600).rotateX(-Math.PI / 2);
  const material = new ShaderMaterial({
    vertexShader: kVertex,
    fragmentShader: kFragment,
    uniforms: { haze: pointUniforms.haze, color: { value: new Color(kColors.grid).convertLinearToSRGB() } },
    transparent: true,
    depthWrite: false,
  });
  const grid = new Mesh(plane, material);
  grid.position.y = -1;
  return grid;
}
