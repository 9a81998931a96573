const sides = 24;

/** The surface of a rod of diameter 1 about a centerline: points, triangles and, by point, its node. */
export function tube({ x, y, z }) {
  const nodes = x.length;
  const points = new Float32Array(3 * nodes * sides);
  const node = new Uint32Array(nodes * sides);
  const triangles = new Uint32Array(6 * (nodes - 1) * sides);
  let normal = [1, 0, 0];
  for (let i = 0; i < nodes; ++i) {
    const a = Math.max(0, i - 1),
      b = Math.min(nodes - 1, i + 1);
    const tangent = unit([x[b] - x[a], y[b] - y[a], z[b] - z[a]]);
    normal = across(normal, tangent);
    const other = cross(tangent, normal);
    for (let k = 0; k < sides; ++k) {
      const angle = (2 * Math.PI * k) / sides,
        at = i * sides + k;
      const c = 0.5 * Math.cos(angle),
        s = 0.5 * Math.sin(angle);
      points.set(
        [
          x[i] + c * normal[0] + s * other[0],
          y[i] + c * normal[1] + s * other[1],
          z[i] + c * normal[2] + s * other[2],
        ],
        3 * at,
      );
      node[at] = i;
      if (i + 1 < nodes) {
        const next = i * sides + ((k + 1) % sides);
        triangles.set([at, next, at + sides, next, next + sides, at + sides], 6 * at);
      }
    }
  }
  return { points, triangles, node };
}

/** The solid's surface as it is in the files. */
export function surfaceOf({ x, y, z }, quads) {
  const points = new Float32Array(3 * x.length);
  for (let i = 0; i < x.length; ++i) points.set([x[i], y[i], z[i]], 3 * i);
  const triangles = new Uint32Array((6 * quads.length) / 4);
  for (let q = 0; q < quads.length / 4; ++q) {
    const [a, b, c, d] = quads.subarray(4 * q, 4 * q + 4);
    triangles.set([a, b, c, a, c, d], 6 * q);
  }
  return { points, triangles };
}

const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

function unit(v) {
  const length = Math.hypot(...v);
  return length > 0 ? v.map((c) => c / length) : [0, 0, 1];
}

/** What is left of v at right angles to the tangent; any such direction when that is nothing. */
function across(v, tangent) {
  const along = v[0] * tangent[0] + v[1] * tangent[1] + v[2] * tangent[2];
  const left = v.map((c, k) => c - along * tangent[k]);
  return Math.hypot(...left) > 1e-3
    ? unit(left)
    : unit(cross(tangent, Math.abs(tangent[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0]));
}
