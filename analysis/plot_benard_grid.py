#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The convection that `lucy benard-grid` found.

    plot_benard_grid.py DIR     reads DIR/benard_grid.csv, DIR/point_NNN.h5 and, where they are, DIR/extrapolated.csv and
                                DIR/critical.csv; writes benard_grid.png, .svg and critical.png, .svg into DIR

Flows: of each fluid and Rayleigh number the finest mesh, arrows and density contours above, temperature contours below.
Critical: growth rates against Ra, and kinetic energies against Ra^(-1/2) with their straight line, whichever there are.
"""

import argparse
import math
import pathlib
import sys

from lucy_tables import COLOURS, STYLE, fail, number, read_rows, save

try:
    import matplotlib

    matplotlib.use("Agg")
    import h5py
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as missing:
    sys.exit(f"plot_benard_grid.py needs numpy, matplotlib and h5py (Debian: python3-matplotlib, python3-h5py): "
             f"{missing}")

MOST_FLOWS = 4  # side by side
ARROWS = 20  # along the longer edge
CONTOURS = 15
FAMILY = ("equation_of_state", "transport", "side", "height", "width", "hot", "cold")
COLUMNS = (*FAMILY, "find", "cells", "rayleigh", "viscosity", "growth_rate", "kinetic_energy", "status")


def read_flow(path):
    try:
        with h5py.File(path, "r") as file:
            flow = {name: field[...] for name, field in file["fields"].items()}
            return {**flow, "x": file["grid/x"][...], "y": file["grid/y"][...]}
    except (OSError, KeyError) as error:
        fail(f"cannot read {path}: {error}")


def finest_flows(directory, rows):
    """(row, path) of the finest mesh of every fluid and Rayleigh number that has a flow, in the order of the table."""
    finest = {}
    for index, row in enumerate(rows):
        path = directory / f"point_{index + 1:03d}.h5"
        if row["find"] != "steady-state" or row["status"] == "failed" or not path.exists():
            continue
        key = tuple(row[column] for column in FAMILY) + (row["rayleigh"],)
        if key not in finest or int(finest[key][0]["cells"]) < int(row["cells"]):
            finest[key] = (row, path)
    return list(finest.values())


def draw_contours(axes, flow, name):
    field = flow[name]
    spread = float(field.max() - field.min())
    middle = float(field.mean())
    if spread > 1e-9 * abs(middle):
        axes.contour(flow["x"], flow["y"], field, CONTOURS, colors="black", linewidths=0.7)
    drawn = axes.pcolormesh(flow["x"], flow["y"], field, cmap="viridis" if name == "density" else "inferno",
                            shading="gouraud", rasterized=True)
    if spread <= 1e-9 * abs(middle):
        drawn.set_clim(middle - 0.5 * abs(middle), middle + 0.5 * abs(middle))
    return drawn


def draw_arrows(axes, flow):
    x, y = flow["x"], flow["y"]
    every = max(1, round(max(len(x), len(y)) / ARROWS))
    column, row = slice(every // 2, None, every), slice(every // 2, None, every)
    vx, vy = flow["velocity_x"][row, column], flow["velocity_y"][row, column]
    fastest = float(np.hypot(vx, vy).max())
    if fastest > 0:
        spacing = every * (x[1] - x[0])
        axes.quiver(x[column], y[row], vx, vy, scale=fastest / (1.3 * spacing), scale_units="xy", angles="xy",
                    color="white", width=0.004)


def draw_flows(flows):
    flows = flows[:MOST_FLOWS]
    figure, axes = plt.subplots(2, len(flows), squeeze=False, figsize=(5.2 * len(flows), 5.8), layout="constrained")
    for column, (row, path) in enumerate(flows):
        flow = read_flow(path)
        for place, name, label in ((axes[0][column], "density", r"density $\rho$"),
                                   (axes[1][column], "temperature", r"temperature $kT$")):
            drawn = draw_contours(place, flow, name)
            place.set_aspect("equal")
            figure.colorbar(drawn, ax=place, shrink=0.8, label=label)
            place.set_ylabel(r"$y/\sigma$")
        draw_arrows(axes[0][column], flow)
        axes[0][column].set_title(f"{row['equation_of_state'].replace('-', ' ')}, Ra = {float(row['rayleigh']):g}, "
                                  f"{row['cells']} cells")
        axes[1][column].set_xlabel(r"$x/\sigma$")
    return figure


def growing(rows):
    return [row for row in rows if row["find"] == "growth-rate" and row["status"] == "ok"]


def draw_growth(axes, path, rows):
    usable = growing(rows)
    for index, cells in enumerate(sorted({int(row["cells"]) for row in usable})):
        mesh = [row for row in usable if int(row["cells"]) == cells]
        ra = np.array([number(path, row, "rayleigh") for row in mesh])
        rate = np.array([number(path, row, "growth_rate") * number(path, row, "height") ** 2
                         / number(path, row, "viscosity") for row in mesh])
        order = np.argsort(ra)
        axes.plot(ra[order], rate[order], "o-", color=COLOURS[index % len(COLOURS)], label=f"{cells} cells",
                  markersize=4, linewidth=1)
    axes.axhline(0, color="grey", linewidth=0.8)
    axes.set_xlabel("Rayleigh number")
    axes.set_ylabel(r"growth rate $\times\ L^2/\nu$")


def draw_line(axes, path, rows):
    critical = {tuple(row[column] for column in FAMILY): number(path, row, "critical_rayleigh")
                for row in rows if row["route"] == "straight-line"}
    limits_path = path.parent / "extrapolated.csv"
    limits = read_rows(limits_path, (*FAMILY, "rayleigh", "kinetic_energy"))
    for index, (family, ra_c) in enumerate(critical.items()):
        mine = [row for row in limits if tuple(row[column] for column in FAMILY) == family]
        x = np.array([number(limits_path, row, "rayleigh") ** -0.5 for row in mine])
        y = np.array([number(limits_path, row, "kinetic_energy") for row in mine])
        flowing = y > 1e-3 * y.max()
        colour = COLOURS[index % len(COLOURS)]
        axes.plot(x, y, "o", color=colour, markersize=4, label=f"{family[0]}, {family[1]}")
        end = ra_c ** -0.5
        slope = np.sum(y[flowing] * (x[flowing] - end)) / np.sum((x[flowing] - end) ** 2)
        axes.plot([x.min(), end], [slope * (x.min() - end), 0], color=colour, linewidth=1,
                  label=f"line to Ra = {ra_c:.0f}")
    axes.set_xlabel(r"${\rm Ra}^{-1/2}$")
    axes.set_ylabel("kinetic energy per mass")
    axes.set_ylim(bottom=0)


def draw_critical(directory, rows):
    path = directory / "critical.csv"
    found = read_rows(path, (*FAMILY, "route", "cells", "critical_rayleigh")) if path.exists() else []
    routes = (["growth-rates"] if growing(rows) else []) + (
        ["straight-line"] if any(row["route"] == "straight-line" for row in found) else [])
    if not routes:
        return None
    figure, axes = plt.subplots(1, len(routes), squeeze=False, figsize=(5.2 * len(routes), 3.8), layout="constrained")
    for place, route in zip(axes[0], routes):
        if route == "growth-rates":
            draw_growth(place, directory / "benard_grid.csv", rows)
            limit = [number(path, row, "critical_rayleigh") for row in found
                     if row["route"] == route and row["cells"] == "extrapolated"]
            if len(limit) == 1 and math.isfinite(limit[0]):
                place.axvline(limit[0], color="grey", linestyle="--", linewidth=0.8, label=f"Ra = {limit[0]:.1f}")
        else:
            draw_line(place, path, found)
        place.legend(frameon=False)
    return figure


def main():
    parser = argparse.ArgumentParser(description="Convection of a continuum, and where it begins.")
    parser.add_argument("directory", type=pathlib.Path, help="directory with benard_grid.csv; the pictures go there too")
    directory = parser.parse_args().directory
    rows = read_rows(directory / "benard_grid.csv", COLUMNS)
    plt.rcParams.update(STYLE)
    flows = finest_flows(directory, rows)
    critical = draw_critical(directory, rows)
    if not flows and critical is None:
        fail(f"{directory / 'benard_grid.csv'} has neither a flow nor a growth rate to draw")
    if critical is not None:
        save(critical, directory, "critical")
    if flows:
        save(draw_flows(flows), directory, "benard_grid")
        if len(flows) > MOST_FLOWS:
            print(f"benard-grid plot: the first {MOST_FLOWS} of {len(flows)} flows are drawn")


if __name__ == "__main__":
    main()
