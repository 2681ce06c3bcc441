import 'uplot/dist/uPlot.min.css';
import type { Unit } from '../protocol/messages';
import { kColors } from '../scene/palette';
import type { Run } from '../state/run';
import { kInterval, type Series } from '../state/series';
import { throttled } from '../state/throttled';
import { Chart } from './chart';
import type { Line } from './chart_data';
import { h, part } from './dom';
import { clock, quantity, words } from './format';

const kStageColors = ['#4db8ff', '#9b8cff', '#ff9f43', '#3ddcc0', '#f2d35e', '#ff6fae', '#8fa3b8', '#b7e06a'];
const kColorOf: Record<string, string> = {
  dynamic_share: kColors.dynamicScan,
  overruled_share: kColors.overruled,
  objects: kColors.person,
  error_cm: kColors.truth,
  drift_cm: kColors.trajectory,
};
/** Update period of the charts of a live run [ms]; only the playhead moves with every frame. */
const kRedraw = 300;

interface Slot {
  chart: Chart;
  unit: Unit;
}

/** Milliseconds per stage, dynamic share, drift and error, objects: all per frame. */
export class ChartPanel {
  private readonly slots: Slot[];
  private readonly empty = h('p', { class: 'empty' }, 'Times, dynamic share, drift and objects appear here with the frames.');
  private plotted = 0;

  constructor(
    private readonly run: Run,
    private readonly seek: (frame: number) => void,
  ) {
    this.slots = [
      { chart: this.chart('Time of the stages', 'ms', true), unit: 'ms' },
      { chart: this.chart('Dynamic share', 'ratio'), unit: 'ratio' },
      { chart: this.chart('Drift', 'cm'), unit: 'cm' },
      { chart: this.chart('Objects', 'count'), unit: 'count' },
    ];
    part('charts').append(this.empty, ...this.slots.map(({ chart }) => chart.root));
    const redraw = throttled(kRedraw, () => this.redraw());
    run.on('hello', redraw);
    run.on('history', redraw);
    run.on('frame', ({ frame }) => {
      if (run.series.frames > this.plotted) redraw();
      for (const { chart } of this.slots) chart.setFrame(frame);
    });
    this.redraw();
  }

  private chart(title: string, unit: Unit, stacked = false): Chart {
    return new Chart({
      title,
      stacked,
      format: (value) => quantity(value, unit),
      position: (frame) => (this.timed ? (this.run.trajectory.time(frame) ?? NaN) : frame),
      formatPosition: (position) => (this.timed ? clock(position).replace(/\.0$/, '') : String(position)),
      onSeek: this.seek,
    });
  }

  /** Whether the axis is in seconds; in frames if stamps are unknown. */
  private get timed(): boolean {
    return this.run.trajectory.time(this.run.series.frames - 1) !== null;
  }

  /** With ground truth, the error is more informative than the distance from the start. */
  private shown(unit: Unit): Series[] {
    const all = this.run.series.of(unit).filter(({ name }) => name !== kInterval);
    const error = all.filter(({ name }) => name === 'error_cm');
    return unit === 'cm' && error.length > 0 ? error : all;
  }

  private redraw(): void {
    this.plotted = this.run.series.frames;
    this.empty.hidden = this.plotted > 0;
    for (const { chart, unit } of this.slots) {
      const shown = this.shown(unit);
      if (unit === 'cm') chart.setTitle(shown.some(({ name }) => name === 'error_cm') ? 'Position error' : 'Drift');
      chart.setLines(shown.map(line));
    }
  }
}

function line({ name, values }: Series, index: number): Line {
  const color = kColorOf[name] ?? kStageColors[index % kStageColors.length];
  return { name: words(name), color, values: values.values };
}
