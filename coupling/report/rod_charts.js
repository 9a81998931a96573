import * as Plot from "@observablehq/plot";
import { interpolateViridis, max } from "d3";
import { colours } from "./colours.js";
import { frame, plot } from "./curves.js";
import { number } from "./format.js";

/** kappa D along the rod at one state, the knot's middle at 0. */
export function curvature(result, state, limits) {
  return (width) =>
    Plot.plot({
      ...frame,
      width,
      height: 190,
      marginLeft: 36,
      marginRight: 12,
      marginTop: 22,
      marginBottom: 34,
      x: {
        label: "(s − s₀)/D",
        labelAnchor: "center",
        labelArrow: "none",
        domain: [-limits.reach, limits.reach],
        ticks: 5,
      },
      y: { label: "κD", domain: [0, limits.kappa], grid: true, ticks: 4 },
      marks: Object.entries(state.lines).map(([fidelity, line]) => {
        const points = Array.from(line.s, (s, i) => ({
          s: s - line.middle,
          kappa: line.kappa[i],
        })).filter(({ s }) => Math.abs(s) <= limits.reach);
        return [
          Plot.line(points, {
            x: "s",
            y: "kappa",
            stroke: colours[fidelity],
            strokeWidth: 1.4,
            className: "curve",
          }),
          Plot.tip(
            points,
            Plot.pointerX({
              x: "s",
              y: "kappa",
              title: (p) => `${fidelity}\nκD = ${number(p.kappa, 4)}`,
            }),
          ),
        ];
      }),
    });
}

/** Where the rod touches itself at one state: a pair of places each, the larger the more force. */
export function contacts(state, limits) {
  const { s_a, s_b, force_normalised } = state.contacts;
  const { middle } = state.lines.rod;
  const pairs = Array.from(s_a, (a, i) => ({
    a: a - middle,
    b: s_b[i] - middle,
    force: force_normalised[i],
  }));
  const axis = (label) => ({ label, domain: [-limits.reach, limits.reach], ticks: 5 });
  return (width) =>
    Plot.plot({
      ...frame,
      width,
      height: width,
      marginLeft: 36,
      marginRight: 12,
      marginTop: 22,
      marginBottom: 34,
      grid: true,
      x: { ...axis("(s − s₀)/D of one strand"), labelAnchor: "center", labelArrow: "none" },
      y: axis("of the other"),
      r: { domain: [0, limits.force], range: [0.6, 7] },
      marks: [
        Plot.line(
          [
            [-limits.reach, -limits.reach],
            [limits.reach, limits.reach],
          ],
          { stroke: "#bbb" },
        ),
        Plot.dot(pairs, {
          x: "a",
          y: "b",
          r: "force",
          fill: colours.rod,
          fillOpacity: 0.35,
          className: "pairs",
        }),
        Plot.tip(
          pairs,
          Plot.pointer({ x: "a", y: "b", title: (p) => `force F D²/(4B) = ${number(p.force)}` }),
        ),
      ],
    });
}

/** A column of the centerline files at every state, coloured by ebar. */
export function profiles(result, fidelity, column, text, factor) {
  return (width) => {
    const points = result.states.flatMap((state) => {
      const line = state.lines[fidelity];
      if (!line?.[column]) return [];
      return Array.from(line.s, (s, i) => ({
        name: state.name,
        ebar: state.ebar,
        s: s - line.middle,
        value: factor * line[column][i],
      }));
    });
    const largest = max(points, (p) => Math.abs(p.value));
    const reach =
      1.1 *
      Math.max(
        1,
        max(points, (p) => (Math.abs(p.value) > 0.01 * largest ? Math.abs(p.s) : 0)),
      );
    return plot(width, {
      marginRight: 20,
      color: {
        type: "linear",
        interpolate: (t) => interpolateViridis(0.9 * t),
        reverse: false,
        legend: true,
        label: "ē",
        marginLeft: 12,
        width: Math.min(240, width),
      },
      x: {
        label: "(s − s₀)/D",
        labelAnchor: "center",
        labelArrow: "none",
        domain: [-reach, reach],
      },
      y: { label: text, grid: true },
      marks: [
        Plot.line(
          points.filter((p) => Math.abs(p.s) <= reach),
          { x: "s", y: "value", z: "name", stroke: "ebar", strokeWidth: 1.3, className: "curve" },
        ),
      ],
    });
  };
}
