import * as Plot from "@observablehq/plot";
import { extent } from "d3";
import { colours } from "./colours.js";
import { curves, decades, drawn, ebarAxis, plot } from "./curves.js";
import { number, short } from "./format.js";

/** Stored energy, and what was lost since the first row. */
export function energy(result) {
  return (width) =>
    plot(width, {
      x: ebarAxis,
      y: { label: "energy [mJ]", grid: true },
      marginRight: 110,
      marks: curves(
        result.fidelities.flatMap((fidelity) => {
          const rows = result.balance[fidelity],
            colour = colours[fidelity];
          const stored = { rows, y: "stored", text: `${fidelity}, stored`, colour };
          const lost = { rows, y: "lost", text: `${fidelity}, lost`, colour, dash: "4,3" };
          return rows.some((row) => row.lost > 0) ? [stored, lost] : [stored];
        }),
      ),
    });
}

/** One number a step, a dot each. */
export function health(result, column, text, { log = false, factor = 1 } = {}) {
  return (width) => {
    const rows = result.fidelities.flatMap((fidelity) =>
      result.rows[fidelity].map((row) => ({
        fidelity,
        ebar: row.ebar,
        value: factor * row[column],
        cut: row.cutbacks > 0,
      })),
    );
    const there = drawn(rows, "value", log);
    return plot(width, {
      height: 220,
      marginRight: 20,
      x: ebarAxis,
      y: {
        label: text,
        type: log ? "log" : "linear",
        grid: true,
        zero: !log,
        ...(log ? { ticks: decades(extent(there, (row) => row.value)), tickFormat: ".0e" } : {}),
      },
      marks: [
        Plot.dot(there, {
          x: "ebar",
          y: "value",
          fill: (row) => colours[row.fidelity],
          r: 2,
          className: "steps",
        }),
        Plot.dot(
          there.filter((row) => row.cut),
          { x: "ebar", y: "value", stroke: "#000", r: 5 },
        ),
        Plot.tip(
          there,
          Plot.pointer({
            x: "ebar",
            y: "value",
            title: (row) => `${row.fidelity}\nē = ${short(row.ebar)}\n${number(row.value)}`,
          }),
        ),
      ],
    });
  };
}
