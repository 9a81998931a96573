import { colours } from "./colours.js";
import { h } from "./dom.js";

/** natural_curvature: natural curvature. */
export const words = (name) => name.replaceAll("_", " ");

export const commas = (items) => items.join(", ");

/** "rod" or "solid" in its colour. */
export const fidelityName = (fidelity) =>
  h("b", { style: `color: ${colours[fidelity]}` }, fidelity);
