import { Matrix4, Quaternion, Vector3 } from 'three';

/** Rotates the map frame so that `up` becomes y and the first viewing direction (z) points away. */
export function upright(up: Vector3): Quaternion {
  const y = up.clone().normalize();
  const ahead = Math.abs(y.z) > 0.9 ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1);
  const forward = ahead.addScaledVector(y, -ahead.dot(y)).normalize();
  const right = forward.clone().cross(y);
  // Rows are the scene's axes in the map frame.
  const rotation = new Matrix4().makeBasis(right, y, forward.negate()).transpose();
  return new Quaternion().setFromRotationMatrix(rotation);
}
