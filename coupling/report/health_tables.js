import { h, table } from "./dom.js";
import { number, seconds, short, whole } from "./format.js";
import { commas, fidelityName, words } from "./words.js";

/** Worst values and work, a column for each fidelity. */
export function worst(result) {
  const of = (fidelity) => result.summary?.[fidelity] ?? {};
  const rows = (fidelity) => result.rows[fidelity];
  const most = (fidelity, column) =>
    rows(fidelity).reduce((a, row) => Math.max(a, row[column]), -Infinity);
  const sum = (fidelity, column) => rows(fidelity).reduce((a, row) => a + row[column], 0);
  const whole_run = (fidelity) => result.force[fidelity].rows === rows(fidelity).length;
  const line = (name, value) => [name, ...result.fidelities.map(value)];
  return table(
    ["", ...result.fidelities.map(fidelityName)],
    [
      line("accepted steps", (f) => whole(result.force[f].rows)),
      line("Newton iterations", (f) =>
        whole(of(f).newton_iterations ?? (whole_run(f) ? sum(f, "newton_iterations") : null)),
      ),
      line("tries that were cut", (f) =>
        whole(of(f).cutbacks ?? (whole_run(f) ? sum(f, "cutbacks") : null)),
      ),
      line("worst penetration", (f) => `${number(100 * most(f, "max_penetration"))} % of D`),
      line("smallest J of a cell", (f) =>
        f === "rod"
          ? "–"
          : number(rows(f).reduce((a, row) => Math.min(a, row.min_jacobian), Infinity)),
      ),
      line("largest residual, of the force scale", (f) => number(most(f, "residual"), 2)),
      line("largest mismatch of the end forces, of T", (f) =>
        number(most(f, "reaction_mismatch"), 2),
      ),
      line("energy that misses the end force's work", (f) => missing(result, f)),
      line(
        "snaps at ē",
        (f) =>
          commas(
            rows(f)
              .filter((row) => row.snapped_j > 0)
              .map((row) => short(row.ebar)),
          ) || "none",
      ),
      line("knot determinant of the recorded states", (f) => {
        const seen = (of(f).states ?? []).map((state) => state.determinant);
        return commas([...new Set(seen)]) || "–";
      }),
      line("wall time", (f) => seconds(rows(f).at(-1).wall_s)),
    ],
  );
}

/** |stored + lost - work| over the work; only where the end force alone does work and time is not known. */
function missing(result, fidelity) {
  const { effects = {}, ends = {} } = result.scene;
  const balance = result.balance[fidelity];
  if (balance.length < 3 || effects.inertia || effects.damping || effects.gravity || ends.turn)
    return "–";
  const { gained, lost, work } = balance.at(-1);
  return `${number((100 * Math.abs(gained + lost - work)) / Math.abs(work), 2)} %`;
}

export function phases({ phases = {}, machine }) {
  const rows = Object.entries(phases).map(([name, of]) => [
    name,
    seconds(of.wall_s),
    seconds(of.cpu_s),
    `${number(of.peak_MB)} MB`,
  ]);
  return [
    table(["phase", "wall", "processor", "peak memory"], rows),
    machine
      ? h(
          "p",
          { class: "note" },
          `${machine.processor}, ${machine.cores} cores, ${machine.threads} thread${machine.threads === 1 ? "" : "s"}, ${machine.system}`,
        )
      : null,
  ];
}

/** Energy by effect at the recorded states [mJ]. */
export function energies(result) {
  return result.fidelities
    .filter((f) => result.summary?.[f]?.states?.length)
    .map((fidelity) => {
      const { states } = result.summary[fidelity];
      const effects = Object.keys(states[0].energy_J);
      return table(
        [
          h("span", {}, fidelityName(fidelity), ", ē"),
          ...effects.map((name) => `${words(name)} [mJ]`),
        ],
        states.map((state) => [
          short(state.ebar),
          ...effects.map((name) => number(1e3 * state.energy_J[name], 4)),
        ]),
      );
    });
}
