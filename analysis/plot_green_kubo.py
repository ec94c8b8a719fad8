#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Stress correlations and their running integrals, from the viscosity.csv and correlation.csv of `lucy green-kubo`.

    plot_green_kubo.py DIR [--nemd NEMD.csv] [--reference REFERENCE]

writes DIR/correlation.png and DIR/correlation.svg, one row of panels for each state. Bands are one standard error.

Left, the integrand (V/kT) C(t) (as in Fig. 9 of Posch, Hoover and Kum, Phys. Rev. E 52, 1711 (1995)) up to the
cut-off, with its kinetic, cross and potential parts; inset, the same on a logarithmic axis with the exponential tail
fitted between the ticks. Middle, the running integral, eta(t) = (V/kT) int_0^t C ds; the viscosity is its value at the
cut-off. About zero: the running integral of <P_xy(0) D(t)>, D = (P_xx - P_yy)/2, which isotropy makes zero, on the band
of one standard deviation expected of such noise. Right, the routes to the viscosity side by side. The published value
is shown where DIR/input.toml says that ours was found under the published conditions; its bar is our error, scaled to
its run length. The NEMD value comes from the nemd.csv of `lucy viscosity`.

States without curves (those that failed) are named on the terminal.
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
    sys.exit(f"plot_green_kubo.py needs numpy and matplotlib (Debian: python3-matplotlib): {missing}")

import lucy_tables
from lucy_tables import COLOURS, PRESSURE_UNIT, TIME_UNIT, VISCOSITY_UNIT, with_error

STATE = ("energy_per_particle", "particles")
VALUES = ("viscosity", "viscosity_error", "viscosity_spectrum", "viscosity_spectrum_error", "decay_time",
          "decay_time_error", "cutoff", "decay_begin", "decay_end", "duration", "replicas")
CURVES = ("C_mean", "integral", "noise_integral", "C_kinetic", "C_cross", "C_potential")
COLUMNS = ("time", "noise_envelope") + tuple(name + suffix for name in CURVES for suffix in ("", "_error"))
PARTS = (("C_kinetic", "kinetic", COLOURS[1], "-"), ("C_cross", "cross", COLOURS[2], "--"),
         ("C_potential", "potential", COLOURS[3], "-."))
OURS, SPECTRUM, PUBLISHED, NEMD, NOISE = COLOURS[0], COLOURS[4], "black", COLOURS[5], "0.45"
PUBLISHED_CONDITIONS = (("system", "density", 1.0), ("kernel", "name", "lucy"), ("kernel", "range", 3.0))
SHOWN_CUTOFFS = 2.6  # of the running integral


def read_curves(path):
    """{point: {column: array}}; the points are the lines of viscosity.csv, from 1."""
    points = {}
    for row in lucy_tables.read_rows(path, ("point",) + COLUMNS):
        values = lucy_tables.numbers(path, row, ("point",) + COLUMNS)
        points.setdefault(int(values["point"]), []).append([values[column] for column in COLUMNS])
    return {point: dict(zip(COLUMNS, np.array(rows).T)) for point, rows in points.items()}


def differing_conditions(directory):
    """The conditions of a run, as text, in which it differs from the published ones."""
    document = lucy_tables.read_toml(directory / "input.toml")
    if document is None:
        return ["conditions unknown"]
    differing = []
    try:
        for section, key, published in PUBLISHED_CONDITIONS:
            for point in document.get("point", []) or [{}]:
                value = point.get(key, document.get(section, {}).get(key, published))
                text = f"{'kernel ' if section == 'kernel' else ''}{key} = {value}"
                if value != published and text not in differing:
                    differing.append(text)
    except AttributeError:  # no table where one was expected
        return ["conditions unknown"]
    return differing


def published_values(path, rows, directory, notes):
    """For each row the published viscosity and its error, or None."""
    published = []
    if path.is_file():
        columns = STATE + ("viscosity", "total_time")
        for row in lucy_tables.read_rows(path, columns):
            values = lucy_tables.numbers(path, row, columns)
            values["last_digit"] = 10.0 ** -len(row["viscosity"].partition(".")[2])
            published.append(values)
    found = [next((entry for entry in published if lucy_tables.same_state(entry, row)), None) for row in rows]
    differing = differing_conditions(directory)
    if differing and any(found):
        why = f"they hold for density 1, kernel lucy and kernel range 3, ours for {', '.join(differing)}"
        if differing == ["conditions unknown"]:
            why = "no readable input.toml beside viscosity.csv tells the conditions"
        notes.append(f"published values are left out: {why}")
        return [None] * len(rows)
    values = []
    for entry, row in zip(found, rows):
        if entry is None:
            values.append(None)
            continue
        scaled = row["viscosity_error"] * math.sqrt(row["duration"] * row["replicas"] / entry["total_time"])
        values.append((entry["viscosity"], math.hypot(scaled, entry["last_digit"] / math.sqrt(12))))
    return values


