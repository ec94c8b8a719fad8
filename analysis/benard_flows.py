# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Convection, by particles or on a grid, as pictures have it: read from point files, drawn as arrows and contours.

For scripts that have found numpy, matplotlib and h5py already.
"""

import math

import h5py
import matplotlib
import matplotlib.colors
import matplotlib.ticker
import matplotlib.tri
import numpy as np

from lucy_tables import COLOURS, TIME_UNIT, fail, numbers, read_rows

FLUIDS = {"ideal-gas": "ideal gas", "van-der-waals": "van der Waals", "dense-fluid": "dense fluid"}
WORDS = ("equation_of_state", "side", "status")
NUMBERS = ("height", "width", "hot", "cold", "gravity", "rayleigh", "viscosity", "conductivity")

ENERGY_LABEL = r"kinetic energy per mass  [$\epsilon/m$]"
TIME_LABEL = f"time  [{TIME_UNIT}]"


def palette(name):
    """Light, but not white, at one end, for black lines on it; of one hue, so that everyone can read it."""
    return matplotlib.colors.ListedColormap(matplotlib.colormaps[name](np.linspace(0.12, 0.9, 256)), f"{name}_part")


FIELDS = (("density", r"density $\rho$  [$m/\sigma^2$]", palette("GnBu")),
          ("temperature", r"temperature $kT$  [$\epsilon$]", palette("OrRd")))
ENERGIES = (("kinetic_energy_total", "total", COLOURS[0]), ("kinetic_energy_smoothed", "smoothed", COLOURS[1]))
CONTOURS = 20  # at most
ARROWS = 32  # along the longer edge
DOT = 260  # points: a little less than a panel is wide, so that dots nearly touch


def read_table(path, number_columns, word_columns):
    return [numbers(path, line, number_columns) | {name: line[name] for name in word_columns}
            for line in read_rows(path, number_columns + word_columns)]


def point_path(directory, index):
    return directory / f"point_{index + 1:03d}.h5"


def close(one, other):
    return math.isclose(one, other, rel_tol=1e-9)


def same_cell(one, other):
    """Rows of one fluid in cells that a continuum cannot tell apart: it has no length of its own."""
    return (one["equation_of_state"] == other["equation_of_state"] and one["side"] == other["side"]
            and all(close(one[name], other[name]) for name in ("hot", "cold"))
            and close(one["width"] / one["height"], other["width"] / other["height"]))


def same_convection(one, other):
    """One problem of a continuum."""
    return (same_cell(one, other) and close(one["gravity"] * one["height"], other["gravity"] * other["height"])
            and all(close(one[name] / one["height"], other[name] / other["height"])
                    for name in ("viscosity", "conductivity")))


def rayleigh_text(row):
    if math.isfinite(row["rayleigh"]):
        return f"Ra = {row['rayleigh']:.5g}"
    return rf"$\eta$ = {row['viscosity']:.3g}, $k$ = {row['conductivity']:.3g}"


def fluid_text(row):
    return FLUIDS.get(row["equation_of_state"], row["equation_of_state"])


def plain(text):
    """For the terminal."""
    return text.replace(r"$\eta$", "eta").replace("$", "")


def particles_text(row, others=()):
    """What particles these are, of all settings that are unusual or in which `others` differ."""
    text = f"$N$ = {row['particles']:g}"
    if row["kernel"] != "lucy" or len({other["kernel"] for other in others}) > 1:
        text += f", {row['kernel'].capitalize()}'s weight"
    if row["range"] != 3 or len({other["range"] for other in others}) > 1:
        text += f", $h$ = {row['range']:g}"
    if row["wall"] != "mirror-images" or len({other["wall"] for other in others}) > 1:
        text += f", {row['wall'].replace('-', ' ')}"
    return text


def read_group(group):
    return {name: item[...] for name, item in group.items() if isinstance(item, h5py.Dataset)}


def read_series(file, name):
    """(times, values) of the first replica; nothing when there are none."""
    for folder in ("observables/replica_01", "observables/replica_01/instants"):
        if f"{folder}/{name}" in file:
            element = file[f"{folder}/{name}"]
            if len(element["value"]) > 0:
                return element["time"][...], element["value"][...]
    return None


def read_particle_point(path):
    """Of a point file of `lucy benard`: "flow", the averages on a grid, and "last", the particles, each None where
    there is none; "series" by name, from the start of the run on."""
    try:
        with h5py.File(path, "r") as file:
            point = {"flow": None, "last": None, "series": {}}
            if "fields" in file:
                point["flow"] = read_group(file["fields"]) | read_group(file["grid"])
                point["flow"] |= {name: float(file["fields"].attrs[name]) for name in ("time_from", "time_to")}
            if "last" in file:
                point["last"] = read_group(file["last"]) | {"time": float(file["last"].attrs["time"])}
            for name, _, _ in ENERGIES:
                series = read_series(file, name)
                if series is not None:
                    point["series"][name] = series
            return point
    except (OSError, KeyError) as error:
        fail(f"cannot read {path}: {error}")


def read_grid_point(path):
    """Of a point file of `lucy benard-grid`: the flow, and its history."""
    try:
        with h5py.File(path, "r") as file:
            return read_group(file["fields"]) | read_group(file["grid"]), read_group(file["history"])
    except (OSError, KeyError) as error:
        fail(f"cannot read {path}: {error}")


def levels_of(*fields):
    """Round numbers, a contour each, from below the least value to above the largest one; None when there is nothing
    to tell apart. Cells that no particle ever reached have no value (nan)."""
    low, high = min(float(np.nanmin(field)) for field in fields), max(float(np.nanmax(field)) for field in fields)
    if not high - low > 1e-9 * max(abs(low), abs(high)):
        return None
    return matplotlib.ticker.MaxNLocator(CONTOURS, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)


def bare_cell(axes, row):
    """The cell, to scale."""
    axes.set(xlim=(-row["width"] / 2, row["width"] / 2), ylim=(-row["height"] / 2, row["height"] / 2), aspect="equal")
    axes.tick_params(length=2.5, labelsize=8)


def round_the_sides(flow, row, name):
    """A field with its coordinates; where sides are periodic it goes on to both edges."""
    x, field = flow["x"], flow[name]
    if row["side"] == "periodic" and len(x) > 1:
        x = np.concatenate(([x[-1] - row["width"]], x, [x[0] + row["width"]]))
        field = np.concatenate((field[:, -1:], field, field[:, :1]), axis=1)
    return x, flow["y"], field


def draw_field(axes, flow, row, name, colours, levels):
    """Contours and colours between them; what the colour bar needs."""
    x, y, field = round_the_sides(flow, row, name)
    if levels is None:
        drawn = axes.pcolormesh(x, y, field, cmap=colours, shading="nearest", rasterized=True)
    else:
        drawn = axes.contourf(x, y, field, levels, cmap=colours, extend="both")
        axes.contour(x, y, field, levels[1:-1], colors="black", linewidths=0.5)
    bare_cell(axes, row)
    return drawn


def draw_particles(axes, last, row, name, colours, levels):
    """Every particle in its colour, and every second contour, through all of them: at one moment they are rough."""
    x, y = last["position"][:, 0], last["position"][:, 1]
    norm = None if levels is None else matplotlib.colors.BoundaryNorm(levels, colours.N, extend="both")
    spacing = math.sqrt(row["width"] * row["height"] / len(x)) / row["width"]  # of the width of the panel
    drawn = axes.scatter(x, y, s=(DOT * spacing) ** 2, c=last[name], cmap=colours, norm=norm, linewidths=0,
                         rasterized=True)
    crossed = [] if levels is None else [one for one in levels[1:-1:2] if last[name].min() < one < last[name].max()]
    if crossed:
        try:
            mesh = matplotlib.tri.Triangulation(x, y)
            mesh.set_mask(matplotlib.tri.TriAnalyzer(mesh).get_flat_tri_mask(0.05))
            axes.tricontour(mesh, last[name], crossed, colors="black", linewidths=0.4)
        except (RuntimeError, ValueError):
            pass  # particles on top of each other have no triangles between them: their colours have to do
    bare_cell(axes, row)
    return drawn


def draw_arrows(axes, x, y, vx, vy, row, spacing):
    """Returns the largest speed, which the longest arrow has."""
    fastest = float(np.nanmax(np.hypot(vx, vy)))
    if fastest > 0:
        axes.quiver(x, y, vx, vy, scale=fastest / (1.6 * spacing), scale_units="xy", angles="xy", pivot="mid",
                    color="black", width=0.0022, headwidth=4.5, headlength=5, headaxislength=4.5)
    bare_cell(axes, row)
    return fastest


def draw_grid_arrows(axes, flow, row):
    x, y = flow["x"], flow["y"]
    every = max(1, round(max(len(x), len(y)) / ARROWS))
    across, up = slice(every // 2, None, every), slice(every // 2, None, every)
    return draw_arrows(axes, x[across], y[up], flow["velocity_x"][up, across], flow["velocity_y"][up, across], row,
                       every * row["width"] / len(x))


def draw_particle_arrows(axes, last, row, name="velocity_smoothed"):
    """Of the particle nearest to the centre of each square of a mesh."""
    spacing = max(row["width"], row["height"]) / ARROWS
    squares = np.floor(last["position"] / spacing).astype(int)
    distance = np.hypot(*(last["position"] / spacing - squares - 0.5).T)
    order = np.lexsort((distance, squares[:, 1], squares[:, 0]))
    _, first = np.unique(squares[order], axis=0, return_index=True)
    chosen = order[first]
    return draw_arrows(axes, *last["position"][chosen].T, *last[name][chosen].T, row, spacing)


def draw_window(axes, flow):
    """What was averaged over."""
    axes.axvspan(flow["time_from"], flow["time_to"], color="0.9", linewidth=0, zorder=0)


def draw_energies(axes, point, row):
    """Of particles against time; lines where a mean was taken."""
    for name, label, colour in ENERGIES:
        if name in point["series"]:
            axes.plot(*point["series"][name], color=colour, linewidth=0.7, label=label)
    if point["flow"] is not None:
        draw_window(axes, point["flow"])
        if math.isfinite(row["kinetic_energy_field"]):
            axes.plot([point["flow"]["time_from"], point["flow"]["time_to"]], [row["kinetic_energy_field"]] * 2,
                      color=COLOURS[2], linewidth=1.2, label="of the averaged flow")
    ends = [times[-1] for times, _ in point["series"].values()]
    if ends:
        axes.set_xlim(0, max(ends))
    axes.set_ylim(bottom=0)
    axes.set_xlabel(TIME_LABEL)
