#!/usr/bin/python3
"""Plots the force curves of a results folder, or of all its cases, and by how much rod and solid of equal
friction differ, with what the rod estimated of that itself.

    /usr/bin/python3 cases/plot_force.py results/overhand cases/figures/overhand_force.png
    /usr/bin/python3 cases/plot_force.py results/tight cases/figures/paper_tight.png
"""
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def table(file):
    rows = np.atleast_1d(np.genfromtxt(file, delimiter=",", names=True))
    return rows[np.argsort(rows["ebar"], kind="stable")]


def main(results, picture):
    figure, (force, apart) = plt.subplots(1, 2, figsize=(10, 4))
    curves = {}
    for summary in sorted([*results.glob("summary.json"), *results.glob("*/summary.json")]):
        mu = json.loads(summary.read_text())["friction"]
        for fidelity in ("rod", "solid"):
            if (summary.parent / fidelity / "force.csv").exists():
                curves.setdefault(mu, {})[fidelity] = summary.parent / fidelity
    ebar = np.linspace(2, 30, 200)
    force.semilogy(ebar, np.pi**2 / (2 * ebar**2), "k:", label="loose-knot law, mu = 0")
    for k, (mu, folders) in enumerate(sorted(curves.items())):
        for fidelity, folder in folders.items():
            rows = table(folder / "force.csv")
            force.semilogy(rows["ebar"], rows["force_normalised"], f"C{k}" + ("--" if fidelity == "rod" else "-"),
                           label=f"{fidelity}, mu = {mu:g}")
        if len(folders) < 2:
            continue
        rod, solid = table(folders["rod"] / "force.csv"), table(folders["solid"] / "force.csv")
        at = solid["ebar"][(solid["ebar"] >= rod["ebar"][0]) & (solid["ebar"] <= rod["ebar"][-1])]
        of_rod = np.interp(at, rod["ebar"], rod["force_normalised"])
        of_solid = np.interp(at, solid["ebar"], solid["force_normalised"])
        apart.plot(at, 100 * (1 - of_solid / of_rod), f"C{k}-", label=f"found, mu = {mu:g}")
        own = table(folders["rod"] / "validity.csv")
        apart.plot(own["ebar"], 100 * own["estimated_error"], f"C{k}:", label="estimated by the rod alone")
    force.set(xlabel="ebar = (L0 - L)/D", ylabel="T D$^2$/(4B)")
    apart.set(xlabel="ebar", ylabel="tension of the rod above that of the solid [%]", ylim=(0, 60))
    for axes in (force, apart):
        axes.invert_xaxis()
        axes.legend(frameon=False, fontsize=8)
    figure.savefig(picture, dpi=110, bbox_inches="tight")
    print(picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), sys.argv[2])
