import { unit } from '../protocol/decode';
import type { SeriesMessage, Unit } from '../protocol/messages';
import { Rows } from './growable';

export interface Series {
  name: string;
  unit: Unit;
  values: Rows;
}

/** Name of the time since the end of the previous frame; stages overlap, so that their sum is larger. */
export const kInterval = 'interval';

/** Plotted values per frame: one growing column per name. */
export class SeriesTable {
  readonly all: Series[] = [];

  get frames(): number {
    return Math.max(0, ...this.all.map((series) => series.values.length));
  }

  set({ firstFrame, names, units, values }: SeriesMessage): void {
    const rows = Math.floor(values.length / Math.max(1, names.length));
    names.forEach((name, column) => {
      const one = Float32Array.from({ length: rows }, (_, row) => values[row * names.length + column]);
      this.find(name, units[column]).values.write(firstFrame, one);
    });
  }

  add(frame: number, values: Record<string, number | null>): void {
    for (const [name, value] of Object.entries(values)) {
      if (typeof value === 'number') this.find(name).values.write(frame, [value]);
    }
  }

  of(unitWanted: Unit): Series[] {
    return this.all.filter((series) => series.unit === unitWanted);
  }

  private find(name: string, unitSent?: Unit): Series {
    let series = this.all.find((one) => one.name === name);
    if (!series) {
      series = { name, unit: unit(unitSent, name), values: new Rows(1) };
      this.all.push(series);
    }
    return series;
  }
}
