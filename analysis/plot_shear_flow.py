#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The viscosity of sheared smooth particles against strain rate, from the shear_flow.csv of a run.

    plot_shear_flow.py DIR

writes DIR/shear_flow.png and DIR/shear_flow.svg. Left: the measured viscosity of the fluid with most rates and its
three parts, beside the prescribed one. Middle: what is measured beyond the prescribed viscosity, for every fluid of the
table. Right: the kinetic temperature of the particles' own noise. Bars are one standard error; a white dot has none;
hollow symbols are flows that have fallen into bands. Rows that cannot be shown are named on the terminal.
"""

import argparse
import math
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import matplotlib.ticker
except ImportError as missing:
    sys.exit(f"plot_shear_flow.py needs numpy and matplotlib (Debian: python3-matplotlib): {missing}")

import lucy_tables
from lucy_tables import COLOURS, VISCOSITY_UNIT, fail, numbers, read_rows

MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "h", "d", "*")
PARTS = (  # column, label, marker
    ("viscosity", "total", "o"),
    ("viscosity_newtonian", "Newtonian", "s"),
    ("viscosity_pressure", "pressure", "^"),
    ("viscosity_carried", "carried", "D"),
)
MEASURED = tuple(name for name, _, _ in PARTS) + ("viscosity_excess", "kinetic_temperature")
SETTINGS = ("particles", "strain_rate", "range", "density", "start_temperature", "prescribed_viscosity",
            "prescribed_bulk_viscosity", "prescribed_conductivity")
WORDS = ("equation_of_state", "kernel", "cooling", "status")
FLUIDS = {"ideal-gas": "ideal gas", "van-der-waals": "van der Waals", "dense-fluid": "dense fluid"}
HOMOGENEOUS_DENSITY_WAVE = 0.25  # as in the program's table


def read_table(path):
    values = SETTINGS + tuple(name + end for name in MEASURED for end in ("", "_error")) + ("density_wave",)
    rows = []
    for line in read_rows(path, values + WORDS):
        row = numbers(path, line, values) | {word: line[word] for word in WORDS}
        row["rate"] = abs(row["strain_rate"])
        row["banded"] = row["density_wave"] > HOMOGENEOUS_DENSITY_WAVE
        rows.append(row)
    return rows


def series_key(row):
    """What rows of one curve have in common."""
    return tuple(row[name] for name in ("equation_of_state", "kernel", "cooling") + SETTINGS if name != "strain_rate")


def series_of(rows):
    """Rows of each fluid, in the order of the table, by increasing rate."""
    series = {}
    for row in rows:
        series.setdefault(series_key(row), []).append(row)
    return [sorted(members, key=lambda row: row["rate"]) for members in series.values()]


def fluid_name(row, others):
    """The fluid, and its settings as far as the series of the table differ in them."""
    text = FLUIDS.get(row["equation_of_state"], row["equation_of_state"])
    for name, label in (("particles", "$N$ = {:g}"), ("range", "$h$ = {:g}"), ("density", "$n$ = {:g}"),
                        ("start_temperature", "$kT$ = {:g}"), ("prescribed_viscosity", r"$\eta$ = {:g}")):
        if len({other[name] for other in others}) > 1:
            text += ", " + label.format(row[name])
    if row["kernel"] != "lucy":
        text += f", {row['kernel'].capitalize()}'s weight"
    if row["cooling"] == "none":
        text += ", not cooled"
    return text


def row_name(row):
    return f"{row['equation_of_state']}, viscosity {row['prescribed_viscosity']:g}, rate {row['strain_rate']:g}"


def points(axes, rows, quantity, colour, marker, logarithmic):
    """The finite values of `rows`; on a logarithmic axis those above zero, bars cut where they would reach zero."""
    for row in rows:
        value, error = row[quantity], row[quantity + "_error"]
        if not math.isfinite(value) or (logarithmic and value <= 0):
            continue
        if math.isfinite(error) and error > 0:
            down = min(error, value * (1 - 1e-6)) if logarithmic else error
            axes.errorbar(row["rate"], value, yerr=[[down], [error]], color=colour, capsize=2, elinewidth=0.9,
                          capthick=0.9, linestyle="none", zorder=3)
        axes.plot(row["rate"], value, linestyle="none", marker=marker, markersize=5, markeredgecolor=colour,
                  markerfacecolor="white" if row["banded"] else colour, zorder=4)
        if not math.isfinite(error):
            axes.plot(row["rate"], value, linestyle="none", marker="o", markersize=1.8, color="white", zorder=5)


def line(axes, rows, quantity, colour, logarithmic):
    """A thin line through what is homogeneous."""
    shown = [row for row in rows if math.isfinite(row[quantity]) and not row["banded"]
             and not (logarithmic and row[quantity] <= 0)]
    axes.plot([row["rate"] for row in shown], [row[quantity] for row in shown], color=colour, linewidth=0.8, alpha=0.6,
              zorder=2)


def plain_decimals(axis):
    """0.01, 0.02, 0.05, 0.1 ... along a logarithmic axis."""
    axis.set_major_formatter("{x:g}")
    axis.set_minor_locator(matplotlib.ticker.LogLocator(subs=(2, 5)))
    axis.set_minor_formatter("{x:g}")
    axis.set_tick_params(which="both", length=3.5, pad=3.5)


def rate_axis(axes, rows):
    rates = [row["rate"] for row in rows]
    axes.set(xscale="log", xlim=(min(rates) / 1.4, max(rates) * 1.4), xlabel=r"strain rate  $\dot\gamma$")
    plain_decimals(axes.xaxis)


def draw_parts(axes, rows, everything):
    rate_axis(axes, rows)
    axes.axhline(0, color="0.7", linewidth=0.8, zorder=1)
    axes.axhline(rows[0]["prescribed_viscosity"], color="black", linewidth=0.9, linestyle=(0, (5, 3)), zorder=1,
                 label=r"prescribed $\eta$")
    for (quantity, label, marker), colour in zip(PARTS, COLOURS):
        line(axes, rows, quantity, colour, logarithmic=False)
        points(axes, rows, quantity, colour, marker, logarithmic=False)
        axes.plot([], [], color=colour, marker=marker, markersize=5, linewidth=0.8, label=label)
    axes.set_ylabel(rf"$-P_{{xy}}/\dot\gamma$  [{VISCOSITY_UNIT}]")
    name = fluid_name(rows[0], [members[0] for members in everything])
    axes.set_title(name if "$N$" in name else f"{name}, $N$ = {rows[0]['particles']:g}", fontsize=10)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.22 * (high - low))  # room for the legend
    axes.legend(frameon=False, fontsize=8.5, loc="upper center", ncol=3, labelspacing=0.3, columnspacing=1.0,
                handlelength=1.6)


def draw_all(axes, everything, quantity, label):
    rate_axis(axes, [row for rows in everything for row in rows])
    axes.set_yscale("log")
    plain_decimals(axes.yaxis)
    for index, rows in enumerate(everything):
        colour, marker = COLOURS[index % len(COLOURS)], MARKERS[index % len(MARKERS)]
        line(axes, rows, quantity, colour, logarithmic=True)
        points(axes, rows, quantity, colour, marker, logarithmic=True)
    axes.set_ylabel(label)


def draw(everything, notes):
    main = max(everything, key=len)
    figure, (parts, excess, noise) = plt.subplots(1, 3, figsize=(12.2, 4.3),
                                                  gridspec_kw={"width_ratios": (1.15, 1, 1)})
    draw_parts(parts, main, everything)
    draw_all(excess, everything, "viscosity_excess", rf"viscosity beyond the prescribed  [{VISCOSITY_UNIT}]")
    draw_all(noise, everything, "kinetic_temperature", r"noise of the particles  $K/(N-1)$  [$\epsilon$]")
    heads = [members[0] for members in everything]
    handles = [excess.plot([], [], linestyle="none", marker=MARKERS[index % len(MARKERS)], markersize=5,
                           color=COLOURS[index % len(COLOURS)], label=fluid_name(head, heads))[0]
               for index, head in enumerate(heads)]
    if any(row["banded"] for rows in everything for row in rows):
        handles.append(excess.plot([], [], linestyle="none", marker="o", markersize=5, markerfacecolor="white",
                                   markeredgecolor="0.3", label="hollow: the flow has fallen into bands")[0])
    rows_of_legend = math.ceil(len(handles) / 4)
    figure.legend(handles=handles, loc="lower center", ncol=min(4, len(handles)), frameon=False, fontsize=8.5,
                  handletextpad=0.4, columnspacing=1.4)
    figure.tight_layout(rect=(0, 0.02 + 0.052 * rows_of_legend, 1, 1), w_pad=2.0)
    for rows in everything:
        for row in rows:
            absent = [name.replace("_", " ") for name in ("viscosity", "kinetic_temperature")
                      if not math.isfinite(row[name])]
            if absent:
                notes.append(f"{row_name(row)}: no {' and no '.join(absent)} (status {row['status']})")
            elif row["viscosity_excess"] <= 0:
                notes.append(f"{row_name(row)}: the viscosity is {-row['viscosity_excess']:.3g} below the prescribed "
                             "one (not shown in the middle)")
            if math.isfinite(row["viscosity"]) and not math.isfinite(row["viscosity_error"]):
                notes.append(f"{row_name(row)}: no error bar (white dots, status {row['status']})")
    return figure


def main():
    parser = argparse.ArgumentParser(description="The viscosity of sheared smooth particles against strain rate.")
    parser.add_argument("directory", type=pathlib.Path, help="directory with shear_flow.csv; the pictures go there too")
    directory = parser.parse_args().directory
    rows = read_table(directory / "shear_flow.csv")
    if not any(math.isfinite(row["viscosity"]) for row in rows):
        fail(f"{directory / 'shear_flow.csv'} has no row with a viscosity")
    plt.rcParams.update(lucy_tables.STYLE)
    notes = []
    lucy_tables.save(draw(series_of(rows), notes), directory, "shear_flow")
    for note in notes:
        print(f"shear-flow plot: {note}")


if __name__ == "__main__":
    main()
