#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Convection by smooth particles beside that of the continuum, in the manner of Kum, Hoover and Posch (1995).

    plot_benard_compare.py DIR... [--out DIR] [--published FILE]

DIR are directories of `lucy benard` and of `lucy benard-grid`, in any order. Into --out (without it, the first one with
particles) go, each as far as there is something to show,

    benard_compare_fields_001.png ...   (Fig. 9) of each fluid of particles that the grid has too: density above,
                                        temperature below, continuum left, particles right, the same contours
    benard_compare_time.png             (Fig. 8) kinetic energies of these against time
    benard_compare.png                  (Figs. 5 and 6) kinetic energies against Ra^(-1/2), a panel for each fluid and
                                        cell, with the grid's straight line to where convection begins

and the same as .svg. A flow on the grid is that of particles of the same fluid, sides, temperatures and, in units of
the height, width, gravity, viscosity and conductivity: its lengths and times are scaled to the particles' height.
"""

import argparse
import math
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import h5py  # noqa: F401  (for benard_flows)
    import matplotlib.pyplot as plt
    import matplotlib.ticker
    import numpy as np
except ImportError as missing:
    sys.exit(f"plot_benard_compare.py needs numpy, matplotlib and h5py (Debian: python3-matplotlib, python3-h5py): "
             f"{missing}")

import lucy_tables
from benard_flows import (ENERGIES, ENERGY_LABEL, FIELDS, FLUIDS, NUMBERS, WORDS, close, draw_energies, draw_field,
                          fluid_text, levels_of, particles_text, plain, point_path, rayleigh_text, read_grid_point,
                          read_particle_point, read_table, same_cell, same_convection)
from lucy_tables import COLOURS, REFERENCE, fail

PARTICLES, GRID = "benard.csv", "benard_grid.csv"
STEM = "benard_compare"
MOST_ACROSS = 3  # panels
THREE = (*ENERGIES, ("kinetic_energy_field", "of the averaged flow", COLOURS[2]))
PARTICLE_NUMBERS = (*NUMBERS, "particles", "range", *(name + end for name, _, _ in THREE for end in ("", "_error")))
PARTICLE_WORDS = (*WORDS, "kernel", "wall")
LIMIT_WORDS = ("equation_of_state", "transport", "side")
LIMIT_NUMBERS = ("height", "width", "hot", "cold", "rayleigh", "viscosity", "conductivity", "kinetic_energy")
ROUND_RAYLEIGH = (1000, 1500, 2000, 3000, 5000, 7000, 10000, 20000, 40000, 100000)
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")


def read_particles(directory):
    rows = read_table(directory / PARTICLES, PARTICLE_NUMBERS, PARTICLE_WORDS)
    return [row | {"path": point_path(directory, index)} for index, row in enumerate(rows)]


def read_flows(directory):
    """Steady flows on the grid, mesh by mesh."""
    rows = read_table(directory / GRID, (*NUMBERS, "cells"), (*WORDS, "transport", "find"))
    return [row | {"path": point_path(directory, index)} for index, row in enumerate(rows)
            if row["find"] == "steady-state" and row["transport"] == "dynamic" and row["status"] != "failed"]


def read_limits(directory):
    """Kinetic energies extrapolated over meshes."""
    path = directory / "extrapolated.csv"
    if not path.exists():
        return []
    return [row for row in read_table(path, LIMIT_NUMBERS, LIMIT_WORDS)
            if row["transport"] == "dynamic" and math.isfinite(row["kinetic_energy"])]


def read_ends(directory):
    """Where straight lines end."""
    path = directory / "critical.csv"
    if not path.exists():
        return []
    rows = read_table(path, ("height", "width", "hot", "cold", "critical_rayleigh"), (*LIMIT_WORDS, "route"))
    return [row for row in rows if row["transport"] == "dynamic" and row["route"] == "straight-line"]


def pairs_of(particles, flows):
    """(particles, finest flow on the grid) of every fluid of particles that the grid has, both with point files."""
    pairs = []
    for row in particles:
        same = [flow for flow in flows if same_convection(row, flow) and flow["path"].exists()]
        if same and row["path"].exists():
            pairs.append((row, max(same, key=lambda flow: flow["cells"])))
    return pairs


def scaled(flow, factor):
    return flow | {"x": factor * flow["x"], "y": factor * flow["y"]}


def draw_contours(row, grid, flow, point):
    """Density above, temperature below; continuum left, particles right."""
    width = 4.4 if row["width"] > row["height"] else 3.2
    figure, axes = plt.subplots(2, 2, figsize=(2 * width + 1.4, 2 * (width * row["height"] / row["width"] + 0.3) + 0.6),
                                sharex=True, sharey=True, layout="constrained")
    averages = point["flow"]
    for line, (name, label, colours) in zip(axes, FIELDS):
        levels = levels_of(flow[name], averages[name])
        draw_field(line[0], flow, row, name, colours, levels)
        drawn = draw_field(line[1], averages, row, name, colours, levels)
        figure.colorbar(drawn, ax=line, pad=0.02, aspect=18, shrink=0.9).set_label(label)
        line[0].set_ylabel(r"$y$  [$\sigma$]")
    for place in axes[1]:
        place.set_xlabel(r"$x$  [$\sigma$]")
    axes[0][0].set_title(f"continuum, {grid['cells']:g} cells over the height", fontsize=9.5)
    axes[0][1].set_title(f"{particles_text(row)}, mean over time {averages['time_from']:g} to {averages['time_to']:g}",
                         fontsize=9.5)
    figure.suptitle(f"{fluid_text(row)}, {rayleigh_text(row)}", fontsize=11)
    return figure


def draw_times(shown):
    """Kinetic energies against time, a panel for each pair."""
    across = min(MOST_ACROSS, len(shown))
    down = math.ceil(len(shown) / across)
    figure, axes = plt.subplots(down, across, squeeze=False, figsize=(4.6 * across, 3.3 * down + 0.4),
                                layout="constrained")
    for place, (row, grid, history, point) in zip(axes.flat, shown):
        times = history["time"] * row["height"] / grid["height"]
        draw_energies(place, point, row)
        ends = [series[0][-1] for series in point["series"].values()] or [times[-1]]
        inside = times <= max(ends)
        place.plot(times[inside], history["kinetic_energy"][inside], color="black", linewidth=1.0,
                   linestyle=(0, (5, 2)), label="continuum", zorder=3)
        place.set_xlim(0, max(ends))
        place.autoscale(axis="y")
        place.set_ylim(bottom=0)
        place.set_title(f"{fluid_text(row)}, {rayleigh_text(row)}\n{particles_text(row)}", fontsize=9.5)
    for place in list(axes.flat)[len(shown):]:
        place.set_axis_off()
    for line in axes:
        line[0].set_ylabel(ENERGY_LABEL)
    axes[0][0].legend(frameon=False, fontsize=8.5, labelspacing=0.3)
    return figure


def same_line(row, other):
    """One fluid in one cell at any Rayleigh number, with equal parts of viscosity and conductivity and driven alike:
    gravity is not in all tables, but follows from the Rayleigh number."""
    drive, other_drive = (one["rayleigh"] * one["viscosity"] * one["conductivity"] / one["height"] ** 2
                          for one in (row, other))
    return (same_cell(row, other) and close(drive, other_drive)
            and close(row["conductivity"] / row["viscosity"], other["conductivity"] / other["viscosity"]))


def panels_of(rows):
    """Rows of a panel each: periodic sides first, and of these the ideal gas."""
    panels = []
    for row in rows:
        for panel in panels:
            if same_line(row, panel[0]):
                panel.append(row)
                break
        else:
            panels.append([row])
    fluids = list(FLUIDS)
    return sorted(panels, key=lambda panel: (panel[0]["side"], fluids.index(panel[0]["equation_of_state"])))


def inverse_root(rayleigh):
    return np.asarray(rayleigh, dtype=float) ** -0.5


def draw_line(axes, limits, ends):
    """The grid's kinetic energies, and the straight line through them to its known end."""
    x = inverse_root([row["rayleigh"] for row in limits])
    y = np.array([row["kinetic_energy"] for row in limits])
    axes.plot(x, y, linestyle="none", marker=".", color="black", markersize=7, label="continuum", zorder=4)
    if ends:
        end = ends[0]["critical_rayleigh"] ** -0.5
        flowing = y > 1e-3 * y.max()
        slope = np.sum(y[flowing] * (x[flowing] - end)) / np.sum((x[flowing] - end) ** 2)
        axes.plot([x.min(), end], [slope * (x.min() - end), 0], color="black", linewidth=0.8, zorder=1,
                  label=f"line to Ra = {ends[0]['critical_rayleigh']:.0f}")


