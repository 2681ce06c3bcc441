import { Color, ShaderMaterial, Vector2 } from 'three';
import { kColors } from './palette';

/** Higher than any point [m]; shaders have no infinity. */
export const kHigh = 1e6;

/** Uniforms shared by all points of the scene. */
export const pointUniforms = {
  /** Pixels per meter at a distance of one meter (perspective), or anywhere (orthographic). */
  pixelsPerMetre: { value: 1000 },
  orthographic: { value: false },
  /** Points above this height in the scene frame are not drawn [m]. */
  ceiling: { value: kHigh },
  /** Distance from which points fade into the background [m]. */
  haze: { value: 30 },
  background: { value: new Color(kColors.background).convertLinearToSRGB() },
};

const kVertex = /* glsl */ `
  uniform float size, pixelsPerMetre, smallest;
  uniform bool orthographic;
  uniform float ceiling, nearer, haze;
  uniform vec3 background, tint;
  uniform float tintShare, saturation;
  uniform bool byHeight;
  uniform vec2 heights;
  attribute vec3 color;
  varying vec3 shade;
  varying float pixels;
  vec3 colorOfHeight(float height) {
    float hue = 0.66 * (1.0 - clamp((height - heights.x) / heights.y, 0.0, 1.0));
    return 0.25 + 0.75 * clamp(abs(mod(6.0 * hue + vec3(0.0, 4.0, 2.0), 6.0) - 3.0) - 1.0, 0.0, 1.0);
  }
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    vec4 eye = viewMatrix * world;
    gl_Position = projectionMatrix * vec4(eye.xyz * (1.0 - nearer), 1.0);
    pixels = clamp(size * pixelsPerMetre / (orthographic ? 1.0 : -eye.z), smallest, 48.0);
    gl_PointSize = pixels;
    if (world.y > ceiling) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    vec3 own = byHeight ? colorOfHeight(world.y) : mix(vec3(dot(color, vec3(0.3, 0.59, 0.11))), color, saturation);
    float far = orthographic ? 0.0 : smoothstep(haze, 4.0 * haze, -eye.z);
    shade = mix(mix(own, tint, tintShare), background, far);
  }`;

const kFragment = /* glsl */ `
  varying vec3 shade;
  varying float pixels;
  void main() {
    vec2 from = gl_PointCoord - 0.5;
    if (pixels > 3.0 && dot(from, from) > 0.25) discard;
    gl_FragColor = vec4(shade, 1.0);
  }`;

export interface PointLook {
  /** Diameter [m]. */
  size: number;
  /** Smallest diameter on the screen [px]. */
  smallest?: number;
  tint?: string;
  /** 0: the points' colors, 1: the tint. */
  tintShare?: number;
  saturation?: number;
  /** Drawn in full height regardless of the ceiling. */
  whole?: boolean;
  /** Share of the distance by which it is drawn nearer, to be in front of points at the same position. */
  nearer?: number;
}

/** Points as discs with a size in meters, in sRGB as recorded. */
export function pointMaterial(look: PointLook): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: kVertex,
    fragmentShader: kFragment,
    uniforms: {
      ...pointUniforms,
      ...(look.whole ? { ceiling: { value: kHigh } } : {}),
      nearer: { value: look.nearer ?? 0 },
      size: { value: look.size },
      smallest: { value: look.smallest ?? 1.5 },
      tint: { value: new Color(look.tint ?? '#ffffff').convertLinearToSRGB() },
      tintShare: { value: look.tintShare ?? 0 },
      saturation: { value: look.saturation ?? 1 },
      byHeight: { value: false },
      heights: { value: new Vector2(0, 1) },
    },
  });
}
