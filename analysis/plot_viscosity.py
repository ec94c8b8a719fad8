#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Viscosity and normal stress against strain rate, from the table.csv of a sweep, beside the published tables.

    plot_viscosity.py DIR [--reference REFERENCE]

writes DIR/viscosity.png and DIR/viscosity.svg. Filled symbols with one-sigma bars are ours, open ones are published
(Posch, Hoover and Kum, Phys. Rev. E 52, 1711 (1995)). What logarithmic axes cannot show is not dropped: a value at or
below zero is drawn as an arrow down from its two-sigma upper bound, and rows without a value are named below the plot.
"""

import argparse
import csv
import math
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as missing:
    sys.exit(f"plot_viscosity.py needs numpy and matplotlib (Debian: python3-matplotlib): {missing}")

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")  # told apart by everyone
MARKERS = ("o", "s", "^", "D", "v", "P", "X")
PANELS = (
    ("viscosity", r"shear viscosity  $\eta = -\langle P_{xy}\rangle/\dot\gamma$"),
    ("normal_stress", r"normal stress  $(\langle P_{xx}\rangle-\langle P_{yy}\rangle)/\dot\gamma^{\,2}$"),
)
NOTES_SHOWN = 6


def fail(sentence):
    print(f"plot_viscosity.py: {sentence}", file=sys.stderr)
    sys.exit(2)


def read_rows(path, columns):
    """Rows of a CSV file as dictionaries; the file must have these columns."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            rows = list(reader)
            header = reader.fieldnames or []
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        fail(f"cannot read {path}: {error}")
    for column in columns:
        if column not in header:
            fail(f"{path}: the header has no column {column}")
    return rows


def number(path, row, column):
    try:
        return float(row[column])
    except (TypeError, ValueError):
        fail(f'{path}: {column} is "{row[column]}" where a number was expected')


def read_table(path):
    wanted = ["particles", "energy_per_particle", "strain_rate", "largest_kinetic_share"]
    for name, _ in PANELS:
        wanted += [name, name + "_error"]
    return [{column: number(path, row, column) for column in wanted} | {"status": row["status"]}
            for row in read_rows(path, wanted + ["status"])]


def read_published(reference):
    """Published rows with both quantities; misprinted cells as they should read, where that is known."""
    if not (reference / "index.csv").is_file():
        return []
    published = []
    for entry in read_rows(reference / "index.csv", ["name", "energy_per_particle", "errata"]):
        path = reference / f"{entry['name']}.csv"
        corrections = {}
        if entry["errata"]:
            for erratum in read_rows(reference / entry["errata"], ["table", "particles", "strain_rate", "quantity"]):
                if erratum["table"] == entry["name"]:
                    key = (int(erratum["particles"]), float(erratum["strain_rate"]), erratum["quantity"])
                    corrections[key] = erratum["reading"]
        for row in read_rows(path, ["particles", "strain_rate", "pxy_kinetic", "pxy_potential", "pyy_potential"]):
            rate = number(path, row, "strain_rate")
            doubtful = set()

            def cell(quantity):
                reading = corrections.get((int(row["particles"]), rate, quantity))
                if reading == "":
                    doubtful.add(quantity[:3])
                return float(reading) if reading else number(path, row, quantity)

            shear = cell("pxy_kinetic") + cell("pxy_potential")
            normal = cell("pxx_kinetic") + cell("pxx_potential") - cell("pyy_kinetic") - cell("pyy_potential")
            published.append({
                "particles": int(row["particles"]),
                "energy_per_particle": number(entry["name"], entry, "energy_per_particle"),
                "strain_rate": rate,
                "viscosity": -shear / rate,
                "normal_stress": normal / rate**2,
                "doubtful": {"normal_stress"} if doubtful & {"pxx", "pyy"} else set(),
                "instability": row.get("instability_region") == "yes",
            })
    return published


def state(row):
    return f"N = {row['particles']:.0f}, E/N = {row['energy_per_particle']:g}, rate {row['strain_rate']:g}"


def stands_out(row):
    """One particle carries much more of K than the largest of N independent ones would."""
    count = max(row["particles"], 2)
    return row["largest_kinetic_share"] > 4 * (math.log(count) + np.euler_gamma) / count


