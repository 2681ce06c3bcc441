import { describe, expect, it, vi } from 'vitest';
import { decodeMessage } from '../../src/protocol/decode';
import type { Buffer } from '../../src/protocol/envelope';
import type { Command } from '../../src/protocol/messages';
import { Place } from '../../src/state/place';
import { Run } from '../../src/state/run';
import { Settings } from '../../src/state/settings';
import { throttled } from '../../src/state/throttled';
import { forEachTrailSegment, type Track } from '../../src/state/tracks';
import { message } from './message';

function tell(run: Run, header: object, buffers: [string, number, Buffer][] = []): void {
  const decoded = decodeMessage(message(header, buffers));
  if (decoded) run.apply(decoded);
}

const kHello = { type: 'hello', protocol: 1, name: 'loop', run: 'a', classes: ['person', 'agv'], frames: 4 };
const pose = (x: number): Float32Array => Float32Array.of(x, 0, 0, 0, 0, 0, 1);

describe('Run', () => {
  it('has the whole trajectory of a finished run', () => {
    const run = new Run();
    tell(run, kHello);
    tell(run, { type: 'trajectory', first_frame: 0 }, [
      ['pose', 7, Float32Array.of(...pose(0), ...pose(1))],
      ['stamp', 1, Uint32Array.of(0, 250)],
      ['truth', 3, Float32Array.of(0, 0, 0, NaN, NaN, NaN)],
    ]);
    expect(run.trajectory.frames).toBe(2);
    expect(run.trajectory.poses.row(1)[0]).toBe(1);
    expect(run.trajectory.time(1)).toBe(0.25);
    expect(run.trajectory.time(2)).toBeNull();
    expect(run.frames).toBe(4);
  });

  it('knows the times of frames after joining a live run', () => {
    const run = new Run();
    tell(run, { ...kHello, frames: null, live: true });
    tell(run, { type: 'trajectory', first_frame: 0 }, [
      ['pose', 7, Float32Array.of(...pose(0), ...pose(1))],
      ['stamp', 1, Uint32Array.of(0, 100)],
    ]);
    tell(run, { type: 'frame', frame: 1, stamp_ns: '5100000000' }, [['pose', 7, pose(1)]]);
    tell(run, { type: 'frame', frame: 2, stamp_ns: '5200000000' }, [['pose', 7, pose(2)]]);
    expect(run.trajectory.time(2)).toBeCloseTo(0.2, 6);
  });

  it('appends frames of a live run and leaves gaps for missed ones', () => {
    const run = new Run();
    tell(run, { ...kHello, frames: null, live: true });
    tell(run, { type: 'trajectory', first_frame: 0 }, [
      ['pose', 7, pose(0)],
      ['stamp', 1, Uint32Array.of(0)],
    ]);
    tell(run, { type: 'frame', frame: 0, stamp_ns: '5000000000' }, [['pose', 7, pose(0)]]);
    tell(run, { type: 'frame', frame: 2, stamp_ns: '5200000000', series: { fusion: 3 } }, [['pose', 7, pose(2)]]);
    expect(run.frames).toBe(3);
    expect(run.trajectory.poses.row(1)[0]).toBeNaN();
    tell(run, { type: 'trajectory', first_frame: 1 }, [['pose', 7, pose(1)]]);
    expect(run.trajectory.poses.row(1)[0]).toBe(1);
    expect(run.trajectory.poses.row(2)[0]).toBe(2);
    expect(run.series.of('ms')[0].values.row(2)[0]).toBe(3);
    expect(run.series.of('ms')[0].values.row(1)[0]).toBeNaN();
  });

  it('counts how often known poses are replaced', () => {
    const run = new Run();
    tell(run, { ...kHello, live: true, frames: null });
    tell(run, { type: 'trajectory', first_frame: 0 }, [['pose', 7, new Float32Array([...pose(0), ...pose(1)])]]);
    const { edition } = run.trajectory;
    tell(run, { type: 'trajectory', first_frame: 2 }, [['pose', 7, pose(2)]]);
    expect(run.trajectory.edition).toBe(edition);
    tell(run, { type: 'trajectory', first_frame: 0 }, [['pose', 7, pose(3)]]);
    expect(run.trajectory.edition).toBe(edition + 1);
  });

  it('detects the end of a live run', () => {
    const run = new Run();
    tell(run, { ...kHello, live: true, frames: 100 });
    tell(run, { type: 'frame', frame: 0 }, [['pose', 7, pose(0)]]);
    tell(run, { type: 'state', playing: true });
    expect(run.live).toBe(true);
    expect(run.frames).toBe(1);
    tell(run, { type: 'state', playing: true, files: ['static_map.ply'] });
    expect(run.live).toBe(false);
    expect(run.frames).toBe(1);
  });

  it('splits series into columns and grows', () => {
    const run = new Run();
    tell(run, kHello);
    const values = Float32Array.from({ length: 2000 }, (_, i) => (i % 2 === 0 ? i / 2 : -i));
    tell(run, { type: 'series', first_frame: 0, names: ['fusion', 'objects'], units: ['ms', 'count'] }, [['values', 2, values]]);
    expect(run.series.frames).toBe(1000);
    expect(run.series.of('ms')[0].values.row(999)[0]).toBe(999);
    expect(run.series.of('count')[0].values.row(999)[0]).toBe(-1999);
  });

  it('resets with a new hello and reports whether the run is the same', () => {
    const run = new Run();
    const again: boolean[] = [];
    run.on('hello', (event) => again.push(event.again));
    tell(run, kHello);
    tell(run, { type: 'frame', frame: 1 }, [['pose', 7, pose(1)]]);
    tell(run, kHello);
    expect(run.frame).toBeNull();
    expect(run.trajectory.frames).toBe(0);
    tell(run, { ...kHello, run: 'b' });
    expect(again).toEqual([false, true, false]);
  });
});

