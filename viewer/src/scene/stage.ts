import { Color, Scene, WebGLRenderer } from 'three';
import { CameraRig } from './camera_rig';
import { LabelOverlay } from './label_overlay';
import { kColors } from './palette';
import { PointBudget, rendersInSoftware } from './point_budget';
import { pointUniforms } from './point_material';

export interface StageEvents {
  /** Called before an image is drawn; `budget` is the allowed number of map points; returns the number drawn. */
  draw(budget: number): number;
  /** Called after it. */
  drawn(): void;
}

/** How long the scene must be unchanged before it is drawn in full [ms]. */
const kRest = 250;

/** The canvas: draws after changes, coarsely during motion, in full at rest. */
export class Stage {
  readonly scene = new Scene();
  readonly renderer: WebGLRenderer;
  readonly labels = new LabelOverlay();
  readonly rig: CameraRig;
  private readonly moving: PointBudget;
  private readonly resting: PointBudget;
  private readonly software = rendersInSoftware();
  private requested = false;
  private last = 0;
  private restTimer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly container: HTMLElement,
    private readonly events: StageEvents,
  ) {
    this.renderer = new WebGLRenderer({ antialias: !this.software, powerPreference: 'high-performance' });
    this.scene.background = new Color(kColors.background);
    const small = matchMedia('(pointer: coarse)').matches;
    const most = small ? 2_000_000 : 6_000_000;
    this.moving = new PointBudget(40, 60_000, most, this.software ? 150_000 : 1_000_000);
    this.resting = new PointBudget(1500, 400_000, most, this.software ? 800_000 : most);
    this.renderer.domElement.classList.add('scene-canvas');
    this.labels.canvas.classList.add('label-canvas');
    container.append(this.renderer.domElement, this.labels.canvas);
    this.rig = new CameraRig(this.renderer.domElement, () => this.invalidate());
    // Nothing else changes when the browser gives the lost context back.
    this.renderer.domElement.addEventListener('webglcontextrestored', () => this.invalidate());
    new ResizeObserver(() => this.resize()).observe(container);
  }

  /** Requests an image after a change. */
  invalidate(): void {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame((now) => this.step(now));
  }

  /** Draws the scene with its labels. */
  picture(): Promise<Blob | null> {
    this.render(this.resting.points); // the canvas may have lost its previous content
    const canvas = document.createElement('canvas');
    const { width, height } = this.renderer.domElement;
    Object.assign(canvas, { width, height });
    const context = canvas.getContext('2d') as CanvasRenderingContext2D;
    context.drawImage(this.renderer.domElement, 0, 0);
    context.drawImage(this.labels.canvas, 0, 0, width, height);
    return new Promise((resolve) => canvas.toBlob(resolve, 'image/png'));
  }

  private step(now: number): void {
    this.requested = false;
    const interval = now - this.last;
    this.last = now;
    const moves = this.rig.update(Math.min(0.1, interval / 1000));
    this.renderWithin(this.moving);
    if (moves) this.invalidate();
    clearTimeout(this.restTimer);
    this.restTimer = setTimeout(() => this.renderWithin(this.resting), kRest);
  }

  private renderWithin(budget: PointBudget): void {
    const start = performance.now();
    const points = this.render(budget.points);
    // The browser requests the next image after this one is finished.
    requestAnimationFrame(() => budget.learn(points, performance.now() - start));
  }

  /** Returns the number of map points drawn. */
  private render(budget: number): number {
    const { camera } = this.rig;
    camera.updateMatrixWorld();
    const ratio = this.renderer.getPixelRatio();
    pointUniforms.pixelsPerMetre.value = this.rig.pixelsPerMetre * ratio;
    pointUniforms.orthographic.value = this.rig.mode === 'top';
    pointUniforms.haze.value = this.rig.haze;
    const points = this.events.draw(budget);
    this.renderer.render(this.scene, camera);
    this.events.drawn();
    return points;
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.container;
    if (width === 0 || height === 0) return;
    const ratio = this.software ? 1 : Math.min(2, devicePixelRatio);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height);
    this.labels.resize(width, height, Math.min(2, devicePixelRatio));
    this.rig.resize(width, height);
    this.render(this.moving.points);
    this.invalidate();
  }
}
