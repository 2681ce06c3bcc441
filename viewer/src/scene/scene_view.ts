import { Box3, Group, type Object3D, Quaternion, Vector3 } from 'three';
import type { FrameMessage, Hello, MapMessage, SceneObject, Vector3 as Triple } from '../protocol/messages';
import { className } from '../state/class_words';
import type { Run } from '../state/run';
import type { Layer, Settings } from '../state/settings';
import { throttled } from '../state/throttled';
import { floorGrid, floorHeight, heightRange } from './floor';
import type { Label } from './label_overlay';
import { LoopLayer } from './loop_layer';
import { MapLayer } from './map_layer';
import { ObjectLayer } from './object_layer';
import { classColor } from './palette';
import { kHigh, pointUniforms } from './point_material';
import { SensorLayer } from './sensor_layer';
import { Stage } from './stage';
import { TrailLayer } from './trail_layer';
import { TrajectoryLayer } from './trajectory_layer';
import { aheadOf, upright } from './upright';

/** Points higher above the sensor are hidden, to show the inside of rooms [m]. */
const kCeiling = 1;
/** Shortest time between two measurements of a growing scene [ms]. */
const kMeasureEvery = 1000;

/** The 3D panel: the layers of the scene, updated from the run and the settings. */
export class SceneView {
  private readonly stage: Stage;
  /** The map frame, rotated so that its up direction is the scene's y. */
  private readonly world = new Group();
  private readonly map = new MapLayer();
  private readonly sensor = new SensorLayer();
  private readonly objects = new ObjectLayer();
  private readonly trails = new TrailLayer();
  private readonly trajectory = new TrajectoryLayer();
  private readonly loops = new LoopLayer();
  private readonly grid = floorGrid();
  private readonly up = new Vector3(0, -1, 0);
  private readonly layers: Partial<Record<Layer, Object3D>>;
  private pending = false;
  private measured = false;
  private readonly remeasure = throttled(kMeasureEvery, () => {
    this.measured = false;
    this.stage.invalidate();
  });
  private lastFrame = -1;
  /** Of the trajectory's poses. */
  private drawnEdition = 0;
  /** In the scene frame. */
  private ceiling = kHigh;
  /** Of the floor and of the highest points, in the scene frame. */
  private heights: [number, number] = [-1, 1];

  constructor(
    container: HTMLElement,
    private readonly run: Run,
    private readonly settings: Settings,
  ) {
    this.stage = new Stage(container, {
      draw: (budget) => this.prepare(budget),
      drawn: () => this.drawLabels(),
    });
    this.world.add(this.map.group, this.sensor.group, this.objects.group, this.trails.object);
    this.world.add(this.trajectory.estimate, this.trajectory.truth, this.loops.accepted, this.loops.rejected);
    this.stage.scene.add(this.world, this.grid);
    this.layers = {
      map: this.map.group,
      scan: this.sensor.scan,
      boxes: this.objects.group,
      trails: this.trails.object,
      trajectory: this.trajectory.estimate,
      loops: this.loops.accepted,
      rejected: this.loops.rejected,
      truth: this.trajectory.truth,
      camera: this.sensor.camera,
      grid: this.grid,
    };
    this.stage.rig.setMode(settings.camera);
    this.listen();
  }

  /** Resets to the initial view of the camera mode. */
  resetView(): void {
    this.stage.rig.reset();
    this.stage.invalidate();
  }

  picture(): Promise<Blob | null> {
    return this.stage.picture();
  }

  /** The camera's target in the map frame. */
  get focus(): Triple {
    return this.world.worldToLocal(this.stage.rig.target.clone()).toArray();
  }

  private listen(): void {
    this.run.on('hello', ({ hello, again }) => this.begin(hello, again));
    this.run.on('map', (message) => this.addMap(message));
    this.run.on('frame', () => this.refresh());
    this.run.on('history', () => {
      if (this.drawnEdition !== this.run.trajectory.edition) this.trajectory.clear();
      this.drawnEdition = this.run.trajectory.edition;
      this.loops.update(this.run.loops, this.run.trajectory);
      this.remeasure();
      this.refresh();
    });
    this.settings.on('layer', () => this.refresh());
    this.settings.on('camera', (mode) => {
      this.stage.rig.setMode(mode);
      this.stage.invalidate();
    });
  }