def nemd_values(path, rows):
    columns = STATE + ("viscosity", "viscosity_error")
    entries = [lucy_tables.numbers(path, row, columns) for row in lucy_tables.read_rows(path, columns)]
    found = [next((entry for entry in entries if lucy_tables.same_state(entry, row)), None) for row in rows]
    return [entry and (entry["viscosity"], entry["viscosity_error"]) for entry in found]


def first(*numbers):
    """The first that is finite and positive."""
    return next((value for value in numbers if math.isfinite(value) and value > 0), math.nan)


def band(axes, time, value, error, colour, **style):
    known = np.isfinite(value) & np.isfinite(error)
    axes.fill_between(time, value - error, value + error, where=known, color=colour, alpha=0.25, linewidth=0, **style)


def limits(axes, low, high, room=0.06):
    """A vertical axis that holds [low, high] with some room."""
    if math.isfinite(low) and math.isfinite(high) and high > low:
        axes.set_ylim(low - room * (high - low), high + room * (high - low))


def extremes(*arrays):
    values = np.concatenate([np.atleast_1d(np.asarray(array, dtype=float)) for array in arrays])
    values = values[np.isfinite(values)]
    return (values.min(), values.max()) if len(values) else (math.nan, math.nan)


def tail_amplitude(row, curves):
    """The exponential's amplitude by weighted least squares in the window, its decay time being known."""
    time, value, error = curves["time"], curves["C_mean"], curves["C_mean_error"]
    used = (time >= row["decay_begin"]) & (time <= row["decay_end"]) & np.isfinite(value) & (error > 0)
    if not used.any() or not row["decay_time"] > 0:
        return math.nan
    shape = np.exp(-time[used] / row["decay_time"]) / error[used]
    return float(np.sum(shape * value[used] / error[used]) / np.sum(shape**2))


def draw_inset(panel, row, curves, end):
    """The logarithm, with the exponential over its window."""
    amplitude = tail_amplitude(row, curves)
    shown = (curves["time"] <= end) & np.isfinite(curves["C_mean"])
    time, value, error = (curves[name][shown] for name in ("time", "C_mean", "C_mean_error"))
    if not (value > 0).any() or len(time) < 2:
        return
    top = value[value > 0].max()
    floor = 2e-3 * top
    if amplitude > 0:
        floor = amplitude * math.exp(-row["decay_end"] / row["decay_time"]) / 6
    floor = min(max(floor, 1e-5 * top), 0.1 * top)
    axes = panel.inset_axes([0.42, 0.34, 0.55, 0.61])
    axes.set_yscale("log")
    # A line that ends at the lower edge where C falls below zero, rather than gaps.
    axes.plot(time, np.maximum(value, floor / 100), color=OURS, linewidth=1.0, zorder=3)
    known = np.isfinite(error)
    axes.fill_between(time, np.maximum(value - error, floor / 100), np.maximum(value + error, floor / 100), where=known,
                      color=OURS, alpha=0.25, linewidth=0)
    if amplitude > 0:
        begin, stop = row["decay_begin"], row["decay_end"]
        window = np.array([begin, stop])
        everywhere = np.array([0.0, end])
        axes.plot(everywhere, amplitude * np.exp(-everywhere / row["decay_time"]), color="black", linewidth=0.7,
                  linestyle=(0, (1, 2)), zorder=4)
        axes.plot(window, amplitude * np.exp(-window / row["decay_time"]), color="black", linewidth=1.2, marker="|",
                  markersize=7, zorder=5)
        axes.text(0.96, 0.94, rf"$\tau$ = {with_error(row['decay_time'], row['decay_time_error'])}" "\n"
                  rf"fit: {begin:.3g} $\leq t \leq$ {stop:.3g}", transform=axes.transAxes, ha="right", va="top",
                  fontsize=8, linespacing=1.4)
    axes.set_ylim(floor, 2.5 * top)
    axes.set_xlim(0, end)
    axes.tick_params(which="both", direction="in", labelsize=7.5, top=True, right=True)
    axes.patch.set_alpha(0.9)