def draw_energy_points(axes, rows):
    """Of particles: a colour for each kinetic energy, a marker for each kind of particles."""
    kinds = list(dict.fromkeys(particles_text(row, rows) for row in rows))
    for index, kind in enumerate(kinds):
        these = [row for row in rows if particles_text(row, rows) == kind]
        x = inverse_root([row["rayleigh"] for row in these])
        for name, label, colour in THREE:
            values, errors = ([row[name + end] for row in these] for end in ("", "_error"))
            axes.errorbar(x, values, yerr=np.nan_to_num(errors), color=colour, marker=MARKERS[index % len(MARKERS)],
                          markersize=5, linestyle="none", elinewidth=0.9, capsize=2,
                          label=label if len(kinds) == 1 else f"{label}, {kind}")


def draw_printed(axes, published):
    for shape, particles in zip("+x1234", sorted({row["particles"] for row in published})):
        those = [row for row in published if row["particles"] == particles]
        axes.plot(inverse_root([row["rayleigh"] for row in those]), [row["kinetic_energy"] for row in those],
                  linestyle="none", marker=shape, markersize=8, color="0.35", zorder=5,
                  label=f"published, $N$ = {particles:g}" if particles > 0 else "published, continuum")


def draw_rayleigh(panels, limits, ends, published):
    """Kinetic energies against Ra^(-1/2)."""
    across = min(MOST_ACROSS, len(panels))
    down = math.ceil(len(panels) / across)
    figure, axes = plt.subplots(down, across, squeeze=False, figsize=(4.8 * across, 4.4 * down), layout="constrained")
    for place, rows in zip(axes.flat, panels):
        lines = [row for row in limits if same_line(rows[0], row)]
        if lines:
            draw_line(place, lines, [row for row in ends if same_cell(rows[0], row)])
        draw_energy_points(place, rows)
        draw_printed(place, [row for row in published if same_cell(rows[0], row)])
        place.set_ylim(bottom=0)
        place.set_xlabel(r"${\rm Ra}^{-1/2}$")
        place.set_ylabel(ENERGY_LABEL)
        place.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(6))
        above = place.secondary_xaxis("top", functions=(lambda x: x, lambda x: x))
        low, high = place.get_xlim()
        ticks = [ra for ra in ROUND_RAYLEIGH if low <= ra ** -0.5 <= high]
        above.set_xticks([ra ** -0.5 for ra in ticks], [f"{ra:g}" for ra in ticks], fontsize=8)
        above.set_xlabel("Ra", fontsize=9)
        cell = "four walls" if rows[0]["side"] == "walls" else "periodic sides"
        place.set_title(f"{fluid_text(rows[0])}, {cell}", fontsize=10)
        place.legend(frameon=False, fontsize=8)
    for place in list(axes.flat)[len(panels):]:
        place.set_axis_off()
    return figure


