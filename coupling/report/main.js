import { h, section, table } from "./dom.js";
import * as overview from "./overview.js";
import { readResult } from "./result.js";
import { contacts, curvatures, energies, forces, health, profiles, shapes } from "./sections.js";
import { study } from "./study.js";
import css from "./style.css";

const ran = (result) => result.fidelities.length > 0;

function header(result) {
  const title = result.scene.title || result.folder;
  const versions = result.summary?.versions;
  return h(
    "header",
    {},
    h("h1", {}, title),
    h("p", { class: "note" }, `${result.folder}${versions ? `, bight ${versions.bight}` : ""}`),
  );
}

const simulated = (result) => ran(result) && section("What was simulated", overview.scene(result));

const tension = (result) =>
  ran(result) &&
  section(
    "Tension",
    overview.verdict(result),
    result.states.length > 0 ? overview.tensions(result) : null,
  );

const accuracy = (result) => result.study && study(result);

const drawn = [shapes, forces, curvatures, contacts, profiles, energies, health].map(
  (part) => (result) => ran(result) && part(result),
);

const scene = (result) =>
  result.scene_text && section("The scene as run", h("pre", {}, result.scene_text));

const filesOf = {
  rod: [
    ["rod/force.csv", "tension, energies, penetration, iterations, residuals: a row a step"],
    ["rod/rod.pvd, rod/centerline/*.csv", "the rod's shape, curvature, contact force, twist"],
    ["rod/contacts/*.csv", "where the rod touches itself"],
  ],
  solid: [
    ["solid/force.csv", "the same of the solid, smallest J"],
    ["solid/solid.pvd, solid/vtu/*.vtu", "the solid's surface and its fields"],
    ["solid/centerline/*.csv", "curvature and flattening of the solid's sections"],
  ],
};

function sources(result) {
  const ofRun = [
    ["scene.toml", "the scene as it was run"],
    ["summary.json", "effects, sizes, times and memory by phase, energies by effect, validity"],
    ...result.fidelities.flatMap((fidelity) => filesOf[fidelity]),
    ["run.log", "reasons of cut tries, snaps"],
  ];
  const rows = [
    ...(ran(result) ? ofRun : []),
    ...(result.study ? [["study.csv, study.json", "error against time"]] : []),
    ...result.measured.map((of) => [of.name, "measured curve laid over"]),
  ];
  return section(
    "Where the numbers come from",
    table(["file", "used for"], rows),
    ran(result)
      ? h(
          "p",
          { class: "note" },
          "Differences between fidelities are computed from these files as bight compare does.",
        )
      : null,
  );
}

/** A part of the page; what goes wrong in it is said there, and the others are drawn. */
function guarded(part, result) {
  try {
    return part(result) || null;
  } catch (error) {
    console.error(error);
    return section("Not drawn", h("p", {}, `A part of this page failed: ${error.message}`));
  }
}

const parts = [header, simulated, tension, accuracy, ...drawn, scene, sources];

document.head.append(h("style", {}, css));
const data = JSON.parse(document.getElementById("data").textContent);
const result = readResult(data);
document.body.append(
  h(
    "main",
    {},
    parts.map((part) => guarded(part, result)),
  ),
);