describe('Tracks', () => {
  const rows = (): Run => {
    const run = new Run();
    tell(run, kHello);
    tell(run, { type: 'tracks', ids: [7, 9], classes: [1, 0] }, [
      ['track', 1, Uint32Array.of(0, 1, 0)],
      ['frame', 1, Uint32Array.of(0, 0, 2)],
      ['center', 3, Float32Array.of(0, 0, 0, 5, 5, 5, 2, 0, 0)],
    ]);
    return run;
  };

  it('combine the initial tracks with frames in any order', () => {
    const run = rows();
    const object = { id: 7, class: 'agv', center: [1, 0, 0], seen: true };
    tell(run, { type: 'frame', frame: 1, objects: [object] });
    tell(run, { type: 'frame', frame: 1, objects: [{ ...object, center: [1.5, 0, 0] }] });
    const track = [...run.tracks.all].find(({ id }) => id === 7) as Track;
    expect(track.class).toBe('agv');
    expect(track.frames).toEqual([0, 1, 2]);
    expect(track.centers).toEqual([0, 0, 0, 1.5, 0, 0, 2, 0, 0]);
  });

  it('omit frames without observation', () => {
    const run = rows();
    tell(run, { type: 'frame', frame: 1, objects: [{ id: 7, class: 'agv', center: [1, 0, 0], seen: false }] });
    expect([...run.tracks.all][0].frames).toEqual([0, 2]);
  });

  it('have fading trails with gaps up to the shown frame', () => {
    const track = { id: 1, class: 'person', frames: [0, 90, 91, 95, 99], centers: [] };
    const seen: [number, number, number][] = [];
    forEachTrailSegment(track, 95, 100, (from, to, age) => seen.push([from / 3, to / 3, age]));
    expect(seen).toEqual([
      [2, 3, 0],
      [1, 2, 0.04],
    ]);
  });
});

describe('Place', () => {
  const lostAt = (state: object, hello: object = kHello): Command[] => {
    const run = new Run();
    const sent: Command[] = [];
    new Place(run, (command) => sent.push(command));
    tell(run, hello);
    tell(run, { type: 'state', playing: true, speed: 1, frame: 0 });
    tell(run, { type: 'frame', frame: 2 }, [['pose', 7, pose(0)]]);
    tell(run, { type: 'state', frame: 2, speed: 1, ...state });
    expect(sent).toEqual([]);
    tell(run, hello);
    return sent;
  };

  it('resumes at the former frame and speed', () => {
    expect(lostAt({ playing: true })).toEqual([{ type: 'seek', frame: 2 }]);
    expect(lostAt({ playing: true, speed: 4 })).toEqual([{ type: 'speed', value: 4 }, { type: 'seek', frame: 2 }]);
  });

  it('stays paused', () => {
    expect(lostAt({ playing: false })).toEqual([{ type: 'pause' }, { type: 'seek', frame: 2 }]);
  });

  it('shows the newest or the paused frame of a live run', () => {
    const live = { ...kHello, frames: null, live: true };
    expect(lostAt({ playing: true }, live)).toEqual([]);
    expect(lostAt({ playing: false }, live)).toEqual([{ type: 'pause' }, { type: 'seek', frame: 2 }]);
  });

  it('starts another run at its first frame', () => {
    const run = new Run();
    const sent: Command[] = [];
    new Place(run, (command) => sent.push(command));
    tell(run, kHello);
    tell(run, { type: 'frame', frame: 2 }, [['pose', 7, pose(0)]]);
    tell(run, { ...kHello, run: 'b' });
    expect(sent).toEqual([]);
  });
});

describe('Settings', () => {
  const storage = (text: string | null) => {
    const kept = { text };
    return { kept, getItem: () => kept.text, setItem: (_: string, value: string) => void (kept.text = value) };
  };

  it('keeps the choice of the user', () => {
    const one = storage(null);
    const settings = new Settings(one);
    expect(settings.shows('map')).toBe(true);
    expect(settings.shows('ceiling')).toBe(false);
    settings.toggle('map');
    settings.camera = 'top';
    const next = new Settings(one);
    expect(next.shows('map')).toBe(false);
    expect(next.camera).toBe('top');
  });

  it.each(['nonsense', '{"hidden": 3, "camera": "side"}', 'null'])('use defaults when %s was stored', (text) => {
    const settings = new Settings(storage(text));
    expect(settings.shows('map')).toBe(true);
    expect(settings.camera).toBe('follow');
  });

  it('work without storage', () => {
    const settings = new Settings(null);
    settings.toggle('grid');
    expect(settings.shows('grid')).toBe(false);
  });
});

describe('throttled', () => {
  it('runs once per period, and once more at the end', () => {
    vi.useFakeTimers();
    let runs = 0;
    const run = throttled(1000, () => ++runs);
    for (let i = 0; i < 50; ++i) {
      run();
      vi.advanceTimersByTime(66);
    }
    expect(runs).toBe(4);
    vi.advanceTimersByTime(2000);
    expect(runs).toBe(5);
    vi.useRealTimers();
  });
});