def draw_correlation(axes, row, curves):
    end = first(row["cutoff"], curves["time"][-1])
    shown = curves["time"] <= end
    time, value, error = (curves[name][shown] for name in ("time", "C_mean", "C_mean_error"))
    drawn = set()
    lines = [value - np.nan_to_num(error), value + np.nan_to_num(error)]
    for name, label, colour, style in PARTS:
        part = curves[name][shown]
        if np.isfinite(part).any():
            axes.plot(time, part, color=colour, linestyle=style, linewidth=0.9, zorder=2)
            drawn.add(label)
            lines.append(part)
    band(axes, time, value, error, OURS, zorder=3)
    axes.plot(time, value, color=OURS, linewidth=1.3, zorder=4)
    axes.axhline(0, color="0.6", linewidth=0.6, zorder=1)
    limits(axes, *extremes(0.0, *lines))
    axes.set_xlim(-0.015 * end, end)
    draw_inset(axes, row, curves, end)
    return drawn


def draw_integral(axes, row, curves, routes):
    end = curves["time"][-1]
    cutoff = row["cutoff"]
    if cutoff > 0:
        end = min(end, SHOWN_CUTOFFS * cutoff)
    shown = curves["time"] <= end
    time, value, error, noise, envelope = (
        curves[name][shown] for name in ("time", "integral", "integral_error", "noise_integral", "noise_envelope"))
    axes.fill_between(time, -envelope, envelope, where=np.isfinite(envelope), color="0.88", linewidth=0, zorder=0)
    axes.plot(time, noise, color=NOISE, linewidth=0.8, zorder=1)
    axes.axhline(0, color="0.6", linewidth=0.6, zorder=1)
    band(axes, time, value, error, OURS, zorder=3)
    axes.plot(time, value, color=OURS, linewidth=1.3, zorder=4)
    for factor in (0.5, 1.0, 2.0):
        if 0 < factor * cutoff <= end:
            axes.axvline(factor * cutoff, color="0.35", zorder=2, linewidth=1.0 if factor == 1.0 else 0.7,
                         linestyle="--" if factor == 1.0 else ":")
    axes.set_xlim(-0.015 * end, end)
    axes.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(7, steps=[1, 2, 2.5, 5, 10], prune="upper"))
    marks = [route[1] + sign * np.nan_to_num(route[2]) for route in routes for sign in (-1, 1)]
    steady = np.nan_to_num(error)
    limits(axes, *extremes(0.0, value - steady, value + steady, noise, envelope, -envelope, marks))


def draw_routes(axes, routes):
    """Values side by side, on the vertical axis of the running integral."""
    for place, (label, value, error, colour, marker, filled) in enumerate(routes):
        axes.errorbar(place, value, yerr=None if not math.isfinite(error) else error, color=colour, marker=marker,
                      markersize=6, markerfacecolor=colour if filled else "white", capsize=2.5, elinewidth=1.1,
                      linestyle="none", zorder=4)
    axes.set_xticks(range(len(routes)), [route[0] for route in routes], rotation=40, ha="right", rotation_mode="anchor",
                    fontsize=8.5)
    axes.set_xlim(-0.6, max(len(routes), 1) - 0.4)
    axes.axhline(0, color="0.6", linewidth=0.6, zorder=1)
    axes.tick_params(axis="y", labelleft=False)


def routes_of(row, published, nemd):
    """(label, value, error, colour, marker, filled) of every route that has a value."""
    routes = [("integral", row["viscosity"], row["viscosity_error"], OURS, "o", True),
              ("spectrum", row["viscosity_spectrum"], row["viscosity_spectrum_error"], SPECTRUM, "s", True)]
    if nemd:
        routes.append(("NEMD", *nemd, NEMD, "^", True))
    if published:
        routes.append(("published", *published, PUBLISHED, "D", False))
    return [route for route in routes if math.isfinite(route[1])]


def title_of(row):
    name = lucy_tables.state_name(row)
    return name if name == lucy_tables.SERIES else "$" + name.replace(", ", "$, $") + "$"


def values_of(row):
    values = [f"{with_error(row[name], row[name + '_error'])} {where}"
              for name, where in (("viscosity", "at the cut-off"), ("viscosity_spectrum", "from the spectrum"))
              if math.isfinite(row[name])]
    return r"$\eta$ = " + ", ".join(values) if values else f"no viscosity (status {row['status']})"


def draw_legend(figure, rows, parts, height):
    line, patch = matplotlib.lines.Line2D, matplotlib.patches.Patch
    handles = [(line([], [], color=OURS, linewidth=1.3), patch(facecolor=OURS, alpha=0.25, linewidth=0))]
    labels = ["whole stress, mean of both components"]
    for _, label, colour, style in PARTS:
        if label in parts:
            handles.append(line([], [], color=colour, linestyle=style, linewidth=0.9))
            labels.append(f"{label} part")
    if any(row["decay_time"] > 0 and row["decay_end"] > 0 for row in rows):
        handles.append(line([], [], color="black", linewidth=1.2, marker="|", markersize=7))
        labels.append("exponential tail")
    if any(row["cutoff"] > 0 for row in rows):
        handles += [line([], [], color="0.35", linewidth=1.0, linestyle="--"),
                    line([], [], color="0.35", linewidth=0.7, linestyle=":")]
        labels += ["cut-off", "half and twice the cut-off"]
    handles.append((patch(facecolor="0.88", linewidth=0), line([], [], color=NOISE, linewidth=0.8)))
    labels.append(r"pure noise from $\langle P_{xy} D\rangle$, expected spread")
    columns = math.ceil(len(handles) / 2)
    figure.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, 1 - 0.04 / height), ncol=columns,
                  frameon=False, columnspacing=1.6, handletextpad=0.6, fontsize=9)