def read_published(path):
    return read_table(path, ("particles", "height", "width", "hot", "cold", "rayleigh", "kinetic_energy"),
                    ("equation_of_state", "side"))


def main():
    parser = argparse.ArgumentParser(description="Convection by smooth particles beside that of the continuum.")
    parser.add_argument("directories", nargs="+", type=pathlib.Path, metavar="DIR",
                        help="directories with benard.csv or benard_grid.csv")
    parser.add_argument("--out", type=pathlib.Path,
                        help="where the pictures go; default: the first DIR with benard.csv")
    parser.add_argument("--published", type=pathlib.Path, default=REFERENCE / "kum1995_benard.csv",
                        help="CSV file of published kinetic energies")
    options = parser.parse_args()
    particles, flows, limits, ends = [], [], [], []
    out = options.out
    for directory in options.directories:
        if (directory / PARTICLES).exists():
            particles += read_particles(directory)
            out = out or directory
        elif (directory / GRID).exists():
            flows += read_flows(directory)
            limits += read_limits(directory)
            ends += read_ends(directory)
        else:
            fail(f"{directory} holds neither a {PARTICLES} nor a {GRID}")
    if not particles:
        fail(f"none of the directories holds a {PARTICLES}")
    published = read_published(options.published)
    plt.rcParams.update(lucy_tables.STYLE)

    panels = panels_of([row for row in particles
                        if math.isfinite(row["rayleigh"]) and math.isfinite(row["kinetic_energy_total"])])
    if panels:
        lucy_tables.save(draw_rayleigh(panels, limits, ends, published), out, STEM)
    else:
        print("benard-compare plot: no kinetic energy at a Rayleigh number, so no picture of them")

    shown = []
    for row, grid in pairs_of(particles, flows):
        flow, history = read_grid_point(grid["path"])
        flow = scaled(flow, row["height"] / grid["height"])
        shown.append((row, grid, flow, history, read_particle_point(row["path"])))
    timed = [(row, grid, history, point) for row, grid, _, history, point in shown if point["series"]]
    if timed:
        lucy_tables.save(draw_times(timed), out, f"{STEM}_time")
    averaged = [(row, grid, flow, point) for row, grid, flow, _, point in shown if point["flow"] is not None]
    for index, those in enumerate(averaged):
        figure = draw_contours(*those)
        lucy_tables.save(figure, out, f"{STEM}_fields_{index + 1:03d}")
        plt.close(figure)
    for row in particles:
        if not any(row is one for one, *_ in shown):
            print(f"benard-compare plot: no flow on the grid beside {fluid_text(row)}, "
                  f"{plain(rayleigh_text(row))}, {plain(particles_text(row))}")


if __name__ == "__main__":
    main()
