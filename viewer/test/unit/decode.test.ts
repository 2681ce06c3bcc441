import { describe, expect, it } from 'vitest';
import { decodeMessage, unit } from '../../src/protocol/decode';
import type { FrameMessage, Hello, MapMessage, SeriesMessage } from '../../src/protocol/messages';
import { message } from './message';

const kPose = Float32Array.of(1, 2, 3, 0, 0, 0, 1);

describe('decodeMessage', () => {
  it('reads a hello', () => {
    const hello = decodeMessage(
      message({
        type: 'hello',
        protocol: 1,
        name: 'loop',
        live: true,
        image: { width: 640, height: 480, fx: 600, fy: 601, cx: 320, cy: 240 },
        frames: null,
        has_truth: true,
        classes: ['person', 'agv'],
        up: [0, -1, 0],
        files: ['static_map.ply'],
      }),
    ) as Hello;
    expect(hello).toMatchObject({ name: 'loop', live: true, frames: null, hasTruth: true, files: ['static_map.ply'] });
    expect(hello.image?.fy).toBe(601);
  });

  it('accepts a hello without image and keeps the reason', () => {
    const header = { type: 'hello', protocol: 1, image: null, has_pictures: false, pictures_note: 'The recording is gone' };
    const hello = decodeMessage(message(header)) as Hello;
    expect(hello.image).toBeNull();
    expect(hello.picturesNote).toBe('The recording is gone');
    expect(hello.up).toEqual([0, -1, 0]);
  });

  it('rejects another protocol version', () => {
    expect(() => decodeMessage(message({ type: 'hello', protocol: 2 }))).toThrow('version 2');
  });

  it('reads a complete frame', () => {
    const frame = decodeMessage(
      message(
        {
          type: 'frame',
          frame: 7,
          stamp_ns: '1234567890123456789',
          status: 'tracking',
          series: { fusion: 8.5, drift_cm: null },
          objects: [
            { id: 3, class: 'person', center: [1, 2, 3], q: [0, 0, 0, 1], size: [0.5, 0.5, 1.7], velocity: [1, 0, 0], moving: true, seen: false },
          ],
        },
        [
          ['pose', 7, kPose],
          ['points', 3, Float32Array.of(1, 2, 3, 4, 5, 6)],
          ['colors', 3, Uint8Array.of(1, 2, 3, 4, 5, 6)],
          ['dynamic', 1, Uint8Array.of(0, 1)],
          ['image', 1, Uint8Array.of(0xff, 0xd8)],
        ],
      ),
    ) as FrameMessage;
    expect(frame.stampNs).toBe(1234567890123456789n);
    expect(frame.pose).toEqual(kPose);
    expect(frame.scan?.dynamic).toEqual(Uint8Array.of(0, 1));
    expect(frame.image).toEqual(Uint8Array.of(0xff, 0xd8));
    expect(frame.mask).toBeNull();
    expect(frame.objects[0]).toMatchObject({ id: 3, class: 'person', moving: true, seen: false, size: [0.5, 0.5, 1.7] });
  });

  it('reads a frame with only its number', () => {
    const frame = decodeMessage(message({ type: 'frame', frame: 0 })) as FrameMessage;
    expect(frame).toMatchObject({ pose: null, truth: null, scan: null, image: null, mask: null, objects: [], stampNs: null });
  });

  it('ignores a pose without seven numbers', () => {
    const frame = decodeMessage(message({ type: 'frame', frame: 0 }, [['pose', 3, Float32Array.of(1, 2, 3)]]));
    expect((frame as FrameMessage).pose).toBeNull();
  });

  it('reads loops', () => {
    const loops = decodeMessage(
      message({ type: 'loops', outcomes: ['accepted', 'few inliers'] }, [
        ['frames', 2, Uint32Array.of(0, 9, 1, 8)],
        ['accepted', 1, Uint8Array.of(1, 0)],
      ]),
    );
    expect(loops).toEqual({ type: 'loops', frames: Uint32Array.of(0, 9, 1, 8), accepted: Uint8Array.of(1, 0) });
    expect(decodeMessage(message({ type: 'loops' }))).toEqual({ type: 'loops', frames: new Uint32Array(), accepted: new Uint8Array() });
  });

  it('reads map chunks and their removal', () => {
    const points = Float32Array.of(1, 2, 3);
    const header = { type: 'map', chunk: '0,1,-2', level: 2, voxel: 0.1, remove: false };
    expect(decodeMessage(message(header, [['points', 3, points]]))).toMatchObject({ chunk: '0,1,-2', points, voxel: 0.1 });
    const removal = decodeMessage(message({ type: 'map', chunk: '0,1,-2', remove: true })) as MapMessage;
    expect(removal.remove).toBe(true);
    expect(removal.points.length).toBe(0);
  });

  it('adds missing units of series', () => {
    const names = ['fusion', 'dynamic_share', 'objects', 'drift_cm'];
    const series = decodeMessage(message({ type: 'series', names }, [['values', 4, Float32Array.of(1, 2, 3, 4)]]));
    expect((series as SeriesMessage).units).toEqual(['ms', 'ratio', 'count', 'cm']);
    expect(unit('', 'dynamic_share')).toBe('ratio');
    expect(unit('cm', 'anything')).toBe('cm');
  });

  it('ignores unknown messages', () => {
    expect(decodeMessage(message({ type: 'weather' }))).toBeNull();
  });
});
