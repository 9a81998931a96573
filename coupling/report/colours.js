import { interpolateCividis, interpolatePuOr, interpolateYlOrRd } from "d3";

/** Of fidelities and references; Okabe and Ito's palette, told apart by colour-blind eyes. */
export const colours = { rod: "#0072b2", solid: "#d55e00", law: "#555555" };
export const measuredColours = ["#009e73", "#cc79a7", "#000000"];
export const names = { rod: "rod", solid: "solid" };

/**
 * A field on a surface: how it is called, its unit, how the file's numbers become that unit, and a
 * scale: "level" from the smallest to the largest value, "contact" from zero (grey) on, "about" a
 * neutral value, which is white.
 */
export function fieldsOf(result) {
  const linear = (result.youngsModulus ?? NaN) * (result.diameter ?? NaN);
  return {
    rod: {
      kappa: { label: "curvature κD", scale: "level", factor: 1 },
      contact_force: { label: "contact force [N/m]", scale: "contact", factor: linear },
      twist: { label: "twist per length [rad/D]", scale: "about", neutral: 0, factor: 1 },
    },
    solid: {
      contact_pressure: { label: "contact pressure [kPa]", scale: "contact", factor: 1e-3 },
      von_mises: { label: "von Mises stress [kPa]", scale: "level", factor: 1e-3 },
      J: { label: "volume ratio J", scale: "about", neutral: 1, factor: 1 },
      pressure: {
        label: "mean stress, tension > 0 [kPa]",
        scale: "about",
        neutral: 0,
        factor: 1e-3,
      },
    },
  };
}

/** Ends of the colour scale of a field, from the arrays in which it is drawn. */
export function domain(field, arrays) {
  let low = Infinity,
    high = -Infinity;
  for (const array of arrays)
    for (const value of array) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  [low, high] = [low * field.factor, high * field.factor];
  if (field.scale === "contact") return [0, Math.max(high, 1e-300)];
  if (field.scale === "level") return [low, high > low ? high : low + 1];
  const half = Math.max(Math.abs(high - field.neutral), Math.abs(low - field.neutral), 1e-9);
  return [field.neutral - half, field.neutral + half];
}

/** CSS colour at t in 0 ... 1. */
export function colourAt(field, t) {
  if (field.scale === "contact")
    return t <= 0.002 ? "rgb(214, 216, 218)" : interpolateYlOrRd(0.12 + 0.88 * t);
  return field.scale === "level" ? interpolateCividis(t) : interpolatePuOr(1 - t);
}
