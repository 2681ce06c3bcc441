import { Box3, MOUSE, OrthographicCamera, PerspectiveCamera, Quaternion, TOUCH, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { CameraMode } from '../state/settings';

const kUp = new Vector3(0, 1, 0);
/** Position and target of the camera in follow mode: meters behind, above and ahead of the sensor. */
const kFollow = { behind: 4.6, above: 3.6, ahead: 2.6, below: 0.4 };
/** For larger distances the camera jumps instead of moving [m]. */
const kJump = 6;
const kGlide = 0.5;
/** Distance to which the camera can move away in every scene [m]. */
const kReach = 300;
const kHair = 0.01;
const kEase = 0.18;

interface View {
  eye: Vector3;
  target: Vector3;
}

/** The scene's camera: orbits a point, follows the sensor, or shows the top view. The scene's y is up. */
export class CameraRig {
  mode: CameraMode = 'orbit';
  private readonly perspective = new PerspectiveCamera(55, 1, 0.05);
  private readonly orthographic = new OrthographicCamera(-1, 1, 1, -1, -200, 400);
  private readonly around: OrbitControls;
  private readonly above: OrbitControls;
  private readonly bounds = new Box3(new Vector3(-3, -1, -6), new Vector3(3, 2, 1));
  private width = 1;
  private height = 1;
  private glide: { from: View; passed: number } | null = null;
  /** The user has moved the camera: it is no longer fitted to the scene automatically. */
  private moved = false;
  /** The top view has x upwards on the screen. */
  private turned = false;
  private readonly sensor = { at: new Vector3(), yaw: 0 };
  private readonly anchor = { at: new Vector3(), yaw: 0 };

  constructor(element: HTMLElement, invalidate: () => void) {
    this.around = new OrbitControls(this.perspective, element);
    this.above = new OrbitControls(this.orthographic, element);
    this.above.enableRotate = false;
    this.above.mouseButtons.LEFT = MOUSE.PAN;
    this.above.touches.ONE = TOUCH.PAN;
    this.above.touches.TWO = TOUCH.DOLLY_PAN;
    this.around.maxPolarAngle = 0.495 * Math.PI;
    this.around.minDistance = 0.5;
    for (const controls of [this.around, this.above]) {
      controls.screenSpacePanning = controls === this.above;
      controls.enableDamping = true;
      controls.dampingFactor = 0.15;
      controls.addEventListener('change', invalidate);
      controls.addEventListener('start', () => this.take());
    }
    this.setMode('orbit');
  }

  get camera(): PerspectiveCamera | OrthographicCamera {
    return this.mode === 'top' ? this.orthographic : this.perspective;
  }

  /** Pixels per meter at a distance of one meter, or anywhere in the top view. */
  get pixelsPerMetre(): number {
    if (this.mode === 'top') return (this.height * this.orthographic.zoom) / (2 * this.orthographic.top);
    return this.height / (2 * Math.tan((this.perspective.fov * Math.PI) / 360));
  }

  /** Target of the camera. */
  get target(): Vector3 {
    return this.mode === 'top' ? this.above.target : this.around.target;
  }

  /** Distance from which points fade into the background: beyond the target [m]. */
  get haze(): number {
    return this.mode === 'top' ? 1e4 : Math.max(30, 1.6 * this.perspective.position.distanceTo(this.around.target));
  }

  setMode(mode: CameraMode): void {
    const from = this.view();
    const glides = this.mode !== 'top' && mode !== 'top' && this.mode !== mode;
    this.mode = mode;
    this.moved = false;
    this.around.enabled = mode !== 'top';
    this.above.enabled = mode === 'top';
    this.settle();
    this.glide = glides ? { from, passed: 0 } : null;
  }

  resize(width: number, height: number): void {
    [this.width, this.height] = [width, height];
    this.perspective.aspect = width / height;
    this.reach();
    this.fitOrthographic();
    if (!this.moved && this.mode !== 'follow') this.settle();
  }

  /** Bounds of the scene, in the scene frame. */
  setBounds(bounds: Box3): void {
    if (bounds.isEmpty() || bounds.equals(this.bounds)) return;
    this.bounds.copy(bounds);
    this.reach();
    if (!this.moved && this.mode !== 'follow') this.settle();
  }

  /** Position and direction of the sensor. */
  setSensor(at: Vector3, forward: Vector3, jump: boolean): void {
    this.sensor.at.copy(at);
    if (Math.hypot(forward.x, forward.z) > 0.1) this.sensor.yaw = Math.atan2(-forward.x, -forward.z);
    if (jump || this.anchor.at.distanceTo(at) > kJump) this.ease(1);
  }

  /** Advances by `seconds`; true while it moves. */
  update(seconds: number): boolean {
    if (this.mode === 'top') return this.above.update();
    const followed = this.ease(1 - Math.exp(-seconds / kEase));
    if (!this.glide) return this.around.update() || followed;
    this.glide.passed += seconds;
    const share = smooth(this.glide.passed / kGlide);
    const to = this.home();
    this.place({
      eye: this.glide.from.eye.clone().lerp(to.eye, share),
      target: this.glide.from.target.clone().lerp(to.target, share),
    });
    if (share >= 1) this.glide = null;
    return true;
  }

  /** Resets to the initial view of the mode. */
  reset(): void {
    this.moved = false;
    this.glide = this.mode === 'top' ? null : { from: this.view(), passed: 0 };
    if (this.mode === 'top') this.settle();
  }

  private take(): void {
    this.moved = true;
    this.glide = null;
  }

  private view(): View {
    return { eye: this.perspective.position.clone(), target: this.around.target.clone() };
  }

  private place({ eye, target }: View): void {
    this.perspective.position.copy(eye);
    this.around.target.copy(target);
    this.around.update();
  }

  private settle(): void {
    if (this.mode === 'top') return this.lookDown();
    if (this.mode === 'follow') this.ease(1);
    this.place(this.home());
  }

  /** Initial view of the mode: behind the sensor, or far enough to show the whole scene. */
  private home(mode: CameraMode = this.mode): View {
    if (mode === 'follow') {
      const turn = new Quaternion().setFromAxisAngle(kUp, this.anchor.yaw);
      const eye = new Vector3(0, kFollow.above, kFollow.behind).applyQuaternion(turn).add(this.anchor.at);
      const target = new Vector3(0, -kFollow.below, -kFollow.ahead).applyQuaternion(turn).add(this.anchor.at);
      return { eye, target };
    }
    const target = this.bounds.getCenter(new Vector3());
    const extent = this.bounds.getSize(new Vector3());
    const radius = 0.5 * Math.hypot(extent.x, extent.z);
    const narrow = Math.min(1, this.perspective.aspect);
    const away = (0.86 * radius) / Math.sin((this.perspective.fov * Math.PI) / 360) / narrow;
    const side = extent.x > extent.z ? new Vector3(0.35, 0.85, 0.75) : new Vector3(0.75, 0.85, 0.35);
    return { eye: side.normalize().multiplyScalar(away).add(target), target };
  }

  /** Lets the camera move away until the whole scene is in view, however large it is. */
  private reach(): void {
    const { eye, target } = this.home('orbit');
    this.around.maxDistance = Math.max(kReach, 1.5 * eye.distanceTo(target));
    this.perspective.far = 2 * this.around.maxDistance;
    this.perspective.updateProjectionMatrix();
  }

  /** Moves the camera by a share of its distance to the sensor; true if noticeable. */
  private ease(share: number): boolean {
    const step = this.sensor.at.clone().sub(this.anchor.at).multiplyScalar(share);
    const turn = Math.atan2(Math.sin(this.sensor.yaw - this.anchor.yaw), Math.cos(this.sensor.yaw - this.anchor.yaw)) * share;
    this.anchor.at.add(step);
    this.anchor.yaw += turn;
    if (this.mode !== 'follow') return false;
    const { position } = this.perspective;
    const before = this.anchor.at.clone().sub(step);
    const rotation = new Quaternion().setFromAxisAngle(kUp, turn);
    for (const point of [position, this.around.target]) point.sub(before).applyQuaternion(rotation).add(this.anchor.at);
    return step.length() > 1e-3 || Math.abs(turn) > 1e-3;
  }

  /** Top view with the longer side of the scene along the longer side of the image. */
  private lookDown(): void {
    const center = this.bounds.getCenter(new Vector3());
    const { x, z } = this.bounds.getSize(new Vector3());
    this.turned = x > z !== this.width > this.height;
    // Slightly off the vertical: the controls require an up direction on the screen.
    const off = this.turned ? new Vector3(-kHair, 100, 0) : new Vector3(0, 100, kHair);
    this.orthographic.position.copy(center).add(off);
    this.orthographic.zoom = 1;
    this.above.target.copy(center);
    this.fitOrthographic();
    this.above.update();
  }

  private fitOrthographic(): void {
    const { x, z } = this.bounds.getSize(new Vector3());
    const [across, along] = this.turned ? [z, x] : [x, z];
    const half = 0.54 * Math.max(along, (across * this.height) / this.width, 1);
    const aspect = this.width / this.height;
    Object.assign(this.orthographic, { left: -half * aspect, right: half * aspect, top: half, bottom: -half });
    this.orthographic.updateProjectionMatrix();
  }
}

function smooth(t: number): number {
  const s = Math.min(1, Math.max(0, t));
  return s * s * (3 - 2 * s);
}
