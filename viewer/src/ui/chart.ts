import uPlot from 'uplot';
import { columnFrames, type Line, plotData, stack } from './chart_data';
import { h, setText } from './dom';

export interface ChartLook {
  title: string;
  /** Formats a value for the axis and the heading. */
  format(value: number | undefined): string;
  /** Axis position and label of a frame. */
  position(frame: number): number;
  formatPosition(position: number): string;
  /** Stacked and filled lines. */
  stacked?: boolean;
  onSeek(frame: number): void;
}

const kAxis = '#7f8fa3';
const kFont = '11px system-ui, "Segoe UI", Roboto, sans-serif';

/** One plot over the frames, with the values at the playhead in the heading; a click seeks. */
export class Chart {
  readonly root: HTMLElement;
  private readonly title = h('h3');
  private readonly value = h('b');
  private readonly legend = h('div', { class: 'legend' });
  private readonly area = h('div', { class: 'plot' });
  private readonly playhead = h('div', { class: 'playhead' });
  private plot: uPlot | null = null;
  private lines: Line[] = [];
  private names = '';
  private frame = 0;

  constructor(private readonly look: ChartLook) {
    setText(this.title, look.title);
    const heading = h('header', {}, this.title, this.value);
    this.root = h('div', { class: 'chart' }, heading, this.area, this.legend);
    new ResizeObserver(() => this.resize()).observe(this.area);
  }

  setTitle(title: string): void {
    setText(this.title, title);
  }

  setLines(lines: Line[]): void {
    this.lines = lines;
    this.root.hidden = lines.length === 0;
    if (this.root.hidden) return;
    const names = lines.map(({ name }) => name).join();
    if (!this.plot || names !== this.names) this.build(names);
    this.plot?.setData(this.data());
    this.setFrame(this.frame);
  }

  /** Moves the playhead and shows the values there. */
  setFrame(frame: number): void {
    this.frame = frame;
    const values = this.lines.map(({ values: all }) => all[frame]);
    const known = values.filter((value) => Number.isFinite(value));
    const shown = this.look.stacked ? known.reduce((sum, value) => sum + value, 0) : values[0];
    setText(this.value, this.look.format(known.length ? shown : undefined));
    [...this.legend.children].forEach((entry, i) => {
      setText(entry.lastElementChild as HTMLElement, this.look.format(values[i]));
    });
    if (!this.plot) return;
    const left = this.plot.valToPos(this.look.position(frame), 'x');
    this.playhead.style.transform = `translateX(${Number.isFinite(left) ? left : -10}px)`;
  }

  private build(names: string): void {
    this.names = names;
    this.plot?.destroy();
    this.plot = new uPlot(this.options(), this.data(), this.area);
    this.plot.over.append(this.playhead);
    this.plot.over.addEventListener('click', () => this.seek());
    this.legend.replaceChildren(...(this.lines.length > 1 ? this.lines.map(legendEntry) : []));
  }

  private data(): uPlot.AlignedData {
    const [frames, ...columns] = plotData(this.lines, this.look.stacked === true);
    return [Array.from(frames, (frame) => this.look.position(frame)), ...columns];
  }

  private seek(): void {
    const left = this.plot?.cursor.left ?? -1;
    if (this.plot && left >= 0) this.look.onSeek(this.plot.posToIdx(left) * columnFrames(this.lines));
  }

  private options(): uPlot.Options {
    const axis: uPlot.Axis = {
      stroke: kAxis,
      font: kFont,
      grid: { stroke: 'rgba(127, 143, 163, 0.14)', width: 1 },
      ticks: { show: false },
    };
    return {
      ...this.size(),
      padding: [6, 8, 0, 0],
      legend: { show: false },
      cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
      scales: { x: { time: false }, y: { range: (_, low, high) => axisRange(low, this.highest(high)) } },
      axes: [
        { ...axis, size: 22, space: 60, values: (_, at) => at.map((position) => this.look.formatPosition(position)) },
        { ...axis, size: 52, space: 18, values: (_, values) => values.map((value) => axisText(this.look.format(value))) },
      ],
      series: [{}, ...this.lines.map((line) => seriesLook(line, this.look.stacked === true))],
    };
  }

  /** Upper limit of the axis: rare peaks, such as that of the first frame, are cut off. */
  private highest(high: number): number {
    if (!this.look.stacked) return high;
    const step = columnFrames(this.lines); // a sample of a long run
    const sample = this.lines.map(({ values }) => Array.from(values).filter((_, i) => i % step === 0));
    const totals = stack(sample)[0]?.filter(Number.isFinite) ?? [];
    const usual = totals.sort((a, b) => a - b)[Math.floor(0.99 * (totals.length - 1))] ?? high;
    return Math.min(high, 1.25 * usual);
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(50, this.area.clientWidth), height: Math.max(40, this.area.clientHeight) };
  }

  private resize(): void {
    if (this.area.clientWidth === 0) return;
    this.plot?.setSize(this.size());
    this.setFrame(this.frame);
  }
}

function legendEntry({ name, color }: Line): HTMLElement {
  const swatch = h('i');
  swatch.style.background = color;
  return h('span', {}, swatch, `${name} `, h('em'));
}

function seriesLook({ color }: Line, stacked: boolean): uPlot.Series {
  return { stroke: color, width: stacked ? 1 : 1.6, fill: stacked ? `${color}66` : `${color}1f`, points: { show: false } };
}

function axisRange(low: number, high: number): [number, number] {
  if (!Number.isFinite(high)) return [0, 1];
  return [Math.min(0, low), high > 0 ? 1.08 * high : 1];
}

/** Integers need no decimals. */
function axisText(text: string): string {
  return text.replace(/\.0(?= )/, '');
}
