import { h, table } from "./dom.js";
import { number, percent, short, whole } from "./format.js";
import { commas, fidelityName, words } from "./words.js";

const millimetres = (metres) => `${short(1e3 * metres)} mm`;

/** Effects that the scene could have asked for and did not; a direction is no effect. */
function leftOut({ effects = {}, rod = {} }) {
  const off = (of) =>
    Object.entries(of).filter(([name, value]) => !value && !name.endsWith("direction"));
  const natural = Object.entries(rod).filter(
    ([name, value]) => name.startsWith("natural") && !value,
  );
  return [...off(effects), ...natural].map(([name]) => words(name));
}

function simulated(result, fidelity) {
  const { scene, summary } = result;
  const friction = scene.effects?.friction;
  const asked = Object.entries(scene.effects ?? {}).filter(
    ([name, value]) => value && !name.endsWith("direction"),
  );
  const said = (names) =>
    commas(
      names.map((name) =>
        name === "friction" ? `friction (μ = ${short(friction)})` : words(name),
      ),
    );
  const effects = summary?.[fidelity]?.effects;
  return effects
    ? said(effects)
    : `not finished; the scene asks for ${said(asked.map(([name]) => name)) || "no more than elasticity"}`;
}

const sizes = {
  rod: (of, scene) =>
    `${whole(of?.segments ?? scene.rod1d?.segments)} segments${of?.unknowns ? `, ${whole(of.unknowns)} unknowns` : ""}; its sections stay round`,
  solid: (of, scene) =>
    [
      of?.cells ? `${whole(of.cells)} hexahedra, ` : "",
      `about ${short(scene.solid3d?.section_elements ?? NaN)} in a section`,
      of?.unknowns ? `, ${whole(of.unknowns)} unknowns` : "",
      of?.one_half ? " (one half, with its image)" : "",
    ].join(""),
};

/** What was simulated, in a few lines. */
export function scene(result) {
  const { scene, summary } = result;
  const { rod, material = {}, knot = {}, ends = {}, path = {} } = scene;
  if (!rod) return h("p", {}, "The scene of the runs is in their folders.");
  const bending = (Math.PI * material.youngs_modulus * rod.diameter ** 4) / 64;
  const steered = path.force?.length
    ? `forces ${path.force.map((f) => `${short(f)} N`).join(" → ")}`
    : `ē = ${(path.ebar ?? []).map(short).join(" → ")}`;
  const rows = [
    [
      "Rod",
      `L₀ = ${millimetres(rod.length)} = ${number(rod.length / rod.diameter, 4)} D, D = ${millimetres(rod.diameter)}, E = ${number(1e-6 * material.youngs_modulus)} MPa, ν = ${short(material.poissons_ratio ?? NaN)}; B = πED⁴/64 = ${number(bending)} N m², so T̄ = 1 is ${number((4 * bending) / rod.diameter ** 2)} N`,
    ],
    [
      "Knot",
      `${knot.centerline || knot.type}${knot.start === "straight" ? ", tied from a straight rod" : ""}; start ${ends.start ?? "clamped"}, finish ${words(ends.finish ?? "")}`,
    ],
    [
      "Path",
      `${steered}, steps of at most ${short(path.max_step ?? NaN)} in ē = (L₀ − L)/D; ${result.recorded} recorded states`,
    ],
    ...result.fidelities.map((fidelity) => [
      fidelityName(fidelity),
      `${simulated(result, fidelity)}. ${sizes[fidelity](summary?.[fidelity], scene)}`,
    ]),
    ["Left out", commas(leftOut(scene)) || "nothing that could have been asked for"],
    [
      "Outcome",
      summary
        ? `${summary.verdict}${summary.warnings?.length ? `; warnings: ${summary.warnings.join("; ")}` : ""}`
        : "not finished: no summary.json yet; the page shows what has been written so far",
    ],
  ];
  return h(
    "dl",
    { class: "facts" },
    rows.map(([name, text]) => [h("dt", {}, name), h("dd", {}, text)]),
  );
}

/** The tightest state in a sentence, and where the fidelities part. */
export function verdict(result) {
  const sentences = [];
  const last = result.states
    .filter((state) => result.fidelities.every((f) => state.row[f]))
    .reduce(
      (tightest, state) => (tightest && tightest.ebar <= state.ebar ? tightest : state),
      null,
    );
  if (last) {
    const said = result.fidelities.map(
      (f) =>
        `the ${f} pulls with T̄ = ${number(last.row[f].force_normalised)} (${number(last.row[f].force_n)} N)`,
    );
    const [a, b] = result.fidelities.map((f) => last.row[f].force_normalised);
    sentences.push(
      `At ē = ${short(last.ebar)} ${said.join(", ")}${b == null ? "" : `, ${percent(b / a - 1)}`}.`,
    );
  }
  for (const [name, levels] of Object.entries(result.comparison?.parted ?? {})) {
    const apart = levels
      .filter(({ ebar }) => ebar != null)
      .map(({ level, ebar }) => `${short(100 * level)} % from ē = ${number(ebar)} on`);
    const never = levels
      .filter(({ ebar }) => ebar == null)
      .map(({ level }) => `${short(100 * level)} %`);
    const said = [
      ...(apart.length ? [`stay apart in T by more than ${commas(apart)}`] : []),
      ...(never.length ? [`do not stay apart by ${never.join(" or ")}`] : []),
    ];
    sentences.push(
      `${name[0].toUpperCase()}${name.slice(1)} and ${result.comparison.names[0]} ${said.join("; they ")}.`,
    );
  }
  const valid = result.summary?.rod?.validity;
  if (valid?.sentence) sentences.push(`From its own contact forces: ${valid.sentence}.`);
  return sentences.map((sentence) => h("p", {}, sentence));
}

/** Tension at every recorded state. */
export function tensions(result) {
  const both = result.fidelities.length > 1;
  const head = [
    "ē",
    ...result.fidelities.flatMap((f) => [
      h("span", {}, "T̄ ", fidelityName(f)),
      h("span", {}, "T ", fidelityName(f), " [N]"),
    ]),
    ...(both ? ["T̄ of solid against rod", "mean |Δκ|/κ"] : []),
  ];
  const rows = result.states.map((state) => {
    const forces = result.fidelities.map((f) => state.row[f]?.force_normalised);
    return [
      short(state.ebar),
      ...result.fidelities.flatMap((f) => [
        number(state.row[f]?.force_normalised, 4),
        number(state.row[f]?.force_n, 4),
      ]),
      ...(both
        ? [
            percent(forces[1] / forces[0] - 1),
            state.curvature == null ? "–" : `${(100 * state.curvature).toFixed(1)} %`,
          ]
        : []),
    ];
  });
  return table(head, rows);
}
