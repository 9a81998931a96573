#!/usr/bin/python3
"""Plots the force curves of a results folder and the loose-knot law.

    /usr/bin/python3 cases/plot_force.py results/overhand cases/figures/overhand_force.png
"""
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def main(results, picture):
    table = np.genfromtxt(results / "compare.csv", delimiter=",", names=True)
    figure, (force, apart) = plt.subplots(1, 2, figsize=(10, 4))
    for name, style in [("rod", "C0-"), ("solid", "C3-"), ("loose_knot_law", "k--")]:
        if name in table.dtype.names:
            there = np.isfinite(table[name])
            force.semilogy(table["ebar"][there], table[name][there], style, label=name.replace("_", " "))
    force.invert_xaxis()
    force.set_ylim(top=2 * np.nanmax(table["rod"] if "rod" in table.dtype.names else table["solid"]))
    force.set(xlabel="ebar = (L0 - L)/D", ylabel="T D$^2$/(4B)")
    force.legend(frameon=False)
    if "solid_difference" in table.dtype.names:
        there = np.isfinite(table["solid_difference"])
        apart.plot(table["ebar"][there], 100 * table["solid_difference"][there], "C3-")
        apart.invert_xaxis()
        apart.set(xlabel="ebar", ylabel="solid against rod [%]")
        apart.axhline(0, color="k", linewidth=0.5)
    figure.savefig(picture, dpi=110, bbox_inches="tight")
    print(picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), sys.argv[2])
