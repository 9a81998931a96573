#!/usr/bin/python3
"""Draws the knot of a results folder: the tied rod as a tube, the solid coloured by contact pressure.

    /usr/bin/python3 cases/picture.py results/overhand cases/figures/overhand.png [EBAR ...]

With ebar values, only these states of the solid are drawn.
Needs python3-vtk9 (reading) and python3-matplotlib (drawing); no display, no graphics card.
"""
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

LIGHT = np.array([0.35, 0.55, 0.75]) / np.linalg.norm([0.35, 0.55, 0.75])
REACH = 11  # what a panel shows on each side of the knot, in diameters
CORNERS = 3  # every quadrilateral is drawn as CORNERS x CORNERS smaller ones, smoothly shaded


def states(results, fidelity):
    """Pairs (ebar, vtu file) in the order of the run."""
    pvd = results / fidelity / f"{fidelity}.pvd"
    if not pvd.exists():
        return []
    entries = re.findall(r'timestep="([^"]+)".*?file="([^"]+)"', pvd.read_text())
    return [(float(ebar), pvd.parent / file) for ebar, file in entries]


def read(file):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def point_field(grid, name):
    return vtk_to_numpy(grid.GetPointData().GetArray(name))


def rod_tube(file, sides=32):
    """Points, quadrilaterals and normals of the tube around the rod."""
    grid = read(file)
    x = vtk_to_numpy(grid.GetPoints().GetData())
    radius = point_field(grid, "radius")[0]
    angle = 2 * np.pi * np.arange(sides) / sides
    normal = (np.cos(angle)[None, :, None] * point_field(grid, "d1")[:, None, :]
              + np.sin(angle)[None, :, None] * point_field(grid, "d2")[:, None, :])
    points = x[:, None, :] + radius * normal
    i, j = np.meshgrid(np.arange(len(x) - 1), np.arange(sides), indexing="ij")
    k = (j + 1) % sides
    quads = np.stack([i * sides + j, i * sides + k, (i + 1) * sides + k, (i + 1) * sides + j], -1)
    return points.reshape(-1, 3), quads.reshape(-1, 4), normal.reshape(-1, 3), None, 2 * radius


def solid_surface(file):
    """The same of the solid's surface, and its contact pressure in kPa."""
    grid = read(file)
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputData(grid)
    surface.Update()
    mesh = surface.GetOutput()
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    quads = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 4)
    face = np.cross(points[quads[:, 2]] - points[quads[:, 0]], points[quads[:, 3]] - points[quads[:, 1]])
    normal = np.zeros_like(points)
    for corner in range(4):
        np.add.at(normal, quads[:, corner], face)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    reference = point_field(mesh, "reference")
    diameter = 2 * np.max(np.linalg.norm(reference[:, :2], axis=1))
    pressure = point_field(mesh, "contact_pressure") / 1e3
    return points, quads, normal, pressure, diameter


def view(points):
    """Pulling axis to the right, and the direction in which the knot is widest upwards."""
    across = points[:, :2] - points[:, :2].mean(axis=0)
    up = np.append(np.linalg.svd(across, full_matrices=False)[2][0], 0)
    right = np.array([0.0, 0.0, 1.0])
    return np.stack([right, up, np.cross(right, up)])


def refined(values, quads):
    """Bilinear values at the corners of the smaller quadrilaterals: (quads, smaller, 4, ...)."""
    t = np.linspace(0, 1, CORNERS + 1)
    u, v = np.meshgrid(t, t, indexing="ij")
    weights = np.stack([(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v], -1)
    small = np.stack([weights[:-1, :-1], weights[1:, :-1], weights[1:, 1:], weights[:-1, 1:]], 2)
    small = small.reshape(CORNERS * CORNERS, 4, 4)
    return np.einsum("sck,qk...->qsc...", small, values[quads])


def draw(axes, shape, axis_of_view, scale):
    points, quads, normal, pressure, diameter = shape
    x = refined(points @ axis_of_view.T / diameter, quads).reshape(-1, 4, 3)
    n = refined(normal @ axis_of_view.T, quads).reshape(-1, 4, 3).mean(axis=1)
    n /= np.linalg.norm(n, axis=1)[:, None]
    if pressure is None:
        colour = np.tile([0.55, 0.68, 0.82], (len(x), 1))
    else:
        p = refined(pressure, quads).reshape(-1, 4).mean(axis=1)
        colour = plt.cm.YlOrRd(0.08 + 0.92 * np.clip(p / scale, 0, 1))[:, :3]
        colour[p <= 0] = [0.80, 0.84, 0.86]
    shade = 0.35 + 0.65 * np.clip(n @ LIGHT, 0, 1)
    order = np.argsort(x[:, :, 2].mean(axis=1))
    order = order[n[order, 2] > -0.05]
    faces = PolyCollection(x[order, :, :2], facecolors=np.clip(colour * shade[:, None], 0, 1)[order],
                           edgecolors="face", linewidths=0.3, antialiaseds=False)
    axes.add_collection(faces)
    bent = np.abs(points[:, :2] - points[0, :2]).max(axis=1) > 1.5 * diameter  # off the pulling axis
    middle = points[bent if bent.any() else slice(None)] @ axis_of_view.T / diameter
    axes.set_xlim(middle[:, 0].mean() - REACH, middle[:, 0].mean() + REACH)
    low, high = x[:, :, 1].min(), x[:, :, 1].max()
    axes.set_ylim(0.5 * (low + high) - 0.48 * REACH, 0.5 * (low + high) + 0.48 * REACH)
    axes.set_aspect("equal")
    axes.axis("off")


def main(results, picture, wanted):
    ebar, file = states(results, "rod")[0]
    shapes = [(f"rod, tied, ebar = {ebar:g}", rod_tube(file))]
    shapes += [(f"solid, ebar = {ebar:g}", solid_surface(file)) for ebar, file in states(results, "solid")
               if not wanted or ebar in wanted]
    scale = max([s[3].max() for _, s in shapes if s[3] is not None], default=1) or 1
    columns = min(3, len(shapes))
    rows = -(-len(shapes) // columns)
    figure, panels = plt.subplots(rows, columns, figsize=(4.4 * columns, 2.4 * rows), squeeze=False)
    axis_of_view = view(shapes[0][1][0])
    for panel in panels.flat:
        panel.axis("off")
    for panel, (title, shape) in zip(panels.flat, shapes):
        draw(panel, shape, axis_of_view, scale)
        panel.set_title(title, fontsize=10)
    if len(shapes) > 1:
        bar = plt.cm.ScalarMappable(plt.Normalize(0, scale), plt.cm.YlOrRd)
        figure.colorbar(bar, ax=panels, shrink=0.6, label="contact pressure [kPa]")
    figure.savefig(picture, dpi=110, bbox_inches="tight")
    print(picture)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), sys.argv[2], [float(word) for word in sys.argv[3:]])
