import * as Plot from "@observablehq/plot";
import { number, short } from "./format.js";

export const ebarAxis = {
  label: "ē = (L₀ − L)/D →",
  labelArrow: "none",
  reverse: true,
  labelAnchor: "center",
};
export const frame = {
  marginLeft: 56,
  marginRight: 64,
  marginBottom: 40,
  style: { fontSize: "12px" },
};
export const plot = (width, options) =>
  Plot.plot({ ...frame, width, height: Math.max(240, Math.min(360, 0.72 * width)), ...options });

const lineHeight = 13; // of a name at the end of a curve

export const drawn = (rows, y, log) =>
  rows.filter((row) => Number.isFinite(row[y]) && (!log || row[y] > 0));

/** Names at the ends of curves, [{rows, y, text, colour}], moved apart where they would overlap. */
function endLabels(curves) {
  const ends = curves
    .filter(({ rows }) => rows.length > 0)
    .map(({ rows, y, text, colour }) => ({
      ebar: rows.at(-1).ebar,
      value: rows.at(-1)[y],
      text,
      colour,
    }));
  const apart = (data, facets, channels, scales) => {
    const heights = Array.from(channels.y.value, scales.y);
    const order = heights.map((_, i) => i).sort((a, b) => heights[a] - heights[b]);
    order
      .slice(1)
      .forEach((i, k) => (heights[i] = Math.max(heights[i], heights[order[k]] + lineHeight)));
    return { data, facets, channels: { y: { value: heights } } };
  };
  const options = {
    x: "ebar",
    y: "value",
    text: "text",
    fill: "colour",
    textAnchor: "start",
    dx: 7,
    fontWeight: 600,
  };
  return Plot.text(ends, Plot.initializer(options, apart));
}

/** Curves against ebar, [{rows, y, text, colour, dash, measured}], named at their ends; dots where there are few
 *  rows, dots alone for what was measured. */
export function curves(list, { log = false, dots = true } = {}) {
  const there = list.map((of) => ({ ...of, rows: drawn(of.rows, of.y, log) }));
  return [
    there.map(({ rows, y, text, colour, dash, measured }) => [
      measured
        ? Plot.dot(rows, { x: "ebar", y, stroke: colour, r: 2.4, className: "measured" })
        : Plot.line(rows, {
            x: "ebar",
            y,
            stroke: colour,
            strokeWidth: 1.6,
            strokeDasharray: dash,
            className: "curve",
          }),
      measured
        ? Plot.ruleX(
            rows.filter((row) => row.spread > 0 && (!log || row[y] > row.spread)),
            {
              x: "ebar",
              y1: (row) => row[y] - row.spread,
              y2: (row) => row[y] + row.spread,
              stroke: colour,
              strokeOpacity: 0.5,
            },
          )
        : null,
      dots && !measured && rows.length < 80
        ? Plot.dot(rows, { x: "ebar", y, fill: colour, r: 1.8 })
        : null,
      Plot.tip(
        rows,
        Plot.pointer({
          x: "ebar",
          y,
          title: (row) => `${text}\nē = ${short(row.ebar)}\n${number(row[y], 4)}`,
        }),
      ),
    ]),
    endLabels(there),
  ];
}

/** 1, 2, 5 in every decade that is seen; 1 alone where there are many. */
export function decades([low, high]) {
  const first = Math.floor(Math.log10(low)),
    last = Math.ceil(Math.log10(high));
  const within = last - first > 3 ? [1] : [1, 2, 5];
  const ticks = [];
  for (let power = first; power <= last; ++power)
    ticks.push(...within.map((of) => of * 10 ** power));
  return ticks.filter((tick) => tick >= low && tick <= high);
}
