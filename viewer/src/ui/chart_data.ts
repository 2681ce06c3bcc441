import type { AlignedData } from 'uplot';

export interface Line {
  name: string;
  color: string;
  values: Float32Array;
}

/** Largest number of plotted columns: a column then shows the maximum of its frames. */
const kColumns = 1500;

/** Number of frames per column. */
export function columnFrames(lines: Line[]): number {
  return Math.max(1, Math.ceil(Math.max(0, ...lines.map(({ values }) => values.length)) / kColumns));
}

/** Columns for uPlot: frames, and the values of each line; stacked ones as sums, the last line at the bottom. */
export function plotData(lines: Line[], stacked: boolean): AlignedData {
  const frames = Math.max(0, ...lines.map(({ values }) => values.length));
  const step = columnFrames(lines);
  const x = Array.from({ length: Math.ceil(frames / step) }, (_, i) => i * step);
  const columns = lines.map(({ values }) => x.map((from) => largest(values, from, from + step)));
  const shown = stacked ? stack(columns) : columns;
  return [x, ...shown.map((column) => column.map((value) => (Number.isFinite(value) ? value : null)))];
}

/** The sum of every column with the following ones. */
export function stack(columns: number[][]): number[][] {
  const sums = columns.map((column) => [...column]);
  for (let i = sums.length - 2; i >= 0; --i) {
    sums[i] = sums[i].map((value, row) => value + (sums[i + 1][row] || 0));
  }
  return sums;
}

/** NaN if there is none. */
function largest(values: Float32Array, from: number, to: number): number {
  let most = NaN;
  for (let i = from; i < Math.min(to, values.length); ++i) {
    if (!(values[i] <= most) && Number.isFinite(values[i])) most = values[i];
  }
  return most;
}
