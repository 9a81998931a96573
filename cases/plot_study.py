#!/usr/bin/python3
"""Plots error against time of a study: every run, and the front of those that nothing beats. Where rod and solid were
both run, a second row shows what each costs against one and the same reference, that of the solid.

    /usr/bin/python3 cases/plot_study.py results/overhand_study cases/figures/overhand_study.png
"""
import csv
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter


def seconds(row):
    return float(row["cpu_s"]) or float(row["wall_s"])


def plot_case(axes, case, rows, key):
    """Runs of one problem and fidelity, coloured by the first key of the grid that makes runs finer."""
    ours = [row for row in rows if row["fidelity"] == case["fidelity"] and row["error_force_largest"]
            and row["status"] == "finished"
            and all(row[name] == value for name, value in (s.split("=", 1) for s in case["problem"]))]
    values = sorted({row[key] for row in ours}, key=float)
    for number, value in enumerate(values):
        dots = [row for row in ours if row[key] == value and float(row["error_force_largest"]) > 0]
        axes.loglog([seconds(row) for row in dots], [100 * float(row["error_force_largest"]) for row in dots],
                    "o", color=plt.cm.viridis(number / len(values)), label=f"{key.split('.')[-1]} {value}")
    front = case["pareto_front"]
    axes.step([run["seconds"] for run in front], [100 * run["error_force_largest"] for run in front],
              "k-", where="post", linewidth=1, label="front")
    if "reference" in case:
        axes.axhspan(1e-9, 100 * case["reference"]["uncertainty_force"], color="0.9", zorder=0)
    shown = [100 * float(row["error_force_largest"]) for row in ours if float(row["error_force_largest"]) > 0]
    axes.set_ylim(min(shown) / 2, max(shown) * 2)
    axes.set_title(", ".join([case["fidelity"]] + case["problem"]), fontsize=10)
    axes.set_xlabel("seconds of one processor")


def percents(axes):
    """Ticks that can be read on axes of a decade or two."""
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter(FormatStrFormatter("%g"))
    axes.yaxis.set_minor_formatter(NullFormatter())


def plot_fidelities(axes, problem, rows, states):
    """Largest difference in T from the solid's reference down to some ebar, of rods and solids."""
    ours = [state for state in states if state["error_force_solid"]
            and all(state[name] == value for name, value in (s.split("=", 1) for s in problem))]
    levels = sorted({float(state["ebar"]) for state in ours}, reverse=True)
    cost = {(row["run"], row["fidelity"]): seconds(row) for row in rows if row["status"] == "finished"}
    for number, level in enumerate(levels):
        for fidelity, mark in (("rod", "s"), ("solid", "o")):
            worst = {}
            for state in ours:
                run = (state["run"], state["fidelity"])
                if state["fidelity"] == fidelity and float(state["ebar"]) >= level and run in cost:
                    worst[run] = max(worst.get(run, 0), 100 * abs(float(state["error_force_solid"])))
            dots = sorted((cost[run], error) for run, error in worst.items() if error > 0)
            axes.loglog([dot[0] for dot in dots], [dot[1] for dot in dots], mark, markersize=5,
                        color=plt.cm.plasma(number / len(levels)),
                        label=f"{fidelity}, down to ebar {level:g}" if number in (0, len(levels) - 1) else None)
    axes.set_title(", ".join(["against the solid's reference"] + problem), fontsize=10)
    axes.set_xlabel("seconds of one processor")


def main(results, picture):
    with open(results / "study.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    study = json.loads((results / "study.json").read_text())
    cases = [case for case in study["cases"] if case["pareto_front"]]
    varied = {part.split("=")[0] for case in cases for part in case["problem"]} | {"fidelities"}
    with open(results / "study_states.csv", newline="") as file:
        states = list(csv.DictReader(file))
    both = [case for case in study["cases"] if case.get("from_solid")]
    columns = max(len(cases), len(both))
    figure, axes = plt.subplots(2 if both else 1, columns, figsize=(4.5 * columns, 8 if both else 4), squeeze=False,
                                layout="constrained")
    for each in axes.flat[len(cases):]:
        each.set_axis_off()
    for each, case in zip(axes[0], cases):
        keys = [key for key in study["grid"] if key not in varied
                and not (case["fidelity"] == "rod" and key.startswith("solid3d."))]
        plot_case(each, case, rows, keys[0])
        each.legend(frameon=False, fontsize=8)
    for each, case in zip(axes[1] if both else [], both):
        each.set_axis_on()
        plot_fidelities(each, case["problem"], rows, states)
        each.legend(frameon=False, fontsize=8)
    for row in axes:
        row[0].set_ylabel("largest error in T [%]")
        for each in row:
            percents(each)
    figure.savefig(picture, dpi=110)
    print(picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), sys.argv[2])