def missing_values(rows):
    """Notes on rows, or parts of rows, that have no place on the axes."""
    notes = []
    for row in rows:
        if row["strain_rate"] == 0:
            notes.append(f"{state(row)}: there is no viscosity or normal stress at zero rate")
            continue
        if row["strain_rate"] < 0:
            notes.append(f"{state(row)}: not shown, the rate is negative")
            continue
        absent = [name.replace("_", " ") for name, _ in PANELS if not math.isfinite(row[name])]
        bare = [name.replace("_", " ") for name, _ in PANELS
                if math.isfinite(row[name]) and not math.isfinite(row[name + "_error"])]
        if absent:
            notes.append(f"{state(row)}: no {' and no '.join(absent)} (status {row['status']})")
        if bare:
            notes.append(f"{state(row)}: no error bar for {' and '.join(bare)} (white dots, status {row['status']})")
    return notes


def value_limits(values):
    low, high = min(values), max(values)
    return low / 1.8, high * 1.8


def draw_panel(axes, quantity, label, rows, published, style):
    """Draws one quantity; returns notes on what could not be drawn."""
    notes = []
    shown = [row for row in rows if row["strain_rate"] > 0 and math.isfinite(row[quantity])]
    positive = [row for row in shown if row[quantity] > 0]
    values = [row[quantity] for row in positive + published if row[quantity] > 0]
    rates = [row["strain_rate"] for row in shown + published if row["strain_rate"] > 0]
    axes.set(xscale="log", yscale="log", xlabel=r"strain rate  $\dot\gamma$", ylabel=label)
    if not values:
        axes.text(0.5, 0.5, "no positive value to show", transform=axes.transAxes, ha="center", color="0.4")
        return [f"{quantity}: no positive value"]
    bounds = [row[quantity] + 2 * row[quantity + "_error"] for row in shown if row[quantity] <= 0]
    low, high = value_limits(values + [bound for bound in bounds if bound > 0])
    axes.set_ylim(low, high)
    axes.set_xlim(min(rates) / 1.5, max(rates) * 1.5)

    for row in published:
        if row[quantity] <= 0:
            notes.append(f"published {quantity.replace('_', ' ')} at {state(row)} is {row[quantity]:.3g} (not shown)")
            continue
        doubtful = quantity in row["doubtful"]
        axes.plot(row["strain_rate"], row[quantity], linestyle="none", marker=style(row)[1], markersize=9,
                  markerfacecolor="none", markeredgecolor=style(row)[0], markeredgewidth=0.9,
                  alpha=0.35 if doubtful else 0.9, zorder=2)
        if doubtful:
            notes.append(f"published normal stress at {state(row)} (faint) contains a misprinted digit")
    for row in positive:
        colour, marker = style(row)
        error = row[quantity + "_error"]
        known = math.isfinite(error)
        if known:  # a bar that reaches zero reaches the lower edge
            down = min(error, row[quantity] * (1 - 1e-6))
            axes.errorbar(row["strain_rate"], row[quantity], yerr=[[down], [error]], color=colour, capsize=2.5,
                          elinewidth=1.0, capthick=1.0, linestyle="none", zorder=3)
        axes.plot(row["strain_rate"], row[quantity], linestyle="none", marker=marker, markersize=5, color=colour,
                  markeredgecolor=colour, zorder=4)
        if not known:
            axes.plot(row["strain_rate"], row[quantity], linestyle="none", marker="o", markersize=1.8, color="white",
                      zorder=5)
    for row in shown:
        if row[quantity] > 0:
            continue
        colour, marker = style(row)
        bound = row[quantity] + 2 * row[quantity + "_error"]
        text = f"{quantity.replace('_', ' ')} at {state(row)} is {row[quantity]:.3g} +- {row[quantity + '_error']:.2g}"
        if math.isfinite(bound) and bound > low:
            axes.annotate("", xy=(row["strain_rate"], max(low * 1.05, bound / 3)), xytext=(row["strain_rate"], bound),
                          arrowprops={"arrowstyle": "-|>", "color": colour, "shrinkA": 0, "shrinkB": 0})
            axes.plot(row["strain_rate"], bound, linestyle="none", marker="_", markersize=9, color=colour)
            notes.append(text + " (arrow from its two-sigma upper bound)")
        else:
            axes.plot(row["strain_rate"], 0.015, transform=axes.get_xaxis_transform(), linestyle="none",
                      marker=matplotlib.markers.CARETDOWN, color=colour, clip_on=False)
            notes.append(text + " (mark at the lower edge)")
    return notes


