/** The messages of docs/viewer_protocol.md as the page uses them. Poses are T_world_camera, lengths metres. */

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
  /** What was run: a folder, a recording, a simulated scene. */
  data: string;
  /** Says whether a reconnect found the same run again; empty where the server does not tell. */
  run: string;
  live: boolean;
  image: Intrinsics | null;
  /** How many frames the run has; null while it goes on. */
  frames: number | null;
  hasTruth: boolean;
  classes: string[];
  /** Why there are no images, masks and scans; empty where there are. */
  picturesNote: string;
  /** Up in the map's frame. */
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
  /** Positions aligned to the estimate, NaN where there is none. */
  truth: Float32Array | null;
}

export type Unit = 'ms' | 'ratio' | 'count' | 'cm';

export interface SeriesMessage {
  type: 'series';
  firstFrame: number;
  names: string[];
  units: Unit[];
  /** A row a frame, a column a name. */
  values: Float32Array;
}

/** Everything known of where the objects were: a row an object and frame, sorted by frame. */
export interface TracksMessage {
  type: 'tracks';
  ids: number[];
  /** Index into Hello.classes, for every id. */
  classes: number[];
  track: Uint32Array;
  frame: Uint32Array;
  centers: Float32Array;
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
  /** In the camera's frame. */
  points: Float32Array;
  colors: Uint8Array | null;
  /** 1 where the point belongs to something dynamic. */
  dynamic: Uint8Array | null;
}

export interface FrameMessage {
  type: 'frame';
  frame: number;
  /** Nanoseconds; null where the server sends none. */
  stampNs: bigint | null;
  status: string;
  lost: boolean;
  /** Null where unknown. */
  series: Record<string, number | null>;
  objects: SceneObject[];
  pose: Float32Array | null;
  truth: Float32Array | null;
  scan: Scan | null;
  /** Scan, image and mask of this frame come in another message. */
  picturesPending: boolean;
  /** A JPEG. */
  image: Uint8Array | null;
  /** A PNG, one byte a pixel: 0 static, 1 + class index. */
  mask: Uint8Array | null;
}

/** Replaces the points of a cube of space. */
export interface MapMessage {
  type: 'map';
  chunk: string;
  /** Distance between neighbouring points [m]. */
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
  /** Frames this client was too slow for. */
  dropped: number;
  /** The run's files, where there are others than before. */
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
  | FrameMessage
  | MapMessage
  | StateMessage
  | ErrorMessage;

export type Command =
  | { type: 'play' | 'pause' }
  | { type: 'step'; by: number }
  | { type: 'seek'; frame: number }
  | { type: 'speed'; value: number }
  /** `budget`: points of the map that this page can draw. */
  | { type: 'want'; points: boolean; image: boolean; map: boolean; budget: number }
  /** Where the user looks, in the map's frame: the map is refined there first. */
  | { type: 'focus'; point: Vector3 };
