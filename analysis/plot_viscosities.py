#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every route to the viscosity in one picture, from the viscosities.csv and sweep_fit.csv of `lucy viscosity`.

    plot_viscosities.py DIR

writes DIR/viscosities.png and DIR/viscosities.svg, one panel for each state. Right of the break in the axis, the
viscosity at each strain rate, with the fit eta_0 + eta_2 rate^2 and its one-sigma band over the rates that were fitted
(filled symbols; the others are open); shaded, the rates at which one particle takes much of the kinetic energy. Left of
it, at zero rate, the values found by each route. Bars are one standard error. A rate below zero is drawn at its
absolute value.

What cannot be drawn is named on the terminal.
"""

import argparse
import math
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as missing:
    sys.exit(f"plot_viscosities.py needs numpy and matplotlib (Debian: python3-matplotlib): {missing}")

import lucy_tables
from lucy_tables import COLOURS, VISCOSITY_UNIT

STATE = ("particles", "energy_per_particle")
ROUTES = {  # label, colour, marker, filled
    "nemd": ("NEMD, zero rate", COLOURS[1], "o", True),
    "green-kubo": ("Green-Kubo", COLOURS[0], "s", True),
    "green-kubo-spectrum": ("spectrum", COLOURS[4], "s", True),
    "published-green-kubo": ("published", "black", "D", False),
    "weak-scattering": ("weak scattering", COLOURS[2], "^", False),
}
FIT = ("eta_0", "eta_0_error", "eta_2", "eta_2_error", "eta_covariance")
PARTS = ("fitted", "beyond", "unstable", "no-error")
SHEARED = COLOURS[1]
PANEL_INCHES = (4.6, 3.3)


def read_states(directory):
    """[(state, routes, rows)] in the order of viscosities.csv."""
    states = []
    path = directory / "viscosities.csv"
    for row in lucy_tables.read_rows(path, STATE + ("route", "viscosity", "viscosity_error")):
        values = lucy_tables.numbers(path, row, STATE + ("viscosity", "viscosity_error"))
        if row["route"] not in ROUTES:
            lucy_tables.fail(f'{path}: route is "{row["route"]}" where one of {", ".join(ROUTES)} was expected')
        if not any(lucy_tables.same_state(values, state) for state, _, _ in states):
            states.append((values, [], []))
        routes = next(routes for state, routes, _ in states if lucy_tables.same_state(values, state))
        routes.append(values | {"route": row["route"]})
    if not states:
        lucy_tables.fail(f"{path} has no rows")
    path = directory / "sweep_fit.csv"
    columns = STATE + ("strain_rate", "viscosity", "viscosity_error")
    for row in lucy_tables.read_rows(path, columns + ("part",) + FIT):
        values = lucy_tables.numbers(path, row, columns + FIT)
        if row["part"] not in PARTS:
            lucy_tables.fail(f'{path}: part is "{row["part"]}" where one of {", ".join(PARTS)} was expected')
        for state, _, rows in states:
            if lucy_tables.same_state(values, state):
                rows.append(values | {"part": row["part"], "rate": abs(values["strain_rate"])})
    return states


def drawable(rows):
    return [row for row in rows if row["rate"] > 0 and math.isfinite(row["rate"]) and math.isfinite(row["viscosity"])]


def draw_sheared(axes, rows):
    """Rates other than zero; returns the heights that the axis must hold."""
    heights = []
    for low, high in lucy_tables.instability_bands({row["rate"]: row["part"] == "unstable" for row in rows}):
        axes.axvspan(low, high, color=SHEARED, alpha=0.12, linewidth=0, zorder=0)
    for row in rows:
        known = math.isfinite(row["viscosity_error"])
        axes.errorbar(row["rate"], row["viscosity"], yerr=row["viscosity_error"] if known else None, color=SHEARED,
                      marker="o", markersize=5.5, markerfacecolor=SHEARED if row["part"] == "fitted" else "white",
                      capsize=2.5, elinewidth=1.0, linestyle="none", zorder=4)
        error = row["viscosity_error"] if known and row["part"] != "unstable" else 0.0
        heights += [row["viscosity"] - error, row["viscosity"] + error]
    fitted = [row for row in rows if row["part"] == "fitted"]
    if fitted and all(math.isfinite(fitted[0][name]) for name in FIT):
        fit = fitted[0]
        low, high = axes.get_xlim()[0], max(row["rate"] for row in fitted)
        square = np.geomspace(min(low, high), high, 200) ** 2
        value = fit["eta_0"] + fit["eta_2"] * square
        variance = (fit["eta_0_error"] ** 2 + 2 * fit["eta_covariance"] * square
                    + (fit["eta_2_error"] * square) ** 2)
        error = np.sqrt(np.maximum(variance, 0.0))
        rate = np.sqrt(square)
        axes.fill_between(rate, value - error, value + error, color=SHEARED, alpha=0.25, linewidth=0, zorder=2)
        axes.plot(rate, value, color=SHEARED, linewidth=1.2, zorder=3)
        heights += list(value - error) + list(value + error)
    return heights


def draw_routes(axes, routes):
    heights = []
    for place, route in enumerate(routes):
        _, colour, marker, filled = ROUTES[route["route"]]
        error = route["viscosity_error"]
        known = math.isfinite(error)
        axes.errorbar(place, route["viscosity"], yerr=error if known else None, color=colour, marker=marker,
                      markersize=6, markerfacecolor=colour if filled else "white", capsize=2.5, elinewidth=1.1,
                      linestyle="none", zorder=4)
        heights += [route["viscosity"] - (error if known else 0.0), route["viscosity"] + (error if known else 0.0)]
    ours = next((route for route in routes if route["route"] == "green-kubo"), None)
    if ours and math.isfinite(ours["viscosity_error"]):
        axes.axhspan(ours["viscosity"] - ours["viscosity_error"], ours["viscosity"] + ours["viscosity_error"],
                     color=COLOURS[0], alpha=0.12, linewidth=0, zorder=0)
    axes.set_xticks(range(len(routes)), [ROUTES[route["route"]][0] for route in routes], rotation=40, ha="right",
                    rotation_mode="anchor", fontsize=8.5)
    axes.tick_params(axis="x", length=0)
    axes.set_xlim(-0.7, max(len(routes), 1) - 0.3)
    return heights


def mark_break(left, right):
    """Two strokes where the axis jumps from zero to the lowest rates."""
    stroke = {"marker": [(-1, -2), (1, 2)], "markersize": 7, "linestyle": "none", "color": "black",
              "markeredgewidth": 0.8, "clip_on": False, "zorder": 10}
    left.plot([1, 1], [0, 1], transform=left.transAxes, **stroke)
    right.plot([0, 0], [0, 1], transform=right.transAxes, **stroke)
    left.spines["right"].set_visible(False)
    right.spines["left"].set_visible(False)


def draw_state(left, right, state, routes, rows):
    routes = [route for route in routes if math.isfinite(route["viscosity"])]
    rows = drawable(rows)
    right.set_xscale("log")
    if rows:
        right.set_xlim(min(row["rate"] for row in rows) / 1.6, max(row["rate"] for row in rows) * 1.6)
    else:
        right.text(0.5, 0.5, "no sheared runs", transform=right.transAxes, ha="center", color="0.4")
        right.set_xticks([])
    heights = draw_routes(left, routes) + draw_sheared(right, rows)
    low, high = min(heights + [0.0]), max(heights + [0.0])
    left.set_ylim(low - 0.03 * (high - low), high + 0.08 * (high - low))
    left.axhline(0, color="0.6", linewidth=0.6, zorder=1)
    right.axhline(0, color="0.6", linewidth=0.6, zorder=1)
    left.tick_params(axis="y", which="both", direction="in")
    right.tick_params(axis="y", which="both", direction="in", left=False, labelleft=False, right=True)
    right.tick_params(axis="x", which="both", direction="in", top=True)
    mark_break(left, right)
    left.set_ylabel(rf"shear viscosity  $\eta$   [{VISCOSITY_UNIT}]")
    right.set_xlabel(r"strain rate  $|\dot\gamma|$   [$\sqrt{\epsilon/m}\,/\sigma$]")
    left.set_title("$" + lucy_tables.state_name(state).replace(", ", "$, $") + "$", loc="left", fontsize=10.5)


def draw_legend(figure, states, height):
    line, patch = matplotlib.lines.Line2D, matplotlib.patches.Patch
    parts = {row["part"] for _, _, rows in states for row in drawable(rows)}
    symbol = {"color": SHEARED, "marker": "o", "markersize": 5.5, "linestyle": "none"}
    entries = []
    if "fitted" in parts:
        entries += [(line([], [], **symbol), "sheared, fitted"),
                    ((patch(facecolor=SHEARED, alpha=0.25, linewidth=0), line([], [], color=SHEARED, linewidth=1.2)),
                     r"$\eta_0 + \eta_2\,\dot\gamma^{\,2}$")]
    if parts - {"fitted"}:
        entries.append((line([], [], markerfacecolor="white", **symbol), "sheared, left out"))
    if "unstable" in parts:
        entries.append((patch(facecolor=SHEARED, alpha=0.12, linewidth=0), "one particle has much of $K$"))
    if any(route["route"] == "green-kubo" and math.isfinite(route["viscosity"] + route["viscosity_error"])
           for _, routes, _ in states for route in routes):
        entries.append((patch(facecolor=COLOURS[0], alpha=0.12, linewidth=0), "Green-Kubo, one standard error"))
    columns = len(entries) if len(states) > 1 else 2
    if entries:
        figure.legend(*zip(*entries), loc="upper center", bbox_to_anchor=(0.5, 1 - 0.04 / height), ncol=columns,
                      frameon=False, columnspacing=1.5, handletextpad=0.6, fontsize=9)


def draw(states):
    columns = min(len(states), 2)
    lines = math.ceil(len(states) / columns)
    gap, foot, legend = 1.25, 0.95, 0.45 if columns > 1 else 0.8  # inches
    height = legend + 0.3 + lines * (PANEL_INCHES[1] + gap) - gap + foot
    width = 0.75 + columns * (PANEL_INCHES[0] + 0.85) - 0.7
    figure = plt.figure(figsize=(width, height))
    outer = figure.add_gridspec(lines, columns, wspace=0.75 / PANEL_INCHES[0], hspace=gap / PANEL_INCHES[1],
                                left=0.75 / width, right=1 - 0.15 / width, bottom=foot / height,
                                top=1 - (legend + 0.3) / height)
    for index, (state, routes, rows) in enumerate(states):
        inner = outer[index // columns, index % columns].subgridspec(1, 2, width_ratios=(0.42, 1), wspace=0.04)
        left = figure.add_subplot(inner[0])
        draw_state(left, figure.add_subplot(inner[1], sharey=left), state, routes, rows)
    draw_legend(figure, states, height)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path,
                        help="output directory of `lucy viscosity`, with its viscosities.csv and sweep_fit.csv")
    directory = parser.parse_args().directory
    states, shown, notes = read_states(directory), [], []
    for state, routes, rows in states:
        name = lucy_tables.state_name(state)
        absent = [ROUTES[route["route"]][0] for route in routes if not math.isfinite(route["viscosity"])]
        if absent:
            notes.append(f"{name}: no value for {', '.join(absent)}")
        missing_rates = [f"{row['strain_rate']:g}" for row in rows if not math.isfinite(row["viscosity"])]
        if missing_rates:
            notes.append(f"{name}: no viscosity at strain rate {', '.join(missing_rates)}")
        if drawable(rows) or len(absent) < len(routes):
            shown.append((state, routes, rows))
    if shown:
        plt.rcParams.update(lucy_tables.STYLE)
        lucy_tables.save(draw(shown), directory, "viscosities")
    else:
        notes.append(f"not drawn, {directory / 'viscosities.csv'} holds no value")
    for note in notes:
        print(f"viscosities plot: {note}")


if __name__ == "__main__":
    main()