def shade_instability(axes, rows, published, colours):
    """One band per energy over the rates at which one particle takes much of the kinetic energy."""
    drawn = False
    for energy, colour in colours.items():
        rates = [row["strain_rate"] for row in published if row["instability"] and row["energy_per_particle"] == energy]
        rates += [row["strain_rate"] for row in rows
                  if row["energy_per_particle"] == energy and row["strain_rate"] > 0 and stands_out(row)]
        if rates:
            axes.axvspan(min(rates) / 1.06, max(rates) * 1.06, color=colour, alpha=0.13, linewidth=0, zorder=0)
            drawn = True
    return drawn


def draw_legend(figure, axes, rows, published, style, shaded):
    handles = []
    for energy, particles in sorted({(row["energy_per_particle"], row["particles"]) for row in rows}):
        colour, marker = style({"energy_per_particle": energy, "particles": particles})
        handles.append(axes.plot([], [], linestyle="none", marker=marker, markersize=5, color=colour,
                                 label=f"$E/N$ = {energy:g}, $N$ = {particles:.0f}")[0])
    if published:
        handles.append(axes.plot([], [], linestyle="none", marker="o", markersize=9, markerfacecolor="none",
                                 color="0.3", label="published (open)")[0])
    if shaded:
        handles.append(matplotlib.patches.Patch(facecolor="0.85", label="one particle takes much of $K$"))
    figure.legend(handles=handles, loc="upper center", ncol=min(len(handles), 4), frameon=False,
                  handletextpad=0.4, columnspacing=1.4)
    return math.ceil(len(handles) / 4)


def draw(rows, published):
    energies = sorted({row["energy_per_particle"] for row in rows})
    published = [row for row in published if row["energy_per_particle"] in energies]
    counts = sorted({row["particles"] for row in rows + published})
    colours = {energy: COLOURS[i % len(COLOURS)] for i, energy in enumerate(energies)}
    markers = {count: MARKERS[i % len(MARKERS)] for i, count in enumerate(counts)}

    def style(row):
        return colours[row["energy_per_particle"]], markers[row["particles"]]

    figure, panels = plt.subplots(1, 2, figsize=(10, 5.2))
    notes = missing_values(rows)
    shaded = False
    for axes, (quantity, label) in zip(panels, PANELS):
        notes += draw_panel(axes, quantity, label, rows, published, style)
        shaded = shade_instability(axes, rows, published, colours) or shaded
        axes.tick_params(which="both", direction="in", top=True, right=True)
        axes.grid(True, which="major", color="0.92", linewidth=0.6)
        axes.set_axisbelow(True)
    legend_lines = draw_legend(figure, panels[0], rows, published, style, shaded)
    text = notes[:NOTES_SHOWN]
    if len(notes) > NOTES_SHOWN:
        text.append(f"and {len(notes) - NOTES_SHOWN} more, listed when the script runs")
    lines = len(text)
    below, above = 0.145 * lines + (0.15 if lines else 0), 0.22 * legend_lines + 0.15  # inches
    height = 4.4 + below + above
    figure.set_figheight(height)
    figure.tight_layout(rect=(0, below / height, 1, 1 - above / height))
    if text:
        figure.text(0.012, 0.08 / height, "\n".join(text), fontsize=7.5, color="0.3", va="bottom", linespacing=1.35)
    return figure, notes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, help="output directory of a sweep, with its table.csv")
    parser.add_argument("--reference", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parent.parent / "reference",
                        help="directory of the published tables (default: the one shipped with Lucy)")
    options = parser.parse_args()
    rows = read_table(options.directory / "table.csv")
    if not rows:
        fail(f"{options.directory / 'table.csv'} has no rows")
    plt.rcParams.update({"font.size": 10, "axes.linewidth": 0.8, "svg.hashsalt": "lucy", "mathtext.fontset": "cm"})
    figure, notes = draw(rows, read_published(options.reference))
    for name, metadata in (("viscosity.png", {"Software": None}), ("viscosity.svg", {"Date": None})):
        temporary = options.directory / f".{name}.tmp"
        try:
            figure.savefig(temporary, format=name[-3:], dpi=200, metadata=metadata)
            temporary.replace(options.directory / name)
        except OSError as error:
            temporary.unlink(missing_ok=True)
            print(f"plot_viscosity.py: cannot write {options.directory / name}: {error}", file=sys.stderr)
            sys.exit(1)
    for note in notes:
        print(f"viscosity plot: {note}")


if __name__ == "__main__":
    main()