def draw(states, published, nemd):
    """The figure; `states` are (row, curves), the others a value and an error or None for each."""
    legend_inches, row_inches, gap_inches, foot_inches = 0.62, 3.0, 0.85, 0.75
    height = legend_inches + len(states) * (row_inches + gap_inches) - gap_inches + foot_inches + 0.25
    figure = plt.figure(figsize=(10.6, height))
    outer = figure.add_gridspec(len(states), 2, width_ratios=(1, 1.22), wspace=0.2, hspace=gap_inches / row_inches,
                                left=0.075, right=0.985, bottom=foot_inches / height,
                                top=1 - (legend_inches + 0.25) / height)
    parts = set()
    for index, (row, curves) in enumerate(states):
        inner = outer[index, 1].subgridspec(1, 2, width_ratios=(1, 0.26), wspace=0.035)
        left, middle = figure.add_subplot(outer[index, 0]), figure.add_subplot(inner[0])
        right = figure.add_subplot(inner[1], sharey=middle)
        units = lucy_tables.state_name(row) != lucy_tables.SERIES
        parts |= draw_correlation(left, row, curves)
        routes = routes_of(row, published[index], nemd[index])
        draw_integral(middle, row, curves, routes)
        draw_routes(right, routes)
        if math.isfinite(row["viscosity"]) and math.isfinite(row["viscosity_error"]):
            for axes in (middle, right):
                axes.axhspan(row["viscosity"] - row["viscosity_error"], row["viscosity"] + row["viscosity_error"],
                             color=OURS, alpha=0.12, linewidth=0, zorder=0)
        for axes in (left, middle, right):
            axes.tick_params(which="both", direction="in", top=axes is not right, right=True)
        right.tick_params(axis="x", length=0)
        time_label = f"time  $t$   [{TIME_UNIT}]" if units else "time  $t$"
        left.set(xlabel=time_label, ylabel=r"$(V/kT)\,C(t)$" + (f"   [{PRESSURE_UNIT}]" if units else ""))
        middle.set(xlabel=time_label,
                   ylabel=r"running integral  $\eta(t)$" + (f"   [{VISCOSITY_UNIT}]" if units else ""))
        left.yaxis.set_label_coords(-0.125, 0.5)
        middle.yaxis.set_label_coords(-0.105, 0.5)
        left.set_title(title_of(row), loc="left", fontsize=10.5)
        middle.set_title(values_of(row), loc="left", fontsize=10)
    draw_legend(figure, [row for row, _ in states], parts, height)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path,
                        help="output directory of `lucy green-kubo`, with its viscosity.csv and correlation.csv")
    parser.add_argument("--nemd", type=pathlib.Path, help="nemd.csv of `lucy viscosity`, to draw its values too")
    parser.add_argument("--reference", type=pathlib.Path, default=lucy_tables.REFERENCE,
                        help="directory of the published values (default: the one shipped with Lucy)")
    options = parser.parse_args()
    table = options.directory / "viscosity.csv"
    rows = [lucy_tables.numbers(table, row, STATE + VALUES) | {"status": row["status"]}
            for row in lucy_tables.read_rows(table, STATE + VALUES + ("status",))]
    if not rows:
        lucy_tables.fail(f"{table} has no rows")
    curves = read_curves(options.directory / "correlation.csv")
    states, notes = [], []
    for point, row in enumerate(rows, 1):
        found = curves.get(point)
        if found is not None and np.isfinite(found["C_mean"]).sum() > 1:
            states.append((row, found))
        else:
            notes.append(f"{lucy_tables.state_name(row)}: no correlation function (status {row['status']})")
    if states:
        shown = [row for row, _ in states]
        published = published_values(options.reference / "posch1995_green_kubo.csv", shown, options.directory, notes)
        nemd = nemd_values(options.nemd, shown) if options.nemd else [None] * len(shown)
        plt.rcParams.update(lucy_tables.STYLE)
        lucy_tables.save(draw(states, published, nemd), options.directory, "correlation")
    else:
        notes.append(f"not drawn, no state of {table} has a correlation function")
    for note in notes:
        print(f"correlation plot: {note}")


if __name__ == "__main__":
    main()