  private begin(hello: Hello, again: boolean): void {
    this.map.clear();
    this.trajectory.clear();
    this.loops.update(null, this.run.trajectory);
    this.objects.setUp(this.up.fromArray(hello.up).normalize());
    this.world.quaternion.copy(upright(this.up));
    this.world.updateMatrixWorld(true);
    this.sensor.setIntrinsics(hello.image);
    this.sensor.setScan(null);
    this.measured = false;
    this.lastFrame = -1;
    this.drawnEdition = 0;
    if (!again) this.stage.rig.setMode(this.settings.camera);
    this.refresh();
  }

  private addMap(message: MapMessage): void {
    this.map.set(message);
    this.remeasure();
    this.stage.invalidate();
  }

  /** Changes of several messages are applied just before the next image is drawn. */
  private refresh(): void {
    this.pending = true;
    this.stage.invalidate();
  }

  private prepare(budget: number): number {
    if (this.pending) this.update();
    if (!this.measured) this.measure();
    return this.map.choose(this.stage.rig.camera, budget);
  }

  private update(): void {
    this.pending = false;
    const { frame, trajectory, tracks, playback } = this.run;
    const at = frame?.frame ?? playback.frame;
    if (frame) this.showFrame(frame);
    this.objects.update(frame?.objects ?? []);
    this.trails.update(tracks, at);
    this.trajectory.update(trajectory, at);
    this.applyLayers();
  }

  private showFrame(frame: FrameMessage): void {
    const jump = Math.abs(frame.frame - this.lastFrame) > 5;
    this.lastFrame = frame.frame;
    this.sensor.setScan(frame.scan);
    if (!frame.pose) return;
    this.sensor.setPose(frame.pose);
    const at = new Vector3().fromArray(frame.pose);
    const forward = aheadOf(this.up).applyQuaternion(this.sensor.group.quaternion).applyQuaternion(this.world.quaternion);
    at.applyMatrix4(this.world.matrixWorld);
    this.ceiling = at.y + kCeiling;
    this.stage.rig.setSensor(at, forward, jump);
  }

  private applyLayers(): void {
    for (const [layer, object] of Object.entries(this.layers)) object.visible = this.settings.shows(layer as Layer);
    pointUniforms.ceiling.value = this.settings.shows('ceiling') ? kHigh : this.ceiling;
    this.applyHeights();
  }

  /** The colors are spread over the heights that are drawn. */
  private applyHeights(): void {
    const [low, high] = this.heights;
    this.map.setHeights(this.settings.shows('heights'), low, Math.min(high, pointUniforms.ceiling.value));
  }

  /** Extent of the scene and height of its floor. */
  private measure(): void {
    this.measured = true;
    const bounds = new Box3();
    const { values, length } = this.run.trajectory.poses;
    const point = new Vector3();
    for (let i = 0; i < length; ++i) {
      point.fromArray(values, 7 * i);
      if (Number.isFinite(point.x)) bounds.expandByPoint(point.applyMatrix4(this.world.matrixWorld));
    }
    bounds.expandByScalar(1.5);
    const heights: number[] = [];
    this.map.forEachSample(40, (x, y, z) => {
      point.set(x, y, z);
      heights.push(this.up.dot(point));
      bounds.expandByPoint(point.applyMatrix4(this.world.matrixWorld));
    });
    this.grid.position.y = floorHeight(heights) ?? -1;
    this.heights = heightRange(heights, this.grid.position.y);
    this.applyHeights();
    this.stage.rig.setBounds(bounds);
  }

  private drawLabels(): void {
    const shown = this.settings.shows('labels') ? (this.run.frame?.objects ?? []) : [];
    this.stage.labels.draw(shown.map((object) => this.label(object)), this.stage.rig.camera);
  }

  private label(object: SceneObject): Label {
    const top = new Vector3().fromArray(object.center).addScaledVector(this.up, halfHeight(object, this.up));
    return {
      at: top.applyMatrix4(this.world.matrixWorld),
      text: labelText(object),
      color: classColor(object.class),
      faint: !object.seen,
    };
  }
}

/** Label with id, class and speed. */
export function labelText({ id, class: name, velocity, moving }: SceneObject): string {
  return `${className(name)} ${id} · ${moving ? `${Math.hypot(...velocity).toFixed(1)} m/s` : 'still'}`;
}

/** Half of the box's extent along `up`. */
function halfHeight({ size, orientation }: SceneObject, up: Vector3): number {
  const local = up.clone().applyQuaternion(new Quaternion().fromArray(orientation).invert());
  return 0.5 * (Math.abs(local.x) * size[0] + Math.abs(local.y) * size[1] + Math.abs(local.z) * size[2]);
}
