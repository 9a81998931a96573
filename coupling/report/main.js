import { h, section, table } from "./dom.js";
import * as overview from "./overview.js";
import { readResult } from "./result.js";
import { curvatures, energies, forces, health, profiles, shapes } from "./sections.js";
import { study } from "./study.js";
import css from "./style.css";

const sections = [shapes, forces, curvatures, profiles, energies, health];

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

function sources(result) {
  const rows = [
    ["scene.toml", "the scene as it was run"],
    ["summary.json", "effects, sizes, times and memory by phase, energies by effect, validity"],
    [
      "rod/force.csv, solid/force.csv",
      "tension, energies, penetration, iterations, residuals: a row per accepted step",
    ],
    [
      "rod/centerline/*.csv, solid/centerline/*.csv",
      "curvature, contact force, flattening; the rod's shape",
    ],
    ["solid/solid.pvd, solid/vtu/*.vtu", "the solid's surface and its fields"],
    ["run.log", "reasons of cut tries, snaps"],
    ...(result.study ? [["study.csv, study.json", "error against time"]] : []),
    ...result.measured.map((of) => [of.name, "measured curve laid over"]),
  ];
  return section(
    "Where the numbers come from",
    table(["file", "used for"], rows),
    h(
      "p",
      { class: "note" },
      "Differences between fidelities are computed from these files as bight compare does.",
    ),
  );
}

function page(result) {
  const ran = result.fidelities.length > 0;
  return [
    header(result),
    ran ? section("What was simulated", overview.scene(result)) : null,
    ran
      ? section(
          "Tension",
          overview.verdict(result),
          result.states.length > 0 ? overview.tensions(result) : null,
        )
      : null,
    result.study ? study(result) : null,
    ...(ran ? sections.map((part) => part(result)) : []),
    result.scene_text ? section("The scene as run", h("pre", {}, result.scene_text)) : null,
    sources(result),
  ];
}

document.head.append(h("style", {}, css));
const data = JSON.parse(document.getElementById("data").textContent);
document.body.append(h("main", {}, page(readResult(data))));
