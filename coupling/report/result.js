/** Bytes of base64 text. */
const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

/** Numbers as coupling/pack.cpp wrote them: from + step * word. */
const numbers = ({ from, step, words }) =>
  Float32Array.from(new Uint16Array(bytes(words).buffer), (word) => from + step * word);

const mapped = (object, of) =>
  Object.fromEntries(Object.entries(object).map(([name, value]) => [name, of(value)]));

/** {column: [values]} as a list of rows; columns are named as in the files, in lower case. */
function rowsOf({ rows: count, ...columns }) {
  const names = Object.keys(columns);
  return columns[names[0]].map((_, i) =>
    Object.fromEntries(names.map((name) => [name, columns[name][i]])),
  );
}

/** Place of the knot: the mean of `column` along the rod, weighted by the bending energy kappa^2 ds. */
function middle({ s, kappa }, column) {
  let weight = 0,
    moment = 0;
  for (let i = 0; i + 1 < s.length; ++i) {
    const energy = (0.5 * (kappa[i] + kappa[i + 1])) ** 2 * (s[i + 1] - s[i]);
    weight += energy;
    moment += energy * 0.5 * (column[i] + column[i + 1]);
  }
  return weight > 0 ? moment / weight : 0;
}

/** Half the length of rod about the middle [D] that stores 97 % of the bending energy: the knot. */
function halfLength({ s, kappa, middle: centre }) {
  const pieces = Array.from(s.subarray(1), (end, i) => ({
    away: Math.abs(0.5 * (s[i] + end) - centre),
    energy: (0.5 * (kappa[i] + kappa[i + 1])) ** 2 * (end - s[i]),
  })).sort((a, b) => a.away - b.away);
  const all = pieces.reduce((sum, piece) => sum + piece.energy, 0);
  let within = 0;
  return pieces.find((piece) => (within += piece.energy) >= 0.97 * all)?.away ?? 1;
}

/** Radius of a ball about the knot's centre that holds the knot [D]. */
function reach({ s, x, y, z, middle: at, centre, half }) {
  let furthest = 1;
  s.forEach((of, i) => {
    if (Math.abs(of - at) <= half)
      furthest = Math.max(
        furthest,
        Math.hypot(x[i] - centre[0], y[i] - centre[1], z[i] - centre[2]),
      );
  });
  return furthest + 0.5;
}

function lineOf(packed) {
  const line = mapped(packed, numbers);
  line.middle = middle(line, line.s);
  line.centre = ["x", "y", "z"].map((axis) => middle(line, line[axis]));
  line.half = halfLength(line);
  line.reach = reach(line);
  return line;
}

/** Energy [mJ] since the first row: stored, lost to friction and snaps, and the work of the end force
 *  by the trapezoidal rule: dW = -T D d(ebar). */
function balanceOf(rows, diameter) {
  let snapped = 0,
    work = 0;
  return rows.map((row, i) => {
    const before = rows[Math.max(0, i - 1)];
    snapped += i > 0 ? (row.snapped_j ?? 0) : 0;
    work -= 0.5 * (row.force_n + before.force_n) * diameter * (row.ebar - before.ebar);
    return {
      ebar: row.ebar,
      stored: 1e3 * row.energy_j,
      gained: 1e3 * (row.energy_j - rows[0].energy_j),
      lost: 1e3 * ((row.dissipated_j ?? 0) - (rows[0].dissipated_j ?? 0) + snapped),
      work: 1e3 * work,
    };
  });
}

/** Does the path loosen the knot against friction? */
export const loosens = ({ fidelities, rows, scene }) =>
  scene.effects?.friction > 0 &&
  fidelities.some((fidelity) => rows[fidelity].some((row) => row.increment > 0));

/** What the page's data holds, unpacked; lengths in D. Names are those of the files. */
export function readResult(data) {
  const fidelities = Object.keys(data.force);
  const rows = mapped(data.force, rowsOf);
  const visits = {}; // an ebar may be recorded more than once
  const states = (data.states?.list ?? []).map((state) => {
    const visit = Number(/_(\d+)$/.exec(state.name.replace(/^ebar_/, ""))?.[1] ?? 1);
    const at = (fidelity) =>
      state[fidelity] &&
      rows[fidelity].filter((row) => Math.abs(row.ebar - state.ebar) < 1e-6)[visit - 1];
    return {
      name: state.name,
      ebar: state.ebar,
      lines: mapped(
        Object.fromEntries(fidelities.filter((f) => state[f]).map((f) => [f, state[f]])),
        lineOf,
      ),
      contacts: state.contacts && mapped(state.contacts, numbers),
      surface: state.surface && mapped(state.surface, numbers),
      row: Object.fromEntries(fidelities.map((fidelity) => [fidelity, at(fidelity)])),
      curvature: data.curvature?.find((of) => of.name === state.name)?.mean_difference,
    };
  });
  return {
    ...data,
    fidelities,
    rows,
    states,
    recorded: data.states?.recorded ?? 0,
    quads: data.states ? new Uint32Array(bytes(data.states.quads.words).buffer) : new Uint32Array(),
    measured: data.measured ?? [],
    balance: mapped(rows, (of) => balanceOf(of, data.scene.rod.diameter)),
    diameter: data.scene.rod?.diameter,
    youngsModulus: data.scene.material?.youngs_modulus,
  };
}
