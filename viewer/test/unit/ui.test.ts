import { describe, expect, it } from 'vitest';
import { plotData } from '../../src/ui/chart_data';
import { classWord } from '../../src/state/class_words';
import { clock, frameOf, quantity, words } from '../../src/ui/format';
import { tint } from '../../src/ui/mask_overlay';

describe('format', () => {
  it('formats times and quantities', () => {
    expect(clock(83.44)).toBe('1:23.4');
    expect(clock(59.97)).toBe('1:00.0');
    expect(frameOf(0, 149)).toBe('frame 1 of 149');
    expect(frameOf(148, 149)).toBe('frame 149 of 149');
    expect(frameOf(0, 0)).toBe('frame 0 of 0');
    expect(quantity(9.94, 'ms')).toBe('9.9 ms');
    expect(quantity(143.2, 'ms')).toBe('143 ms');
    expect(quantity(0.104, 'ratio')).toBe('10.4 %');
    expect(quantity(250, 'cm')).toBe('2.50 m');
    expect(quantity(NaN, 'count')).toBe('–');
  });

  it('names objects in words', () => {
    expect(classWord(1, 'person')).toBe('person');
    expect(classWord(3, 'person')).toBe('people');
    expect(classWord(1, 'agv')).toBe('AGV');
    expect(words('dynamic_share')).toBe('dynamic share');
    expect(words('drift_cm')).toBe('drift');
  });
});

describe('plotData', () => {
  const line = (values: number[]) => ({ name: '', color: '#000000', values: Float32Array.from(values) });

  it('stacks lines, the last one at the bottom', () => {
    const [frames, top, bottom] = plotData([line([1, 2]), line([10, NaN])], true);
    expect(frames).toEqual([0, 1]);
    expect(top).toEqual([11, 2]);
    expect(bottom).toEqual([10, null]);
  });

  it('plots a long run in columns with their maximum', () => {
    const values = Array.from({ length: 9000 }, (_, i) => (i === 4321 ? 500 : 1));
    const [frames, column] = plotData([line(values)], false);
    expect(frames.length).toBeLessThanOrEqual(1500);
    expect(Math.max(...(column as number[]))).toBe(500);
    expect(frames[(column as number[]).indexOf(500)]).toBe(4320);
  });
});

describe('tint', () => {
  it('colors classes, more at edges, and leaves static pixels clear', () => {
    const width = 5;
    const labels = [0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 1, 1, 1, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 2];
    const pixels = new Uint8ClampedArray(labels.flatMap((label) => [label, label, label, 255]));
    tint(pixels, width, 5, [[255, 0, 0], [0, 255, 0]]);
    const at = (x: number, y: number): number[] => [...pixels.slice(4 * (y * width + x), 4 * (y * width + x) + 4)];
    expect(at(0, 0)).toEqual([0, 0, 0, 0]);
    expect(at(1, 1)).toEqual([255, 0, 0, 255]);
    expect(at(2, 2)).toEqual([255, 0, 0, 105]);
    expect(at(4, 4)).toEqual([0, 255, 0, 255]);
  });

  it('colors overruled masks blue and unknown classes amber', () => {
    const pixels = new Uint8ClampedArray([255, 255, 255, 255, 7, 7, 7, 255]);
    tint(pixels, 2, 1, [[255, 0, 0]]);
    expect([...pixels]).toEqual([91, 124, 255, 255, 255, 184, 77, 255]);
  });
});
