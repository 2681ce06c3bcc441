import { type Buffer, type Envelope, openEnvelope, ProtocolError } from './envelope';
import type {
  FrameMessage,
  Hello,
  Intrinsics,
  LoopsMessage,
  MapMessage,
  Message,
  Quaternion,
  Scan,
  SceneObject,
  SeriesMessage,
  StateMessage,
  TracksMessage,
  TrajectoryMessage,
  Unit,
  Vector3,
} from './messages';

export const kProtocolVersion = 1;

/** Decodes one message from the server; null for an unknown type. Throws ProtocolError. */
export function decodeMessage(data: ArrayBuffer): Message | null {
  const envelope = openEnvelope(data);
  const decode = kDecoders[String(envelope.header.type)];
  return decode ? decode(envelope) : null;
}

const kDecoders: Record<string, (envelope: Envelope) => Message> = {
  hello: decodeHello,
  trajectory: decodeTrajectory,
  series: decodeSeries,
  tracks: decodeTracks,
  loops: decodeLoops,
  frame: decodeFrame,
  map: decodeMap,
  state: decodeState,
  error: ({ header }) => ({ type: 'error', message: string(header.message, 'unknown error') }),
};

function decodeHello({ header }: Envelope): Hello {
  const protocol = number(header.protocol, 0);
  if (protocol !== kProtocolVersion) {
    throw new ProtocolError(`the server speaks version ${protocol} of the protocol, this page ${kProtocolVersion}; reload it`);
  }
  return {
    type: 'hello',
    protocol,
    version: string(header.version, ''),
    name: string(header.name, 'run'),
    data: string(header.data, ''),
    run: string(header.run, ''),
    live: header.live === true,
    image: intrinsics(header.image),
    frames: typeof header.frames === 'number' ? header.frames : null,
    hasTruth: header.has_truth === true,
    classes: strings(header.classes),
    picturesNote: header.has_pictures === false ? string(header.pictures_note, 'This run has no pictures') : '',
    up: numbers<Vector3>(header.up, [0, -1, 0]),
    files: strings(header.files),
  };
}

function decodeTrajectory({ header, buffers }: Envelope): TrajectoryMessage {
  return {
    type: 'trajectory',
    firstFrame: number(header.first_frame, 0),
    poses: floats(buffers, 'pose') ?? new Float32Array(),
    stamps: array(buffers, 'stamp', Uint32Array),
    truth: floats(buffers, 'truth'),
  };
}

function decodeSeries({ header, buffers }: Envelope): SeriesMessage {
  const names = strings(header.names);
  const units = strings(header.units);
  return {
    type: 'series',
    firstFrame: number(header.first_frame, 0),
    names,
    units: names.map((name, i) => unit(units[i], name)),
    values: floats(buffers, 'values') ?? new Float32Array(),
  };
}

const kUnits: Unit[] = ['ms', 'ratio', 'count', 'cm'];

/** The unit that was sent, or the default one of that name. */
export function unit(sent: string | undefined, name: string): Unit {
  if (kUnits.includes(sent as Unit)) return sent as Unit;
  if (name.endsWith('_share')) return 'ratio';
  if (name === 'objects') return 'count';
  return name.endsWith('_cm') ? 'cm' : 'ms';
}

function decodeTracks({ header, buffers }: Envelope): TracksMessage {
  return {
    type: 'tracks',
    ids: numbers<number[]>(header.ids, []),
    classes: numbers<number[]>(header.classes, []),
    track: array(buffers, 'track', Uint32Array) ?? new Uint32Array(),
    frame: array(buffers, 'frame', Uint32Array) ?? new Uint32Array(),
    centers: floats(buffers, 'center') ?? new Float32Array(),
  };
}

function decodeLoops({ buffers }: Envelope): LoopsMessage {
  return {
    type: 'loops',
    frames: array(buffers, 'frames', Uint32Array) ?? new Uint32Array(),
    accepted: array(buffers, 'accepted', Uint8Array) ?? new Uint8Array(),
  };
}

