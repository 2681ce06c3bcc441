import { BoxGeometry, Color, DynamicDrawUsage, Group, InstancedMesh, Matrix4, MeshBasicMaterial, Quaternion, Vector3 } from 'three';
import type { SceneObject } from '../protocol/messages';
import { ColoredSegments } from './line_segments';
import { classColor, kColors } from './palette';

const kMaxObjects = 512;
/** The twelve edges of a cube, as pairs of its corners; bit k of a corner is its side along axis k. */
const kEdges = [0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7];
/** Slower objects have no arrow [m/s]. */
const kSlow = 0.15;

/** One box per object, red for people and green for vehicles, with an arrow to its position in one second. */
export class ObjectLayer {
  readonly group = new Group();
  private readonly edges = new ColoredSegments({ width: 2.5 });
  private readonly faces: InstancedMesh;
  private readonly up = new Vector3(0, -1, 0);

  constructor() {
    const material = new MeshBasicMaterial({ transparent: true, opacity: 0.14, depthWrite: false });
    this.faces = new InstancedMesh(new BoxGeometry(1, 1, 1), material, kMaxObjects);
    this.faces.instanceMatrix.setUsage(DynamicDrawUsage);
    this.faces.frustumCulled = false;
    this.faces.count = 0;
    this.faces.renderOrder = 1;
    this.group.add(this.faces, this.edges.object);
  }

  setUp(up: Vector3): void {
    this.up.copy(up);
  }

  update(objects: SceneObject[]): void {
    this.edges.clear();
    this.faces.count = Math.min(kMaxObjects, objects.length);
    objects.slice(0, kMaxObjects).forEach((object, i) => this.place(object, i));
    this.faces.instanceMatrix.needsUpdate = true;
    if (this.faces.instanceColor) this.faces.instanceColor.needsUpdate = true;
    this.edges.commit();
  }

  private place(object: SceneObject, index: number): void {
    const color = objectColor(object);
    pose.compose(
      center.fromArray(object.center),
      rotation.fromArray(object.orientation),
      size.fromArray(object.size).max(kSmallest),
    );
    this.faces.setMatrixAt(index, pose);
    this.faces.setColorAt(index, color);
    const corners = boxCorners(pose);
    for (let i = 0; i < kEdges.length; i += 2) {
      this.edges.add(corners, 3 * kEdges[i], corners, 3 * kEdges[i + 1], color);
    }
    if (object.moving) this.addArrow(object, color);
  }

  private addArrow(object: SceneObject, color: Color): void {
    const along = new Vector3().fromArray(object.velocity);
    if (along.length() < kSlow) return;
    const tail = new Vector3().fromArray(object.center);
    const tip = tail.clone().add(along);
    const side = along.clone().cross(this.up).normalize().multiplyScalar(0.12);
    const neck = tip.clone().addScaledVector(along.normalize(), -0.22);
    const points = [tail, tip, neck.clone().add(side), neck.clone().sub(side)].flatMap((point) => point.toArray());
    for (const [from, to] of [[0, 1], [1, 2], [1, 3]]) this.edges.add(points, 3 * from, points, 3 * to, color);
  }
}

const pose = new Matrix4();
const center = new Vector3();
const rotation = new Quaternion();
const size = new Vector3();
const kSmallest = new Vector3(1e-3, 1e-3, 1e-3);

/** Pale if the object is unseen. */
export function objectColor(object: SceneObject): Color {
  const color = new Color(classColor(object.class));
  return object.seen ? color : color.lerp(new Color(kColors.background), 0.55);
}

function boxCorners(box: Matrix4): number[] {
  const corner = new Vector3();
  const corners: number[] = [];
  for (let i = 0; i < 8; ++i) {
    corner.set((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 0.5).applyMatrix4(box);
    corners.push(corner.x, corner.y, corner.z);
  }
  return corners;
}
