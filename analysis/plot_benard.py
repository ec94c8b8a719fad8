#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The convection of smooth particles that `lucy benard` found.

    plot_benard.py DIR     reads DIR/benard.csv and DIR/point_NNN.h5; writes benard.png and .svg into DIR

One fluid: above, the flow averaged over time on a grid, arrows, contours of density and of temperature; in the middle
the same at the particles, at the last moment: smoothed velocities of particles that are evenly spread, density and
temperature of all; below, kinetic energy against time. The grey part was averaged over. Several fluids: benard.png has
a row of averages for each, and benard_001.png and so on are what one fluid has for itself. Points without a flow are
named on the terminal.
"""

import argparse
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import h5py  # noqa: F401  (for benard_flows)
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as missing:
    sys.exit(f"plot_benard.py needs numpy, matplotlib and h5py (Debian: python3-matplotlib, python3-h5py): {missing}")

import lucy_tables
from benard_flows import (ENERGY_LABEL, FIELDS, NUMBERS, WORDS, draw_energies, draw_field, draw_grid_arrows,
                          draw_particle_arrows, draw_particles, fluid_text, levels_of, particles_text, plain,
                          point_path, rayleigh_text, read_particle_point, read_table)
from lucy_tables import fail

MOST_ROWS = 6  # of benard.png
PANEL = 4.0  # inches: the width of a panel, or of a square one
VALUES = (*NUMBERS, "particles", "range", "kinetic_energy_field")
NAMES = (*WORDS, "kernel", "wall")
SPEED_UNIT = r"$\sqrt{\epsilon/m}$"


def times_text(flow):
    return f"mean over time {flow['time_from']:g} to {flow['time_to']:g}"


def last_text(last):
    return f"at the particles, time {last['time']:g} (velocities smoothed)"


def speed_text(speed):
    return f"velocity, longest arrow {speed:.2g} {SPEED_UNIT}"


def panel_size(row):
    """Of all panels of a fluid, in inches."""
    width = PANEL if row["width"] > row["height"] else 0.8 * PANEL
    return width, width * row["height"] / row["width"]


def common_levels(point):
    """Contours of each field: those of the averages where there are some, so that both pictures have the same."""
    shown = point["flow"] if point["flow"] is not None else point["last"]
    return {name: levels_of(shown[name]) for name, _, _ in FIELDS}


def draw_averages(places, point, row, levels):
    """Three panels; what the colour bars need."""
    flow = point["flow"]
    places[0].set_title(speed_text(draw_grid_arrows(places[0], flow, row)), fontsize=9)
    return [draw_field(place, flow, row, name, colours, levels[name])
            for place, (name, _, colours) in zip(places[1:], FIELDS)]


def draw_last(places, point, row, levels):
    last = point["last"]
    places[0].set_title(speed_text(draw_particle_arrows(places[0], last, row)), fontsize=9)
    return [draw_particles(place, last, row, name, colours, levels[name])
            for place, (name, _, colours) in zip(places[1:], FIELDS)]


def label_fields(figure, places, drawn):
    for place, what, (_, label, _) in zip(places[1:], drawn, FIELDS):
        figure.colorbar(what, ax=place, pad=0.02, aspect=18, shrink=0.9).set_label(label, fontsize=9)
        place.tick_params(labelleft=False)


def draw_point(point, row):
    """Averages, particles and kinetic energies of one fluid."""
    parts = [(name, draw) for name, draw in (("flow", draw_averages), ("last", draw_last)) if point[name] is not None]
    width, height = panel_size(row)
    figure = plt.figure(figsize=(3 * width + 2.2, (height + 0.6) * len(parts) + 2.5), layout="constrained")
    lines = figure.subfigures(len(parts) + 1, 1, height_ratios=[height + 0.6] * len(parts) + [2.3])
    levels = common_levels(point)
    for line, (name, draw) in zip(lines, parts):
        places = line.subplots(1, 3)
        label_fields(line, places, draw(places, point, row, levels))
        for place in places:
            place.set_xlabel(r"$x$  [$\sigma$]", fontsize=9)
        places[0].set_ylabel(r"$y$  [$\sigma$]", fontsize=9)
        line.suptitle(f"averaged on a grid, {times_text(point['flow'])}" if name == "flow" else
                      last_text(point["last"]), fontsize=10)
    axes = lines[-1].subplots()
    draw_energies(axes, point, row)
    axes.set_ylabel(ENERGY_LABEL, fontsize=9)
    axes.legend(frameon=False, fontsize=8.5, loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.suptitle(f"{fluid_text(row)}, {rayleigh_text(row)}, {particles_text(row)}", fontsize=11)
    return figure


def draw_overview(points, rows):
    """A line for each fluid: averages, and kinetic energies."""
    width, height = panel_size(max(rows, key=lambda row: row["height"] / row["width"]))
    figure = plt.figure(figsize=(4 * width * 0.9 + 1.5, (height + 0.75) * len(points)), layout="constrained")
    for line, point, row in zip(np.atleast_1d(figure.subfigures(len(points), 1)), points, rows):
        places = line.subplots(1, 4)
        if point["flow"] is not None:
            drawn = draw_averages(places, point, row, common_levels(point))
        else:
            drawn = draw_last(places, point, row, common_levels(point))
        label_fields(line, places, drawn)
        places[0].set_ylabel(r"$y$  [$\sigma$]", fontsize=9)
        draw_energies(places[3], point, row)
        places[3].set_ylabel(r"$K$ per mass  [$\epsilon/m$]", fontsize=9)
        places[3].tick_params(labelsize=8)
        if row is rows[0]:
            places[3].legend(frameon=False, fontsize=8, labelspacing=0.2, borderaxespad=0.2)
        what = last_text(point["last"]) if point["flow"] is None else times_text(point["flow"])
        line.suptitle(f"{fluid_text(row)}, {rayleigh_text(row)}, {particles_text(row, rows)}: {what}", fontsize=10)
    return figure


def main():
    parser = argparse.ArgumentParser(description="The convection of smooth particles.")
    parser.add_argument("directory", type=pathlib.Path, help="directory with benard.csv; the pictures go there too")
    directory = parser.parse_args().directory
    table = directory / "benard.csv"
    shown = []
    for index, row in enumerate(read_table(table, VALUES, NAMES)):
        path = point_path(directory, index)
        point = read_particle_point(path) if path.exists() else {"flow": None, "last": None}
        if point["flow"] is None and point["last"] is None:
            print(f"benard plot: point {index + 1} ({fluid_text(row)}, {plain(rayleigh_text(row))}) has no flow to draw "
                  f"(status {row['status']})")
        else:
            shown.append((index, point, row))
    if not shown:
        fail(f"{table} has no point with a flow to draw")
    plt.rcParams.update(lucy_tables.STYLE)
    if len(shown) == 1:
        lucy_tables.save(draw_point(*shown[0][1:]), directory, "benard")
        return
    for index, point, row in shown:
        figure = draw_point(point, row)
        lucy_tables.save(figure, directory, f"benard_{index + 1:03d}")
        plt.close(figure)
    first = shown[:MOST_ROWS]
    lucy_tables.save(draw_overview([point for _, point, _ in first], [row for _, _, row in first]), directory, "benard")
    if len(shown) > MOST_ROWS:
        print(f"benard plot: benard.png has the first {MOST_ROWS} of {len(shown)} flows, benard_001.png and so on all")


if __name__ == "__main__":
    main()
