/** Envelope of a message: u32 length, JSON of that length, then raw buffers aligned to 4 bytes. */

export type Buffer = Float32Array | Uint8Array | Uint32Array;

export interface Envelope {
  header: Record<string, unknown>;
  buffers: Map<string, Buffer>;
}

/** The data are not a message of this protocol. */
export class ProtocolError extends Error {
  override name = 'ProtocolError';
}

const kTypes = {
  f32: Float32Array,
  u8: Uint8Array,
  u32: Uint32Array,
} as const;

const kLittleEndian = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;
const text = new TextDecoder('utf-8', { fatal: true });

/** Buffers are views into `data`, not copies. Throws ProtocolError. */
export function openEnvelope(data: ArrayBuffer): Envelope {
  if (!kLittleEndian) throw new ProtocolError('this page needs a little-endian machine');
  if (data.byteLength < 4) throw new ProtocolError(`a message of ${data.byteLength} bytes, shorter than its length field`);
  const jsonBytes = new DataView(data).getUint32(0, true);
  const end = 4 + jsonBytes;
  if (end > data.byteLength) {
    throw new ProtocolError(`a header of ${jsonBytes} bytes in a message of ${data.byteLength}`);
  }
  const header = parseHeader(new Uint8Array(data, 4, jsonBytes));
  return { header, buffers: sliceBuffers(data, end, header.buffers) };
}

function parseHeader(bytes: Uint8Array): Record<string, unknown> {
  let header: unknown;
  try {
    header = JSON.parse(text.decode(bytes));
  } catch (error) {
    throw new ProtocolError(`a header that is not JSON: ${String(error)}`);
  }
  if (typeof header !== 'object' || header === null || Array.isArray(header)) {
    throw new ProtocolError('a header that is not a JSON object');
  }
  return header as Record<string, unknown>;
}

function sliceBuffers(data: ArrayBuffer, start: number, list: unknown): Map<string, Buffer> {
  const buffers = new Map<string, Buffer>();
  if (list === undefined) return buffers;
  if (!Array.isArray(list)) throw new ProtocolError('"buffers" is not a list');
  let offset = start;
  for (const entry of list as { name?: unknown; dtype?: unknown; components?: unknown; count?: unknown }[]) {
    offset = Math.ceil(offset / 4) * 4;
    const type = kTypes[entry.dtype as keyof typeof kTypes];
    if (!type) throw new ProtocolError(`buffer "${String(entry.name)}" of unknown type "${String(entry.dtype)}"`);
    const length = size(entry.components ?? 1) * size(entry.count);
    const bytes = length * type.BYTES_PER_ELEMENT;
    if (offset + bytes > data.byteLength) {
      throw new ProtocolError(
        `buffer "${String(entry.name)}" ends at byte ${offset + bytes} of a message of ${data.byteLength}`,
      );
    }
    buffers.set(String(entry.name), new type(data, offset, length));
    offset += bytes;
  }
  return buffers;
}

function size(value: unknown): number {
  if (typeof value !== 'number' || !Number.isInteger(value) || value < 0) {
    throw new ProtocolError(`a buffer's size is ${String(value)}, not an integer`);
  }
  return value;
}
