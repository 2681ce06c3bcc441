import type { Unit } from '../protocol/messages';

/** Place of a frame, given by its index, among all, counted from 1. */
export function frameOf(index: number, frames: number): string {
  return `frame ${Math.min(index + 1, frames)} of ${frames}`;
}

/** 83.4 s as 1:23.4. */
export function clock(seconds: number): string {
  const tenths = Math.round(seconds * 10);
  const minutes = Math.floor(tenths / 600);
  return `${minutes}:${((tenths - minutes * 600) / 10).toFixed(1).padStart(4, '0')}`;
}

/** A value with its unit and suitable precision. */
export function quantity(value: number | undefined, unit: Unit): string {
  if (value === undefined || !Number.isFinite(value)) return '–';
  if (unit === 'ms') return `${value.toFixed(value < 10 ? 1 : 0)} ms`;
  if (unit === 'ratio') return `${(100 * value).toFixed(1)} %`;
  if (unit === 'count') return value.toFixed(0);
  return value < 100 ? `${value.toFixed(1)} cm` : `${(value / 100).toFixed(2)} m`;
}

/** Display name of a series: dynamic_share as "dynamic share". */
export function words(name: string): string {
  return name.replace(/_(cm|ms)$/, '').replaceAll('_', ' ');
}
