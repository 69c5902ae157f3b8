// SPDX-License-Identifier: BSD-3-Clause
// Rigid transforms as arrays [x, y, z, qx, qy, qz, qw]; T_target_source maps points of source to target.
export const identity = [0, 0, 0, 0, 0, 0, 1];

export const poseAt = (list, i) => Array.prototype.slice.call(list, 7 * i, 7 * i + 7);

export function rotate(T, [x, y, z]) {
  const [, , , a, b, c, w] = T;
  const u = 2 * (b * z - c * y), v = 2 * (c * x - a * z), s = 2 * (a * y - b * x);
  return [x + w * u + b * s - c * v, y + w * v + c * u - a * s, z + w * s + a * v - b * u];
}

export function apply(T, p) {
  const r = rotate(T, p);
  return [r[0] + T[0], r[1] + T[1], r[2] + T[2]];
}

export function multiply(A, B) {
  const [, , , ax, ay, az, aw] = A, [, , , bx, by, bz, bw] = B, t = apply(A, B);
  return [...t, aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz];
}

export function inverse(T) {
  const back = [0, 0, 0, -T[3], -T[4], -T[5], T[6]], t = rotate(back, T);
  return [-t[0], -t[1], -t[2], ...back.slice(3)];
}

/// Straight in position, along the shorter arc in rotation.
export function between(A, B, s) {
  const dot = A[3] * B[3] + A[4] * B[4] + A[5] * B[5] + A[6] * B[6], sign = dot < 0 ? -s : s;
  const T = A.map((a, i) => i < 3 ? a + s * (B[i] - a) : (1 - s) * a + sign * B[i]);
  const norm = Math.hypot(T[3], T[4], T[5], T[6]);
  for (let i = 3; i < 7; ++i) T[i] /= norm;
  return T;
}

/// [metres, degrees]
export const distance = (A, B) => {
  const D = multiply(inverse(A), B);
  return [Math.hypot(D[0], D[1], D[2]), 2 * Math.atan2(Math.hypot(D[3], D[4], D[5]), Math.abs(D[6])) * 180 / Math.PI];
};
