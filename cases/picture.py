#!/usr/bin/python3
"""Draws the knot of a results folder: the tied rod as a tube, the solid coloured by contact pressure,
and below it the contact pressure on the unrolled surface (undeformed arc length, angle).

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
from matplotlib.colors import PowerNorm
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

LIGHT = np.array([0.35, 0.55, 0.75]) / np.linalg.norm([0.35, 0.55, 0.75])
REACH = 7.5, 5.3  # what a panel shows about the knot's middle, along and across, in diameters
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
    return {"points": points.reshape(-1, 3), "quads": quads.reshape(-1, 4),
            "normal": normal.reshape(-1, 3), "diameter": 2 * radius}


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
    return {"points": points, "quads": quads, "normal": normal, "diameter": diameter,
            "pressure": point_field(mesh, "contact_pressure") / 1e3, "reference": reference / diameter}


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
    points, quads, diameter = shape["points"], shape["quads"], shape["diameter"]
    x = refined(points @ axis_of_view.T / diameter, quads).reshape(-1, 4, 3)
    n = refined(shape["normal"] @ axis_of_view.T, quads).reshape(-1, 4, 3).mean(axis=1)
    n /= np.linalg.norm(n, axis=1)[:, None]
    colour = np.tile([0.55, 0.68, 0.82], (len(x), 1))
    if "pressure" in shape:
        p = refined(shape["pressure"], quads).reshape(-1, 4).mean(axis=1)
        colour = plt.cm.YlOrRd(scale(p))[:, :3]
        colour[p <= 0] = [0.80, 0.84, 0.86]
    shade = 0.35 + 0.65 * np.clip(n @ LIGHT, 0, 1)
    order = np.argsort(x[:, :, 2].mean(axis=1))
    order = order[n[order, 2] > -0.05]
    faces = PolyCollection(x[order, :, :2], facecolors=np.clip(colour * shade[:, None], 0, 1)[order],
                           edgecolors="face", linewidths=0.3, antialiaseds=False)
    axes.add_collection(faces)
    off_axis = np.abs(points[:, :2] - points[0, :2]).max(axis=1)
    knot = points[off_axis > 0.5 * off_axis.max()] @ axis_of_view.T / diameter
    along = 0.5 * (knot[:, 0].min() + knot[:, 0].max())
    across = 0.5 * (x[:, :, 1].min() + x[:, :, 1].max())
    axes.set(xlim=(along - REACH[0], along + REACH[0]), ylim=(across - REACH[1], across + REACH[1]))
    axes.set_aspect("equal")
    axes.axis("off")


def draw_unrolled(axes, shape, scale, range_of_s):
    reference = shape["reference"]
    rim = np.linalg.norm(reference[:, :2], axis=1) > 0.45
    angle = np.degrees(np.arctan2(reference[rim, 1], reference[rim, 0]))
    around = np.concatenate([angle - 360, angle, angle + 360])
    axes.tripcolor(np.tile(reference[rim, 2], 3), around, np.tile(shape["pressure"][rim], 3),
                   cmap=plt.cm.YlOrRd, norm=scale, shading="gouraud")
    axes.set(xlim=range_of_s, ylim=(-180, 180), yticks=[-180, 0, 180], xlabel="s/D")
    axes.tick_params(labelsize=7)


def main(results, picture, wanted):
    shapes = [(f"rod, tied, ebar = {ebar:g}", rod_tube(file)) for ebar, file in states(results, "rod")[:1]]
    shapes += [(f"solid, ebar = {ebar:g}", solid_surface(file)) for ebar, file in states(results, "solid")
               if not wanted or ebar in wanted]
    solids = [shape for _, shape in shapes if "pressure" in shape]
    touching = [solid["pressure"] > 0 for solid in solids]
    loads = np.concatenate([solid["pressure"][touch] for solid, touch in zip(solids, touching)] or [[]])
    # Square root: the pressure of a loose knot is a hundredth of that of a tight one.
    scale = PowerNorm(0.5, 0, np.percentile(loads, 98) if len(loads) else 1, clip=True)
    touched = np.concatenate([solid["reference"][touch, 2] for solid, touch in zip(solids, touching)] or [[]])
    range_of_s = (touched.min() - 1, touched.max() + 1) if len(touched) else None

    columns = len(shapes)
    figure, panels = plt.subplots(2, columns, figsize=(3.4 * columns, 3.6), squeeze=False,
                                  height_ratios=[3, 1], layout="constrained")
    axis_of_view = view(shapes[0][1]["points"])
    for column, (title, shape) in enumerate(shapes):
        draw(panels[0, column], shape, axis_of_view, scale)
        panels[0, column].set_title(title, fontsize=10)
        if "pressure" in shape:
            draw_unrolled(panels[1, column], shape, scale, range_of_s)
        else:
            panels[1, column].axis("off")
    if solids:
        bar = plt.cm.ScalarMappable(scale, plt.cm.YlOrRd)
        figure.colorbar(bar, ax=panels, shrink=0.7, extend="max", label="contact pressure [kPa]",
                        ticks=plt.MaxNLocator(4))
    figure.savefig(picture, dpi=110)
    print(picture)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), sys.argv[2], [float(word) for word in sys.argv[3:]])
