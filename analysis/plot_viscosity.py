#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Viscosity and normal stress against strain rate, from the table.csv of a sweep, beside the published tables.

    plot_viscosity.py DIR [--reference REFERENCE]

writes DIR/viscosity.png and DIR/viscosity.svg. Filled symbols with one-sigma bars are ours, open ones are published
(Posch, Hoover and Kum, Phys. Rev. E 52, 1711 (1995)); a number of particles has one shape, an energy one colour.
Published points are shown where DIR/input.toml says that ours were run under the published conditions. Misprinted cells
are drawn as they should read; a value with a misprint that nobody can undo is drawn, faint, only beside a row of ours.

What logarithmic axes cannot show is not dropped: a value at or below zero is drawn as an arrow down from its two-sigma
upper bound, rows without a value are named on the terminal. A rate below zero is drawn at its absolute value. The band
covers the rates at which one particle takes more than a fifth of the kinetic energy; it ends midway, on the logarithmic
axis, to the next rate.
"""

import argparse
import math
import pathlib
import sys
import textwrap
import tomllib

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as missing:
    sys.exit(f"plot_viscosity.py needs numpy and matplotlib (Debian: python3-matplotlib): {missing}")

import lucy_tables
from lucy_tables import COLOURS, fail, number, read_rows

MARKERS = {64: "P", 100: "X", 256: "v", 400: "^", 1024: "o", 4096: "s", 16384: "D"}  # the same in every plot
OTHER_MARKERS = ("p", "<", ">", "h", "d", "*", "8")
PANELS = (
    ("viscosity", r"shear viscosity  $\eta = -\langle P_{xy}\rangle/\dot\gamma$"),
    ("normal_stress", r"normal stress  $(\langle P_{xx}\rangle-\langle P_{yy}\rangle)/\dot\gamma^{\,2}$"),
)
PUBLISHED_CONDITIONS = (  # section, key, and the value at which the published tables were computed
    ("system", "density", 1.0),
    ("kernel", "name", "lucy"),
    ("kernel", "range", 3.0),
    ("shear", "thermostat", "isoenergetic"),
)
UNSTABLE_SHARE = 0.2  # of the kinetic energy in one particle, on average
NOTE_LINES = 3
NOTE_WIDTH = 165  # characters


def read_table(path):
    wanted = ["particles", "energy_per_particle", "strain_rate", "largest_kinetic_share"]
    for name, _ in PANELS:
        wanted += [name, name + "_error"]
    rows = [{column: number(path, row, column) for column in wanted} | {"status": row["status"]}
            for row in read_rows(path, wanted + ["status"])]
    for row in rows:
        row["rate"] = abs(row["strain_rate"])
    return rows


def same_state(first, second):
    return all(math.isclose(abs(first[key]), abs(second[key]), rel_tol=1e-9)
               for key in ("particles", "energy_per_particle", "strain_rate"))


def mark_differences(rows, path):
    """Gives every row the conditions, as text, in which it differs from the published tables."""
    try:
        with open(path, "rb") as file:
            document = tomllib.load(file)
        points = document.get("point", [])

        def differences(point):
            values = [(key, point.get(key, document.get(section, {}).get(key, published)), published)
                      for section, key, published in PUBLISHED_CONDITIONS]
            return tuple(f"{'kernel ' if key in ('name', 'range') else ''}{key} = {value}"
                         for key, value, published in values if value != published)

        def matches(point, row):
            sections = document.get("system", {}) | document.get("shear", {}) | point
            return same_state({key: sections[key] for key in ("particles", "energy_per_particle", "strain_rate")}, row)

        for index, row in enumerate(rows):
            if not points:
                row["differences"] = differences({})
            elif len(points) == len(rows):
                row["differences"] = differences(points[index])
            else:  # the table of a sweep that has not ended
                found = [differences(point) for point in points if matches(point, row)]
                row["differences"] = max(found, default=("conditions unknown",))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError, AttributeError, KeyError, TypeError):
        for row in rows:
            row["differences"] = ("conditions unknown",)


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
            doubtful, corrected = set(), set()

            def cell(quantity):
                reading = corrections.get((int(row["particles"]), rate, quantity))
                if reading is not None:
                    (corrected if reading else doubtful).add("viscosity" if quantity[:3] == "pxy" else "normal_stress")
                return float(reading) if reading else number(path, row, quantity)

            shear = cell("pxy_kinetic") + cell("pxy_potential")
            normal = cell("pxx_kinetic") + cell("pxx_potential") - cell("pyy_kinetic") - cell("pyy_potential")
            published.append({
                "particles": int(row["particles"]),
                "energy_per_particle": number(entry["name"], entry, "energy_per_particle"),
                "strain_rate": rate,
                "rate": rate,
                "viscosity": -shear / rate,
                "normal_stress": normal / rate**2,
                "doubtful": doubtful,
                "corrected": corrected,
                "instability": row.get("instability_region") == "yes",
            })
    return published


def state(row):
    return f"N = {row['particles']:.0f}, E/N = {row['energy_per_particle']:g}, rate {row['strain_rate']:g}"


def comparable(published, rows, notes):
    """The published points that our rows can be compared with; says which are left out for another condition."""
    kept, reasons = [], {}
    for point in published:
        ours = [row for row in rows if row["energy_per_particle"] == point["energy_per_particle"]]
        ours = [row for row in ours if math.isclose(row["rate"], point["rate"], rel_tol=1e-9)] or ours
        if any(not row["differences"] for row in ours):
            kept.append(point)
        elif ours:
            for row in ours:
                reasons[row["differences"]] = True
    if reasons:
        texts = list(dict.fromkeys(text for reason in reasons for text in reason))
        if texts == ["conditions unknown"]:
            sentence = "published points are left out: no readable input.toml beside table.csv tells the conditions"
        else:
            sentence = (f"published points are {'in part ' if kept else ''}left out: they hold for density 1, kernel "
                        f"range 3 and thermostat isoenergetic, ours for {', '.join(texts)}")
        notes.add(sentence, sentence)
    return kept


class Notes:
    """What a reader has to be told: on the terminal row by row, in the figure one sentence for each kind."""

    def __init__(self):
        self.terminal = []
        self.kinds = {}

    def add(self, kind, sentence=None, row=None):
        """A kind of note; the sentence is for the terminal, the row is named in the figure."""
        places = self.kinds.setdefault(kind, [])
        if row is not None and f"{row['strain_rate']:g}" not in places:
            places.append(f"{row['strain_rate']:g}")
        if sentence and sentence not in self.terminal:
            self.terminal.append(sentence)

    def figure_lines(self):
        sentences = []
        for kind, places in self.kinds.items():
            where = ""
            if places:
                where = f" (rate {', '.join(places)})" if len(places) <= 5 else f" ({len(places)} rates)"
            sentences.append(kind[0].upper() + kind[1:] + where + ".")
        lines = textwrap.wrap(" ".join(sentences), NOTE_WIDTH, break_on_hyphens=False)
        if len(lines) > NOTE_LINES:
            rest = " ... (all notes: on the terminal)"
            lines = lines[:NOTE_LINES]
            lines[-1] = textwrap.shorten(lines[-1], NOTE_WIDTH - len(rest), placeholder="") + rest
        return lines


def missing_values(rows, notes):
    """Notes on rows, or parts of rows, that have no place on the axes."""
    for row in rows:
        if row["strain_rate"] == 0:
            notes.add("no viscosity at zero rate",
                      f"{state(row)}: there is no viscosity or normal stress at zero rate")
            continue
        absent = [name.replace("_", " ") for name, _ in PANELS if not math.isfinite(row[name])]
        bare = [name.replace("_", " ") for name, _ in PANELS
                if math.isfinite(row[name]) and not math.isfinite(row[name + "_error"])]
        if absent:
            notes.add("rows without a value are not shown",
                      f"{state(row)}: no {' and no '.join(absent)} (status {row['status']})", row)
        if bare:
            notes.add("white dots: no error bar",
                      f"{state(row)}: no error bar for {' and '.join(bare)} (white dots, status {row['status']})", row)


def value_limits(values):
    low, high = min(values), max(values)
    return low / 1.8, high * 1.8


def upper_bound(row, quantity):
    return row[quantity] + 2 * row[quantity + "_error"]


def draw_panel(axes, quantity, label, rows, published, style, notes):
    """Draws one quantity; notes what could not be drawn."""
    shown = [row for row in rows if row["rate"] > 0 and math.isfinite(row[quantity])]
    positive = [row for row in shown if row[quantity] > 0]
    bounds = [upper_bound(row, quantity) for row in shown if row[quantity] <= 0]
    values = [row[quantity] for row in positive + published if row[quantity] > 0] + [b for b in bounds if b > 0]
    rates = [row["rate"] for row in rows + published if row["rate"] > 0]
    rate_label = r"$|\dot\gamma|$" if any(row["strain_rate"] < 0 for row in rows) else r"$\dot\gamma$"
    axes.set(xscale="log", yscale="log", xlabel=f"strain rate  {rate_label}", ylabel=label)
    axes.set_xlim(min(rates) / 1.5, max(rates) * 1.5)
    if not values:
        axes.text(0.5, 0.5, "no positive value to show", transform=axes.transAxes, ha="center", color="0.4")
        for row in shown:
            notes.add(f"{quantity.replace('_', ' ')}: no positive value",
                      f"{quantity.replace('_', ' ')} at {state(row)} is {row[quantity]:.3g} "
                      f"+- {row[quantity + '_error']:.2g} (not shown)")
        return
    low, high = value_limits(values)
    axes.set_ylim(low, high)

    for row in published:
        if row[quantity] <= 0:
            notes.add("published values at or below zero are not shown",
                      f"published {quantity.replace('_', ' ')} at {state(row)} is {row[quantity]:.3g} (not shown)")
            continue
        doubtful = quantity in row["doubtful"]
        if doubtful and not any(same_state(row, ours) for ours in shown):
            continue
        axes.plot(row["rate"], row[quantity], linestyle="none", marker=style(row)[1], markersize=9,
                  markerfacecolor="none", markeredgecolor=style(row)[0], markeredgewidth=0.9,
                  alpha=0.35 if doubtful else 0.9, zorder=2)
        if doubtful:
            sentence = f"published {quantity.replace('_', ' ')} at {state(row)} (faint) contains a misprinted digit"
            notes.add(sentence, sentence)
        if quantity in row["corrected"]:  # for the reader of the figure only
            notes.add("misprinted published cells are drawn as they should read (reference/posch1995_errata.csv)")
    for row in positive:
        colour, marker = style(row)
        error = row[quantity + "_error"]
        known = math.isfinite(error)
        if known:  # a bar that reaches zero reaches the lower edge
            down = min(error, row[quantity] * (1 - 1e-6))
            axes.errorbar(row["rate"], row[quantity], yerr=[[down], [error]], color=colour, capsize=2.5,
                          elinewidth=1.0, capthick=1.0, linestyle="none", zorder=3)
        axes.plot(row["rate"], row[quantity], linestyle="none", marker=marker, markersize=5, color=colour,
                  markeredgecolor=colour, zorder=4)
        if not known:
            axes.plot(row["rate"], row[quantity], linestyle="none", marker="o", markersize=1.8, color="white",
                      zorder=5)
    for row in shown:
        if row[quantity] > 0:
            continue
        colour, marker = style(row)
        bound = upper_bound(row, quantity)
        text = f"{quantity.replace('_', ' ')} at {state(row)} is {row[quantity]:.3g} +- {row[quantity + '_error']:.2g}"
        if math.isfinite(bound) and bound > low:
            axes.annotate("", xy=(row["rate"], max(low * 1.05, bound / 3)), xytext=(row["rate"], bound),
                          arrowprops={"arrowstyle": "-|>", "color": colour, "shrinkA": 0, "shrinkB": 0})
            axes.plot(row["rate"], bound, linestyle="none", marker="_", markersize=9, color=colour)
            notes.add("arrow: value at or below zero, from its two-sigma upper bound",
                      text + " (arrow from its two-sigma upper bound)", row)
        else:
            axes.plot(row["rate"], 0.015, transform=axes.get_xaxis_transform(), linestyle="none",
                      marker=matplotlib.markers.CARETDOWN, color=colour, clip_on=False)
            notes.add("mark at the lower edge: value below zero", text + " (mark at the lower edge)", row)


def unstable_bands(rows, published):
    """Per energy the ranges of rate at which one particle takes much of the kinetic energy."""
    bands = {}
    affected = {}
    for row in rows + published:
        if row["rate"] > 0:
            unstable = row["instability"] if "instability" in row else row["largest_kinetic_share"] > UNSTABLE_SHARE
            rates = affected.setdefault(row["energy_per_particle"], {})
            rates[row["rate"]] = rates.get(row["rate"], False) or unstable
    for energy, rates in affected.items():
        found = lucy_tables.instability_bands(rates)
        if found:
            bands[energy] = found
    return bands


def band_style(colour):
    return {"facecolor": colour, "alpha": 0.13, "linewidth": 0}


def draw_legend(figure, axes, rows, published, style, bands):
    handles = []
    for energy, particles in sorted({(row["energy_per_particle"], row["particles"]) for row in rows}):
        colour, marker = style({"energy_per_particle": energy, "particles": particles})
        handles.append(axes.plot([], [], linestyle="none", marker=marker, markersize=5, color=colour,
                                 label=f"Lucy, $E/N$ = {energy:g}, $N$ = {particles:.0f}")[0])
    energies = {row["energy_per_particle"] for row in rows}
    for particles in sorted({row["particles"] for row in published}):
        colour, marker = style({"energy_per_particle": min(energies), "particles": particles})
        handles.append(axes.plot([], [], linestyle="none", marker=marker, markersize=9, markerfacecolor="none",
                                 markeredgewidth=0.9, markeredgecolor=colour if len(energies) == 1 else "0.3",
                                 label=f"published, $N$ = {particles:.0f}")[0])
    for energy in sorted(bands):
        colour, _ = style({"energy_per_particle": energy, "particles": rows[0]["particles"]})
        which = f", $E/N$ = {energy:g}" if len(energies) > 1 else ""
        label = f"one particle has over {100 * UNSTABLE_SHARE:.0f} % of $K${which}"
        handles.append(matplotlib.patches.Patch(label=label, **band_style(colour)))
    columns = min(len(handles), 4 if len(handles) > 6 else 3)
    figure.legend(handles=handles, loc="upper center", ncol=columns, frameon=False, handletextpad=0.4,
                  columnspacing=1.4, fontsize=9)
    return math.ceil(len(handles) / columns)


def markers_of(counts):
    """A marker for each number of particles, the same in every plot as far as there are markers."""
    markers = {count: MARKERS[count] for count in counts if count in MARKERS}
    for count in counts:
        if count not in markers:
            start = math.isqrt(int(count)) % len(OTHER_MARKERS)
            turns = [OTHER_MARKERS[(start + i) % len(OTHER_MARKERS)] for i in range(len(OTHER_MARKERS))]
            markers[count] = next((marker for marker in turns if marker not in markers.values()), turns[0])
    return markers


def has_mark(row):
    """Some value of the row can be drawn."""
    return row["rate"] > 0 and any(math.isfinite(row[name]) for name, _ in PANELS)


def something_to_plot(rows):
    return any(row["rate"] > 0 and math.isfinite(row[name]) and (row[name] > 0 or upper_bound(row, name) > 0)
               for row in rows for name, _ in PANELS)


def draw(rows, published, notes):
    missing_values(rows, notes)
    rows = [row for row in rows if has_mark(row)]
    energies = sorted({row["energy_per_particle"] for row in rows})
    published = comparable(published, rows, notes)
    conditions = {row["differences"] for row in rows}
    if len(conditions) > 1:
        sentence = "rows of different conditions share their symbols"
        notes.add(sentence, sentence + "; see input.toml")
    colours = {energy: COLOURS[i % len(COLOURS)] for i, energy in enumerate(energies)}
    markers = markers_of(sorted({row["particles"] for row in rows + published}))

    def style(row):
        return colours[row["energy_per_particle"]], markers[row["particles"]]

    figure, panels = plt.subplots(1, 2, figsize=(10, 5.2))
    bands = unstable_bands(rows, published)
    for axes, (quantity, label) in zip(panels, PANELS):
        draw_panel(axes, quantity, label, rows, published, style, notes)
        for energy, ranges in bands.items():
            for low, high in ranges:
                axes.axvspan(low, high, zorder=0, **band_style(colours[energy]))
        axes.tick_params(which="both", direction="in", top=True, right=True)
        axes.grid(True, which="major", color="0.92", linewidth=0.6)
        axes.set_axisbelow(True)
    legend_lines = draw_legend(figure, panels[0], rows, published, style, bands)
    text = notes.figure_lines()
    below, above = 0.145 * len(text) + (0.1 if text else 0), 0.21 * legend_lines + 0.12  # inches
    height = 4.4 + below + above
    figure.set_figheight(height)
    figure.tight_layout(rect=(0, below / height, 1, 1 - above / height))
    if text:
        figure.text(0.012, 0.08 / height, "\n".join(text), fontsize=7.5, color="0.3", va="bottom", linespacing=1.35)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, help="output directory of a sweep, with its table.csv")
    parser.add_argument("--reference", type=pathlib.Path, default=lucy_tables.REFERENCE,
                        help="directory of the published tables (default: the one shipped with Lucy)")
    options = parser.parse_args()
    rows = read_table(options.directory / "table.csv")
    if not rows:
        fail(f"{options.directory / 'table.csv'} has no rows")
    plt.rcParams.update(lucy_tables.STYLE)
    if not something_to_plot(rows):
        print(f"viscosity plot: not drawn, no row of {options.directory / 'table.csv'} has a value that logarithmic "
              "axes can show")
        return
    mark_differences(rows, options.directory / "input.toml")
    notes = Notes()
    lucy_tables.save(draw(rows, read_published(options.reference), notes), options.directory, "viscosity")
    for note in notes.terminal:
        print(f"viscosity plot: {note}")


if __name__ == "__main__":
    main()
