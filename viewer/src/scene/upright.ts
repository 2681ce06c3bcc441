import { Matrix4, Quaternion, Vector3 } from 'three';

/** Ahead in a sensor's frame with this up direction: x of a LiDAR, whose z is up, z of a camera. */
export function aheadOf(up: Vector3): Vector3 {
  if (up.z > 0.7) return new Vector3(1, 0, 0);
  return up.z < -0.9 ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1);
}

/** Rotates the map frame so that `up` becomes y and the first viewing direction points away. */
export function upright(up: Vector3): Quaternion {
  const y = up.clone().normalize();
  const ahead = aheadOf(y);
  const forward = ahead.addScaledVector(y, -ahead.dot(y)).normalize();
  const right = forward.clone().cross(y);
  // Rows are the scene's axes in the map frame.
  const rotation = new Matrix4().makeBasis(right, y, forward.negate()).transpose();
  return new Quaternion().setFromRotationMatrix(rotation);
}