function decodeFrame({ header, buffers }: Envelope): FrameMessage {
  const pose = floats(buffers, 'pose');
  return {
    type: 'frame',
    frame: number(header.frame, 0),
    stampNs: typeof header.stamp_ns === 'string' && /^-?\d+$/.test(header.stamp_ns) ? BigInt(header.stamp_ns) : null,
    status: string(header.status, ''),
    lost: header.lost === true,
    series: (header.series ?? {}) as Record<string, number | null>,
    objects: Array.isArray(header.objects) ? header.objects.map(sceneObject) : [],
    pose: pose?.length === 7 ? pose : null,
    truth: floats(buffers, 'truth'),
    scan: scan(buffers),
    picturesPending: header.pictures === 'pending',
    image: array(buffers, 'image', Uint8Array),
    mask: array(buffers, 'mask', Uint8Array),
  };
}

function scan(buffers: Map<string, Buffer>): Scan | null {
  const points = floats(buffers, 'points');
  if (!points || points.length === 0) return null;
  return { points, colors: array(buffers, 'colors', Uint8Array), dynamic: array(buffers, 'dynamic', Uint8Array) };
}

function sceneObject(value: Record<string, unknown>): SceneObject {
  return {
    id: number(value.id, 0),
    class: string(value.class, 'object'),
    center: numbers<Vector3>(value.center, [0, 0, 0]),
    orientation: numbers<Quaternion>(value.q, [0, 0, 0, 1]),
    size: numbers<Vector3>(value.size, [0, 0, 0]),
    velocity: numbers<Vector3>(value.velocity, [0, 0, 0]),
    moving: value.moving === true,
    seen: value.seen !== false,
  };
}

function decodeMap({ header, buffers }: Envelope): MapMessage {
  return {
    type: 'map',
    chunk: string(header.chunk, ''),
    voxel: number(header.voxel, 0.05),
    remove: header.remove === true,
    points: floats(buffers, 'points') ?? new Float32Array(),
    colors: array(buffers, 'colors', Uint8Array),
  };
}

function decodeState({ header }: Envelope): StateMessage {
  return {
    type: 'state',
    playing: header.playing === true,
    frame: number(header.frame, 0),
    speed: number(header.speed, 1),
    ended: header.ended === true,
    dropped: number(header.dropped, 0),
    files: Array.isArray(header.files) ? strings(header.files) : null,
  };
}

function intrinsics(value: unknown): Intrinsics | null {
  if (typeof value !== 'object' || value === null) return null;
  const of = value as Record<string, unknown>;
  const { width, height } = { width: number(of.width, 0), height: number(of.height, 0) };
  if (width <= 0 || height <= 0) return null;
  return {
    width,
    height,
    fx: number(of.fx, width),
    fy: number(of.fy, width),
    cx: number(of.cx, width / 2),
    cy: number(of.cy, height / 2),
  };
}

function array<T extends Buffer>(buffers: Map<string, Buffer>, name: string, type: { new (): T }): T | null {
  const buffer = buffers.get(name);
  return buffer instanceof type ? buffer : null;
}

const floats = (buffers: Map<string, Buffer>, name: string) => array(buffers, name, Float32Array);

function number(value: unknown, otherwise: number): number {
  return typeof value === 'number' && Number.isFinite(value) ? value : otherwise;
}

function string(value: unknown, otherwise: string): string {
  return typeof value === 'string' ? value : otherwise;
}

function strings(value: unknown): string[] {
  return Array.isArray(value) ? value.filter((entry): entry is string => typeof entry === 'string') : [];
}

/** `value` if it is a list of numbers as long as `otherwise` (of any length if that is empty). */
function numbers<T extends number[]>(value: unknown, otherwise: T): T {
  if (!Array.isArray(value) || !value.every((entry) => typeof entry === 'number')) return otherwise;
  return otherwise.length === 0 || value.length === otherwise.length ? (value as T) : otherwise;
}
