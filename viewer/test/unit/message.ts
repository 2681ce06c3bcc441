import type { Buffer } from '../../src/protocol/envelope';

const kNames = new Map<unknown, string>([
  [Float32Array, 'f32'],
  [Uint8Array, 'u8'],
  [Uint32Array, 'u32'],
]);

/** A message in the format of docs/viewer_protocol.md, with name, components and values of each buffer. */
export function message(header: object, buffers: [string, number, Buffer][] = []): ArrayBuffer {
  const described = buffers.map(([name, components, values]) => ({
    name,
    dtype: kNames.get(values.constructor),
    components,
    count: values.length / components,
  }));
  let json = new TextEncoder().encode(JSON.stringify({ ...header, buffers: described }));
  const padded = new Uint8Array(Math.ceil(json.length / 4) * 4).fill(32);
  padded.set(json);
  json = padded;
  const parts = [new Uint8Array(Uint32Array.of(json.length).buffer), json];
  for (const [, , values] of buffers) {
    const bytes = new Uint8Array(Math.ceil(values.byteLength / 4) * 4);
    bytes.set(new Uint8Array(values.buffer, values.byteOffset, values.byteLength));
    parts.push(bytes);
  }
  const whole = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole.buffer;
}
