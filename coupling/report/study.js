import * as Plot from "@observablehq/plot";
import { csvParseRows, extent } from "d3";
import { decades, plot } from "./curves.js";
import { figure, h, table } from "./dom.js";
import { number, percent, seconds } from "./format.js";

/** Rows as objects; csvParse would evaluate text, which the page's policy forbids. */
function parse(csv) {
  const [names, ...rows] = csvParseRows(csv);
  return rows.map((row) => Object.fromEntries(names.map((name, k) => [name, row[k]])));
}

/** Keys of the grid that make another problem; without study.json every run is of one problem. */
function read({ csv, json }) {
  const problems = (json?.cases ?? []).flatMap((of) => of.problem);
  const keys = [...new Set(problems.map((setting) => setting.split("=")[0]))];
  const all = parse(csv).map((row) => ({
    ...row,
    case: [row.fidelity, ...keys.map((key) => `${key}=${row[key]}`)].join(", "),
    seconds: Number(row.cpu_s) || Number(row.wall_s),
    error: row.error_force_largest === "" ? NaN : 100 * Number(row.error_force_largest),
  }));
  const rows = all.filter((row) => row.error > 0 && row.seconds > 0);
  return {
    all,
    rows,
    cases: [...new Set(all.map((row) => row.case))],
    front: rows.filter((row) => row.on_front === "1").sort((a, b) => a.seconds - b.seconds),
    sentences: (json?.cases ?? []).flatMap((of) => of.sentences ?? []),
  };
}

/** Error in T against time of a study's runs; the front is joined. */
function pareto(study) {
  const axis = (name) => ({
    type: "log",
    grid: true,
    tickFormat: "~g",
    ticks: decades(extent(study.rows, (row) => row[name])),
  });
  return (width) =>
    plot(width, {
      marginLeft: 64,
      marginRight: 24,
      height: 380,
      x: {
        ...axis("seconds"),
        label: "processor seconds",
        labelAnchor: "center",
        labelArrow: "none",
      },
      y: { ...axis("error"), label: "largest error in T [%]" },
      symbol: { legend: study.cases.length > 1, domain: study.cases },
      color: {
        domain: study.cases,
        range: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"],
      },
      marks: [
        Plot.line(study.front, {
          x: "seconds",
          y: "error",
          stroke: "case",
          z: "case",
          strokeWidth: 1.6,
          className: "curve",
        }),
        Plot.dot(study.rows, {
          x: "seconds",
          y: "error",
          stroke: "case",
          symbol: "case",
          r: 3,
          className: "runs",
        }),
        Plot.tip(
          study.rows,
          Plot.pointer({
            x: "seconds",
            y: "error",
            title: (row) =>
              `${row.run}\n${percent(row.error / 100, 2)} in ${number(row.seconds)} s`,
          }),
        ),
      ],
    });
}

/** What accuracy costs in time: the sentences of bight study, its plot, its runs. */
export function study(result) {
  const of = read(result.study);
  return h(
    "section",
    { id: "study" },
    h("h2", {}, "Accuracy against time"),
    of.sentences.map((sentence) => h("p", { class: "sentence" }, sentence)),
    figure(
      "pareto",
      "A mark a run, against the reference of its problem (not drawn: its error is its own uncertainty). Lines join the runs than which no other is both cheaper and better. [study.csv]",
      pareto(of),
    ),
    h(
      "details",
      {},
      h("summary", {}, `All ${of.all.length} rows`),
      table(
        ["run", "fidelity", "status", "error in T", "processor time", "unknowns", "iterations"],
        of.all.map((row) => [
          row.run,
          row.fidelity,
          row.reference === "1" ? "reference" : row.status,
          Number.isFinite(row.error) ? `${number(row.error)} %` : "–",
          seconds(row.seconds),
          row.unknowns,
          row.newton_iterations,
        ]),
      ),
    ),
  );
}
