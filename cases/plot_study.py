#!/usr/bin/python3
"""Plots error against time of a study: every run, and the front of those that nothing beats.

    /usr/bin/python3 cases/plot_study.py results/overhand_study cases/figures/overhand_study.png
"""
import csv
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


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


def main(results, picture):
    with open(results / "study.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    study = json.loads((results / "study.json").read_text())
    cases = [case for case in study["cases"] if case["pareto_front"]]
    varied = {part.split("=")[0] for case in cases for part in case["problem"]} | {"fidelities"}
    figure, axes = plt.subplots(1, len(cases), figsize=(5 * len(cases), 4), squeeze=False)
    for each, case in zip(axes[0], cases):
        keys = [key for key in study["grid"] if key not in varied
                and not (case["fidelity"] == "rod" and key.startswith("solid3d."))]
        plot_case(each, case, rows, keys[0])
    axes[0][0].set_ylabel("largest error in T [%]")
    axes[0][-1].legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5))
    figure.savefig(picture, dpi=110, bbox_inches="tight")
    print(picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), sys.argv[2])
