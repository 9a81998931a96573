import * as Plot from "@observablehq/plot";
import { extent, max, min } from "d3";
import { colours, measuredColours } from "./colours.js";
import { curves, decades, ebarAxis, plot } from "./curves.js";
import { loosens } from "./result.js";

/** Tbar against ebar: fidelities, loose-knot law, measurements. */
export function force(result, log) {
  return (width) => {
    const simulated = result.fidelities.map((fidelity) => ({
      text: fidelity,
      colour: colours[fidelity],
      rows: result.rows[fidelity],
    }));
    const measured = result.measured.map((of, k) => ({
      measured: true,
      text: of.name,
      colour: measuredColours[k % measuredColours.length],
      rows: of.ebar.map((ebar, i) => ({
        ebar,
        force_normalised: of.force_normalised[i],
        spread: of.spread[i] ?? 0,
      })),
    }));
    const all = [...simulated, ...measured].flatMap((of) => of.rows);
    const values = all
      .map((row) => row.force_normalised)
      .filter((value) => Number.isFinite(value) && (!log || value > 0));
    const law = result.law.filter((row) => row.tightening != null);
    const top = (log ? 1.5 : 1.05) * max(values);
    const bottom = log
      ? 0.8 * Math.min(min(values), min(law, (row) => row.tightening) ?? Infinity)
      : Math.min(0, min(values));
    const below = (name) => law.filter((row) => row[name] <= top && (!log || row[name] > bottom));
    return plot(width, {
      x: ebarAxis,
      y: {
        label: `T̄ = T D²/(4B)${log ? ", logarithmic" : ""}`,
        type: log ? "log" : "linear",
        domain: [bottom, top],
        grid: true,
        ...(log ? { ticks: decades([bottom, top]), tickFormat: "~g" } : {}),
      },
      marks: [
        Plot.line(below("tightening"), {
          x: "ebar",
          y: "tightening",
          stroke: colours.law,
          strokeDasharray: "5,4",
        }),
        lawLabel(
          below("tightening"),
          (value) => (log ? Math.log(value / bottom) / Math.log(top / bottom) : value / top),
          extent(all, (row) => row.ebar),
        ),
        loosens(result)
          ? Plot.line(below("loosening"), {
              x: "ebar",
              y: "loosening",
              stroke: colours.law,
              strokeDasharray: "2,3",
            })
          : null,
        curves(
          [...simulated, ...measured].map((of) => ({ ...of, y: "force_normalised" })),
          { log },
        ),
      ],
    });
  };
}

/** Beside the law at a quarter of the height, where the law is steep: what lies right below it is free. */
function lawLabel(rows, height, [tight, loose]) {
  const quarter = rows.find((row) => height(row.tightening) >= 0.25);
  const steep = quarter?.ebar > tight + 0.1 * (loose - tight);
  const at = steep ? quarter : rows[Math.floor(0.5 * rows.length)];
  return Plot.text(at ? [at] : [], {
    x: "ebar",
    y: "tightening",
    text: () => "loose-knot law",
    fill: colours.law,
    textAnchor: "start",
    dx: 6,
    dy: steep ? 6 : 12,
  });
}

const colourOf = (name, measurement) =>
  colours[name] ?? measuredColours[measurement % measuredColours.length];

/** Relative difference of every curve from the first. */
export function difference(result) {
  const { names, rows } = result.comparison;
  return (width) =>
    plot(width, {
      x: ebarAxis,
      y: { label: `T̄ against ${names[0]} [%]`, grid: true },
      marks: [
        Plot.ruleY([0], { stroke: colours[names[0]] ?? "#000" }),
        curves(
          names.slice(1).map((name, k) => ({
            rows: rows.map((row) => ({
              ebar: row.ebar,
              percent: row.difference[k + 1] == null ? NaN : 100 * row.difference[k + 1],
            })),
            y: "percent",
            text: name,
            colour: colourOf(name, k + 1 - result.fidelities.length),
          })),
          { dots: false },
        ),
      ],
    });
}
