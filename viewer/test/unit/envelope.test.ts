import { describe, expect, it } from 'vitest';
import { openEnvelope, ProtocolError } from '../../src/protocol/envelope';
import { message } from './message';

describe('openEnvelope', () => {
  it('reads buffers with padding', () => {
    const { header, buffers } = openEnvelope(
      message({ type: 'x' }, [
        ['bytes', 1, Uint8Array.of(1, 2, 3)],
        ['floats', 3, Float32Array.of(1.5, -2, 3)],
        ['words', 1, Uint32Array.of(4_000_000_000)],
      ]),
    );
    expect(header.type).toBe('x');
    expect(buffers.get('bytes')).toEqual(Uint8Array.of(1, 2, 3));
    expect(buffers.get('floats')).toEqual(Float32Array.of(1.5, -2, 3));
    expect(buffers.get('words')).toEqual(Uint32Array.of(4_000_000_000));
  });

  it('accepts a message without buffers', () => {
    expect(openEnvelope(message({ type: 'state' })).buffers.size).toBe(0);
  });

  const truncated = message({ type: 'x' }, [['floats', 3, Float32Array.of(1, 2, 3)]]);
  it.each([
    ['nothing', new ArrayBuffer(0), 'a message of 0 bytes'],
    ['a truncated header', Uint32Array.of(100).buffer, 'a header of 100 bytes in a message of 4'],
    ['a header without JSON', new Uint8Array([4, 0, 0, 0, 123, 32, 32, 32]).buffer, 'not JSON'],
    ['a header without an object', new Uint8Array([4, 0, 0, 0, 49, 32, 32, 32]).buffer, 'not a JSON object'],
    ['a truncated buffer', truncated.slice(0, truncated.byteLength - 4), 'buffer "floats" ends at byte'],
    ['an unknown type', encode({ buffers: [{ name: 'a', dtype: 'f64', count: 0 }] }), 'unknown type "f64"'],
    ['a negative size', encode({ buffers: [{ name: 'a', dtype: 'u8', count: -1 }] }), 'size is -1'],
    ['no size', encode({ buffers: [{ name: 'a', dtype: 'u8' }] }), 'size is undefined'],
    ['buffers without a list', encode({ buffers: 3 }), 'not a list'],
  ])('rejects %s', (_, data, words) => {
    expect(() => openEnvelope(data)).toThrow(ProtocolError);
    expect(() => openEnvelope(data)).toThrow(words);
  });
});

function encode(header: object): ArrayBuffer {
  const json = new TextEncoder().encode(JSON.stringify(header));
  const data = new Uint8Array(4 + json.length);
  new DataView(data.buffer).setUint32(0, json.length, true);
  data.set(json, 4);
  return data.buffer;
}
