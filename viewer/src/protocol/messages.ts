/** The messages of docs/viewer_protocol.md as used in the page. Poses are T_world_camera, lengths in meters. */

export type Vector3 = [number, number, number];
/** x, y, z, w. */
export type Quaternion = [number, number, number, number];

export interface Intrinsics {
  width: number;
  height: number;
  fx: number;
  fy: number;
  cx: number;
  cy: number;
}

export interface Hello {
  type: 'hello';
  protocol: number;
  version: string;
  name: string;
  /** Input of the run: a folder, a recording, a simulated scene. */
  data: string;
  /** Unique id of the run, to detect it after a reconnect; empty if unknown. */
  run: string;
  live: boolean;
  image: Intrinsics | null;
  /** Number of frames of the run, of a live one the expected number; null if unknown. */
  frames: number | null;
  hasTruth: boolean;
  classes: string[];
  /** Reason if there are no images, masks and scans; else empty. */
  picturesNote: string;
  /** Up direction in the map frame. */
  up: Vector3;
  files: string[];
}

/** Rows from `firstFrame` on: tx ty tz qx qy qz qw. */
export interface TrajectoryMessage {
  type: 'trajectory';
  firstFrame: number;
  poses: Float32Array;
  /** Milliseconds since the first frame. */
  stamps: Uint32Array | null;
  /** Positions aligned to the estimate, NaN if unknown. */
  truth: Float32Array | null;
}

export type Unit = 'ms' | 'ratio' | 'count' | 'cm';

export interface SeriesMessage {
  type: 'series';
  firstFrame: number;
  names: string[];
  units: Unit[];
  /** One row per frame, one column per name. */
  values: Float32Array;
}

/** All known object positions: one row per object and frame, sorted by frame. */
export interface TracksMessage {
  type: 'tracks';
  ids: number[];
  /** Index into Hello.classes per id. */
  classes: number[];
  track: Uint32Array;
  frame: Uint32Array;
  centers: Float32Array;
}

/** Loops between two frames each that were checked. */
export interface LoopsMessage {
  type: 'loops';
  /** Earlier and later frame by loop. */
  frames: Uint32Array;
  /** 1 if accepted. */
  accepted: Uint8Array;
}

export interface SceneObject {
  id: number;
  class: string;
  center: Vector3;
  orientation: Quaternion;
  size: Vector3;
  velocity: Vector3;
  moving: boolean;
  seen: boolean;
}

export interface Scan {
  /** In the camera frame. */
  points: Float32Array;
  colors: Uint8Array | null;
  /** 1 for dynamic points. */
  dynamic: Uint8Array | null;
}

export interface FrameMessage {
  type: 'frame';
  frame: number;
  /** Nanoseconds; null if the server sends none. */
  stampNs: bigint | null;
  status: string;
  lost: boolean;
  /** Null where unknown. */
  series: Record<string, number | null>;
  objects: SceneObject[];
  pose: Float32Array | null;
  truth: Float32Array | null;
  scan: Scan | null;
  /** Scan, image and mask of this frame follow in another message. */
  picturesPending: boolean;
  /** A JPEG. */
  image: Uint8Array | null;
  /** A PNG, one byte per pixel: 0 static, 1 + class index. */
  mask: Uint8Array | null;
}

/** Replaces the points of a cube of space. */
export interface MapMessage {
  type: 'map';
  chunk: string;
  /** Distance between adjacent points [m]. */
  voxel: number;
  remove: boolean;
  points: Float32Array;
  colors: Uint8Array | null;
}

export interface StateMessage {
  type: 'state';
  playing: boolean;
  frame: number;
  speed: number;
  ended: boolean;
  /** Frames that this client missed because it was too slow. */
  dropped: number;
  /** The run's files, if they changed. */
  files: string[] | null;
}

export interface ErrorMessage {
  type: 'error';
  message: string;
}

export type Message =
  | Hello
  | TrajectoryMessage
  | SeriesMessage
  | TracksMessage
  | LoopsMessage
  | FrameMessage
  | MapMessage
  | StateMessage
  | ErrorMessage;

export type Command =
  | { type: 'play' | 'pause' }
  | { type: 'step'; by: number }
  | { type: 'seek'; frame: number }
  | { type: 'speed'; value: number }
  /** `budget`: number of map points that this page can draw. */
  | { type: 'want'; points: boolean; image: boolean; map: boolean; budget: number }
  /** The user's focus in the map frame: the map is refined there first. */
  | { type: 'focus'; point: Vector3 };
