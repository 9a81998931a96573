import { colours } from "./colours.js";
import { figure, h, row, section } from "./dom.js";
import * as force from "./force_charts.js";
import { short } from "./format.js";
import * as tables from "./health_tables.js";
import { loosens } from "./result.js";
import * as along from "./rod_charts.js";
import * as steps from "./step_charts.js";
import { viewer } from "./viewer.js";

const several = 12; // panels of curvature at most

export function shapes(result) {
  const left = result.recorded - result.states.length;
  return section(
    "Shapes",
    viewer(result),
    h(
      "p",
      { class: "note" },
      "Recorded states, each knot centred; the pulling axis runs to the right. Drag to turn, right-drag to shift, wheel after a click to zoom. ",
      result.fidelities.includes("rod")
        ? "The rod is a tube of diameter D about rod/centerline/*.csv. "
        : "",
      result.fidelities.includes("solid")
        ? "The solid is the surface of solid/vtu/*.vtu in deformed coordinates, to 1/65,536 of its size; stresses and J, constant in a cell, are averaged at the surface's points. "
        : "",
      left > 0 ? `${left} more recorded states are not in this page.` : "",
    ),
  );
}

export function forces(result) {
  const files = [
    ...result.fidelities.map((f) => `${f}/force.csv`),
    ...result.measured.map((of) => of.name),
  ].join(", ");
  const law =
    "Dashed: loose-knot law T̄ = π²/(2ē²) + 0.492 μ (π/ē)^1.5 of an overhand knot (Audoly, Clauvelin, Neukirch 2007), a limit for ē → ∞";
  return section(
    "Force",
    row(
      figure(
        "force-log",
        `${law}${loosens(result) ? "; dotted: − while loosening" : ""}. [${files}]`,
        force.force(result, true),
      ),
      figure("force-linear", "The same, linear.", force.force(result, false)),
      result.comparison.names.length > 1
        ? figure(
            "difference",
            `Relative difference of T̄ at equal ē from ${result.comparison.names[0]}, between steps by a monotone cubic. [${files}]`,
            force.difference(result),
          )
        : null,
    ),
  );
}

/** At most `several` of the states for which there is something, the last one among them. */
function someOf(states, there) {
  const chosen = states.filter(there);
  const every = Math.ceil(chosen.length / several);
  return chosen.filter((_, i) => (chosen.length - 1 - i) % every === 0);
}

export function curvatures(result) {
  const states = someOf(result.states, (state) => Object.keys(state.lines).length > 0);
  if (states.length === 0) return null;
  const lines = states.flatMap((state) => Object.values(state.lines));
  const kappa =
    1.05 * Math.max(...lines.map((line) => line.kappa.reduce((a, b) => Math.max(a, b), 0)));
  const reach = 1.4 * Math.max(...lines.map((line) => line.half));
  const panel = (state) => {
    const apart =
      state.curvature == null ? "" : `, mean difference ${(100 * state.curvature).toFixed(1)} %`;
    return figure(
      `curvature ${state.name}`,
      h("span", {}, h("b", {}, `ē = ${short(state.ebar)}`), apart),
      along.curvature(result, state, { kappa, reach }),
    );
  };
  return section(
    "Curvature",
    h(
      "p",
      {},
      "κD along the undeformed rod: ",
      result.fidelities.map((f) => h("b", { style: `color: ${colours[f]}` }, `${f} `)),
      "against the distance from the knot's middle s₀, the mean of s weighted by κ². Where the knot sits along the rod is soft, so the profiles are laid on each other there. The mean difference is the mean of |Δκ| over the mean κ of the rod, where κ is above a tenth of its largest. [*/centerline/*.csv]",
    ),
    h("div", { class: "panels" }, states.map(panel)),
  );
}

export function contacts(result) {
  const states = someOf(result.states, (state) => state.contacts?.s_a?.length > 0);
  if (states.length === 0) return null;
  const reach = 1.1 * Math.max(...states.map((state) => furthest(state)));
  const panel = (state) => {
    const force = state.contacts.force_normalised.reduce((a, b) => Math.max(a, b), 0);
    return figure(
      `contacts ${state.name}`,
      h("b", {}, `ē = ${short(state.ebar)}`),
      along.contacts(state, { reach, force }),
    );
  };
  return section(
    "Contact of the rod",
    h(
      "p",
      {},
      "Each mark is a pair of places where the rod touches itself, by their distances from the knot's middle along the rod; its area grows with the force, in each panel from zero to the largest. [rod/contacts/*.csv]",
    ),
    h("div", { class: "panels" }, states.map(panel)),
  );
}

function furthest({ contacts: { s_a, s_b }, lines: { rod } }) {
  const away = (values) => values.reduce((a, s) => Math.max(a, Math.abs(s - rod.middle)), 0);
  return Math.max(away(s_a), away(s_b));
}

export function profiles(result) {
  const linear = result.youngsModulus * result.diameter;
  const columns = [
    ["rod", "contact_force", "contact force of the rod [N/m]", linear],
    ["rod", "twist", "twist of the rod [rad/D]", 1],
    ["solid", "flattening", "flattening of the solid's sections [%]", 100],
  ];
  const there = columns.filter(([f, column]) =>
    result.states.some((state) => state.lines[f]?.[column]),
  );
  return there.length === 0
    ? null
    : section(
        "Along the knot",
        row(
          there.map(([f, column, text, factor]) =>
            figure(
              `${f} ${column}`,
              `A line a recorded state, coloured by ē. [${f}/centerline/*.csv]`,
              along.profiles(result, f, column, text, factor),
            ),
          ),
        ),
      );
}

export function energies(result) {
  return section(
    "Energy",
    row(
      figure(
        "energy",
        "Stored energy, and what friction and snaps took since the first row (lost). [*/force.csv]",
        steps.energy(result),
      ),
      h("div", {}, tables.energies(result)),
    ),
  );
}

export function health(result) {
  return section(
    "Numerical health",
    row(
      figure(
        "iterations",
        "Newton iterations of each accepted step; ringed: after tries that were cut.",
        steps.health(result, "newton_iterations", "iterations"),
      ),
      figure(
        "residual",
        "Out-of-balance force over the force scale.",
        steps.health(result, "residual", "residual", { log: true }),
      ),
      figure(
        "penetration",
        "Largest overlap of surfaces in contact.",
        steps.health(result, "max_penetration", "penetration [% of D]", { factor: 100 }),
      ),
    ),
    row(
      h("div", {}, tables.worst(result)),
      h(
        "div",
        {},
        result.summary
          ? tables.phases(result.summary)
          : h("p", {}, "Times and memory by phase are known when the run has ended."),
      ),
    ),
    h(
      "p",
      { class: "note" },
      "Energy that misses the work: |stored + lost − ∫T dL| over ∫T dL, by the trapezoidal rule over the rows. [*/force.csv, summary.json]",
    ),
    result.notes.length > 0
      ? h(
          "details",
          {},
          h("summary", {}, `${result.notes.length} lines of run.log on cut tries and snaps`),
          h("pre", {}, result.notes.join("\n")),
        )
      : null,
  );
}
