import { kColors } from '../scene/palette';

const kOverruled = 255; // gray value of masked points that count as static for the pose
const kFill = 105;
const kEdge = 255;

/** A mask (gray value 0: static, 1 + class index, 255: overruled) in colors: pale inside, opaque at the boundary. */
export function tintMask(mask: ImageBitmap, colors: string[]): HTMLCanvasElement {
  const { width, height } = mask;
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width, height });
  const context = canvas.getContext('2d', { willReadFrequently: true }) as CanvasRenderingContext2D;
  context.drawImage(mask, 0, 0);
  mask.close();
  const picture = context.getImageData(0, 0, width, height);
  tint(picture.data, width, height, colors.map(rgb));
  context.putImageData(picture, 0, 0);
  return canvas;
}

/** Converts the gray values of RGBA pixels to colors in place. */
export function tint(pixels: Uint8ClampedArray, width: number, height: number, colors: number[][]): void {
  const labels = Uint8Array.from({ length: width * height }, (_, i) => pixels[4 * i]);
  for (let i = 0; i < labels.length; ++i) {
    const label = labels[i];
    const color = label === kOverruled ? rgb(kColors.overruled) : (colors[label - 1] ?? kUnknown);
    pixels.set(label === 0 ? kClear : [...color, isEdge(labels, i, width) ? kEdge : kFill], 4 * i);
  }
}

const kClear = [0, 0, 0, 0];
const kUnknown = [255, 184, 77];

function isEdge(labels: Uint8Array, i: number, width: number): boolean {
  const label = labels[i];
  const differs = (j: number) => j >= 0 && j < labels.length && labels[j] !== label;
  return differs(i - 1) || differs(i + 1) || differs(i - width) || differs(i + width);
}

function rgb(hex: string): number[] {
  return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
}
