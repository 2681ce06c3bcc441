import { Box3, Color, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { CameraRig } from '../../src/scene/camera_rig';
import { floorHeight, heightRange } from '../../src/scene/floor';
import { drawnCounts } from '../../src/scene/level_of_detail';
import { ColoredSegments } from '../../src/scene/line_segments';
import { shuffled } from '../../src/scene/point_buffers';
import { PointBudget } from '../../src/scene/point_budget';
import { upright } from '../../src/scene/upright';

describe('drawnCounts', () => {
  const chunk = (distance: number, count = 10_000) => ({ count, voxel: 0.02, distance });
  const sum = (counts: number[]): number => counts.reduce((total, count) => total + count, 0);

  it('draws near chunks completely and distant ones sparsely', () => {
    const [near, far] = drawnCounts([chunk(2), chunk(100)], 800, 1e6);
    expect(near).toBe(10_000);
    expect(far).toBeLessThan(1000);
  });

  it('spends the budget on near chunks first', () => {
    const chunks = Array.from({ length: 50 }, (_, i) => chunk(1 + i));
    const counts = drawnCounts(chunks, 800, 60_000);
    expect(sum(counts)).toBeLessThanOrEqual(60_000);
    expect(sum(counts)).toBeGreaterThan(50_000);
    for (let i = 1; i < counts.length; ++i) expect(counts[i]).toBeLessThanOrEqual(counts[i - 1]);
    expect(counts[0]).toBe(10_000);
  });

  it('draws some points of every chunk, never more than it has', () => {
    const counts = drawnCounts([chunk(1e4), chunk(1e4, 10), chunk(0.5)], 800, 10);
    expect(counts[0]).toBe(64);
    expect(counts[1]).toBe(10);
  });
});

describe('shuffled', () => {
  it('keeps points with their colors in random order', () => {
    const count = 1000;
    const points = Float32Array.from({ length: 3 * count }, (_, i) => Math.floor(i / 3));
    const colors = Uint8Array.from({ length: 3 * count }, (_, i) => Math.floor(i / 3) % 251);
    const mixed = shuffled(points, colors);
    const xs = Array.from({ length: count }, (_, i) => mixed.points[3 * i]);
    expect([...xs].sort((a, b) => a - b)).toEqual(Array.from({ length: count }, (_, i) => i));
    xs.forEach((x, i) => expect(mixed.colors[4 * i]).toBe(x % 251));
    const early = xs.slice(0, 100).reduce((total, x) => total + x, 0) / 100;
    expect(Math.abs(early - 500)).toBeLessThan(120);
  });
});

describe('PointBudget', () => {
  it('shrinks immediately and grows step by step', () => {
    const budget = new PointBudget(40, 60_000, 1_000_000, 800_000);
    budget.learn(800_000, 400);
    expect(budget.points).toBe(80_000);
    budget.learn(80_000, 4);
    expect(budget.points).toBe(160_000);
    budget.learn(160_000, 100_000);
    expect(budget.points).toBe(60_000);
    for (let i = 0; i < 10; ++i) budget.learn(budget.points, 4);
    expect(budget.points).toBe(1_000_000);
  });
});

describe('heightRange', () => {
  it('leaves out the highest points and never has less than 2 m', () => {
    const heights = Array.from({ length: 1000 }, (_, i) => (i < 990 ? -1 + i / 100 : 50));
    expect(heightRange(heights, -1)).toEqual([-1, -1 + 9.8]);
    expect(heightRange([-1, 0, 0.2], -1)).toEqual([-1, 1]);
    expect(heightRange([], -1)).toEqual([-1, 1]);
  });
});

describe('floorHeight', () => {
  it('is the level of most points below the sensor', () => {
    const heights = [...Array(500).fill(-0.97), ...Array(900).fill(0.5), ...Array(100).fill(-0.4)] as number[];
    expect(floorHeight(heights)).toBeCloseTo(-0.95, 5);
  });

  it('is unknown with too few points', () => {
    expect(floorHeight([0.1, 0.2, -0.9])).toBeNull();
  });
});

describe('upright', () => {
  it.each([
    [[0, -1, 0]],
    [[0.1, -0.9, 0.3]],
    [[0, 0, 1]],
    [[0, 0, -1]],
  ] as [[number, number, number]][])('rotates %s upward and keeps the handedness', (up) => {
    const turn = upright(new Vector3(...up));
    const y = new Vector3(...up).normalize().applyQuaternion(turn);
    expect(y.distanceTo(new Vector3(0, 1, 0))).toBeLessThan(1e-6);
    expect(turn.length()).toBeCloseTo(1, 6);
  });

  it('points a level camera away from the viewer', () => {
    const ahead = new Vector3(0, 0, 1).applyQuaternion(upright(new Vector3(0, -1, 0)));
    expect(ahead.distanceTo(new Vector3(0, 0, -1))).toBeLessThan(1e-6);
  });

  it('points a level LiDAR away from the viewer', () => {
    const ahead = new Vector3(1, 0, 0).applyQuaternion(upright(new Vector3(0, 0, 1)));
    expect(ahead.distanceTo(new Vector3(0, 0, -1))).toBeLessThan(1e-6);
  });
});

describe('ColoredSegments', () => {
  it('keeps what was not drawn yet for the next upload', () => {
    const lines = new ColoredSegments({ width: 1 });
    for (let i = 0; i < 3; ++i) {
      lines.add([0, 0, 0], 0, [1, 1, 1], 0, new Color());
      lines.commit();
    }
    const { positions } = lines as unknown as { positions: { updateRanges: unknown } };
    expect(positions.updateRanges).toEqual([{ start: 0, count: 18 }]);
  });
});

describe('CameraRig', () => {
  it('shows a large scene as a whole', () => {
    const rig = new CameraRig(null as never, () => {});
    rig.resize(1440, 900);
    rig.setMode('orbit');
    rig.setBounds(new Box3(new Vector3(-600, -2, -600), new Vector3(600, 8, 600)));
    rig.update(1);
    rig.camera.updateMatrixWorld();
    for (const at of [new Vector3(-600, 0, 0), new Vector3(600, 0, 0), new Vector3(0, 0, -600), new Vector3(0, 0, 600)]) {
      const seen = at.project(rig.camera);
      expect(Math.max(Math.abs(seen.x), Math.abs(seen.y), Math.abs(seen.z))).toBeLessThan(1);
    }
  });
});
