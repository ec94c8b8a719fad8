#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Decaying waves, from the tables of `lucy shear-wave` or `lucy temperature-wave`.

    plot_waves.py DIR [--green-kubo DIR]

writes DIR/amplitudes.png and .svg, and DIR/shear_wave.png and .svg (or temperature_wave). Bands and bars are one
standard error.

amplitudes: a(t) over the imposed amplitude against k^2 t, so that a diffusivity nu makes exp(-nu k^2 t) of any wave
vector. Points that differ in one setting share a panel; the preferred fits are thin lines, the constitutive law dotted.

The other: what diffusivity the points have, by parts; the local one against the gradient, in colour where a point
differs from the first one in prescribed transport or amplitude alone, or has no prescribed transport at all; the local
one against the noise of the particles, of shear waves without the share of the viscous operator, in colour where a
point has the fluid and the kernel of the first one; of shear waves the stress that pressure forces set against the
motion, against the strain, for the first point and those that differ from it in amplitude or size alone; and of atoms
nu(k) by the integral (or by parts, where there is no integral), beside the Green-Kubo values of the same states where
--green-kubo names the directory of `lucy green-kubo` (or its viscosity.csv).

Points without curves (those that failed) are named on the terminal.
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
    sys.exit(f"plot_waves.py needs numpy and matplotlib (Debian: python3-matplotlib): {missing}")

import lucy_tables
from lucy_tables import COLOURS

DIFFUSIVITY_UNIT = r"$\sigma\,\sqrt{\epsilon/m}$"
SCALED_TIME_UNIT = r"$\sigma^{-1}\sqrt{m/\epsilon}$"
QUANTITIES = ("operator", "carried", "total", "integral", "yield_stress")
NUMBERS = ("wave_vector", "prescribed", "imposed_amplitude", *(name + suffix for name in QUANTITIES
                                                              for suffix in ("", "_error")))
LOCAL = tuple(name + suffix for name in ("gradient", "diffusivity", "particle_noise") for suffix in ("", "_error"))
CURVES = ("time", "amplitude", "amplitude_error", "fit", "operator", "carried")
# Setting, its symbol in a label, its name as the title of a panel; a setting of words has no symbol.
SETTINGS = (("particles", "N", "number of particles"), ("density", "n", "density"), ("kernel", "", "weight function"),
            ("range", "h", "range"), ("equation_of_state", "", "equation of state"),
            ("temperature", "kT", "temperature"),
            ("viscosity", r"\eta", "viscosity"), ("bulk_viscosity", r"\eta_b", "bulk viscosity"),
            ("conductivity", r"\kappa", "conductivity"), ("density_mean", "", "mean of densities"),
            ("disorder", "disorder", "disorder of the start"), ("noise", "noise", "noise of the start"),
            ("uniform", "", "uniform at the start"), ("amplitude", "A", "amplitude"), ("mode", "mode", "mode"))
TRANSPORT = ("viscosity", "bulk_viscosity", "conductivity")
ANY_START = (*TRANSPORT, "particles", "disorder", "noise", "uniform", "amplitude", "mode")
LEAST_NOISE = 1e-6  # so little only breaks the symmetry of a lattice
WORDS = {"density_mean": "{} mean", "uniform": "uniform {}"}
OF_ATOMS, OF_OTHERS = "0.5", "0.8"
OPERATOR, REST, CARRIED, TOTAL = COLOURS[4], COLOURS[1], COLOURS[2], "black"
OF_SHEAR = {"stem": "shear_wave", "rest": "pressure_forces", "symbol": r"\nu", "name": "kinematic viscosity",
            "parts": ("viscous operator", "pressure forces", "carried"), "gradient": "strain rate  $k\\,a$"}
OF_TEMPERATURE = {"stem": "temperature_wave", "rest": "heating", "symbol": "D_T", "name": "thermal diffusivity",
                  "parts": ("conduction operator", "heating", "carried"), "gradient": "entropy gradient  $k\\,a$"}


class Point:
    """One line of the table: settings as text, numbers, and what else is known of it."""

    def __init__(self, path, row, number, kind):
        self.number = number
        self.status = row["status"]
        self.atoms = row.get("reading") == "md"
        self.settings = {name: row[name] for name, _, _ in SETTINGS}
        self.alike = dict(self.settings)  # for the comparison with others
        if not self.atoms and lucy_tables.number(path, row, "noise") <= LEAST_NOISE:
            self.alike["noise"] = "0"
        self.energy = lucy_tables.number(path, row, "energy_per_particle") if self.atoms else math.nan
        self.values = lucy_tables.numbers(path, row, NUMBERS + (kind["rest"], kind["rest"] + "_error"))
        self.curve = None
        self.local = []

    def value(self, name):
        return self.values[name], self.values[name + "_error"]

    def text(self, name):
        """How a setting is said in a label."""
        symbol = next(entry[1] for entry in SETTINGS if entry[0] == name)
        setting = self.settings[name]
        if not symbol:
            return WORDS.get(name, "{}").format(setting)
        number = f"{float(setting):g}"
        return f"{symbol} {number}" if symbol.isalpha() and len(symbol) > 2 else f"${symbol} = {number}$"

    def difference(self, base):
        """In what it differs from another point, in words."""
        if self.atoms:
            words = [f"atoms, $E/N = {self.energy:g}$", self.text("particles")]
            return ", ".join(words + ([self.text("mode")] if self.settings["mode"] != "1" else []))
        names = [name for name, _, _ in SETTINGS if base.atoms or self.settings[name] != base.settings[name]]
        return ", ".join(map(self.text, names)) or "as stated"


def read_points(directory, kind):
    path = directory / f"{kind['stem']}.csv"
    columns = tuple(name for name, _, _ in SETTINGS) + NUMBERS + (kind["rest"], kind["rest"] + "_error", "status")
    points = [Point(path, row, number, kind) for number, row in enumerate(lucy_tables.read_rows(path, columns), 1)]
    for name, attribute, wanted in (("amplitude.csv", "curve", CURVES), ("local.csv", "local", LOCAL)):
        rows = {}
        for row in lucy_tables.read_rows(directory / name, ("point",) + wanted):
            values = lucy_tables.numbers(directory / name, row, ("point",) + wanted)
            rows.setdefault(int(values["point"]), []).append([values[column] for column in wanted])
        for point in points:
            if point.number in rows:
                setattr(point, attribute, dict(zip(wanted, np.array(rows[point.number]).T)))
    return points


def groups_of(points):
    """(setting, points) that differ in that setting alone, sorted by it; the largest groups first, and none that shows
    only points that larger ones show. Atoms come last, by their energy."""
    fluids = [point for point in points if not point.atoms]
    found = []
    for name, _, _ in SETTINGS:
        alike = {}
        for point in fluids:
            rest = tuple(value for key, value in point.alike.items() if key != name)
            alike.setdefault(rest, []).append(point)
        found += [(name, group) for group in alike.values() if len({p.alike[name] for p in group}) > 1]
    found.sort(key=lambda entry: -len(entry[1]))  # stable: settings stay in their order
    shown, groups = set(), []
    for name, group in found:
        if {point.number for point in group} <= shown:
            continue
        shown |= {point.number for point in group}
        groups.append((name, sorted(group, key=lambda point: sorting_key(point.settings[name]))))
    left = [point for point in fluids if point.number not in shown]
    if left:
        groups.append((None, left))
    for energy in sorted({point.energy for point in points if point.atoms}):
        groups.append(("energy_per_particle", [point for point in points if point.atoms and point.energy == energy]))
    return groups


def sorting_key(setting):
    try:
        return (0, float(setting), "")
    except ValueError:
        return (1, 0.0, setting)


def colours_of(count):
    """From dark to light, or one by one where there are few."""
    return COLOURS[:count] if count <= 3 else [matplotlib.colormaps["viridis"](x) for x in np.linspace(0, 0.92, count)]


def band(axes, x, value, error, colour, **style):
    known = np.isfinite(value) & np.isfinite(error)
    axes.fill_between(x, value - error, value + error, where=known, color=colour, alpha=0.25, linewidth=0, **style)


def draw_amplitudes_panel(axes, name, group, base):
    end = 0.0
    laws = {}
    for point, colour in zip(group, colours_of(len(group))):
        values = point.values
        x = values["wave_vector"]**2 * point.curve["time"]
        scale = 1 / values["imposed_amplitude"]
        amplitude = scale * point.curve["amplitude"]
        below = np.flatnonzero(amplitude < 0.02)
        end = max(end, x[below[0]] * 1.6 if len(below) else x[-1])
        label = point.difference(base) if name is None or point.atoms else point.text(name)
        if point.atoms:
            label = f"{point.text('particles')}, {point.text('mode')}"
        band(axes, x, amplitude, scale * point.curve["amplitude_error"], colour, zorder=2)
        axes.plot(x, amplitude, color=colour, linewidth=1.3, zorder=3, label=label)
        axes.plot(x, scale * point.curve["fit"], color=colour, linewidth=0.6, linestyle="--", zorder=4)
        if values["prescribed"] >= 0:
            laws[values["prescribed"]] = colour
    axes.axhline(0, color="0.6", linewidth=0.6, zorder=0)
    end = min(end, max(point.values["wave_vector"]**2 * point.curve["time"][-1] for point in group))
    x = np.linspace(0, end, 100)
    for law, colour in laws.items():
        if law > 0:
            axes.plot(x, np.exp(-law * x), color=colour if len(laws) > 1 else "0.35", linewidth=0.9, linestyle=":",
                      zorder=1)
    axes.set_xlim(0, end)
    axes.tick_params(which="both", direction="in", top=True, right=True)
    axes.legend(fontsize=7.5, frameon=False, handlelength=1.4, labelspacing=0.25, borderaxespad=0.3)
    axes.set_title(title_of(name, group, base), loc="left", fontsize=9.5)


def lowest_of(points):
    """Of all curves, in units of the imposed amplitudes; -0.08 at most."""
    curves = [point.curve["amplitude"] / point.values["imposed_amplitude"] for point in points]
    return min(np.min(curve, where=np.isfinite(curve), initial=-0.08) for curve in curves)


def title_of(name, group, base):
    if name is None:
        return "others"
    if name == "energy_per_particle":
        return f"atoms, $E/N = {group[0].energy:g}$"
    title = next(entry[2] for entry in SETTINGS if entry[0] == name)
    if base.atoms:
        return title
    fixed = [group[0].text(other) for other, _, _ in SETTINGS
             if other != name and group[0].alike[other] != base.alike[other]]
    return title + (f" ({', '.join(fixed)})" if fixed else "")


def draw_amplitudes(points, kind):
    base = points[0]
    groups = groups_of(points)
    columns = min(3, len(groups))
    rows = math.ceil(len(groups) / columns)
    figure, grid = plt.subplots(rows, columns, figsize=(3.55 * columns + 0.4, 2.75 * rows + 0.35), squeeze=False,
                                sharey=True, layout="constrained")
    for axes in grid.flat[len(groups):]:
        axes.set_axis_off()
    grid.flat[0].set_ylim(lowest_of(points) - 0.04, 1.08)  # one for all
    for axes, (name, group) in zip(grid.flat, groups):
        draw_amplitudes_panel(axes, name, group, base)
    for index, axes in enumerate(grid.flat[:len(groups)]):
        if index % columns == 0:
            axes.set_ylabel(r"amplitude  $a(t)/A$")
        if index + columns >= len(groups):
            axes.set_xlabel(f"$k^2 t$   [{SCALED_TIME_UNIT}]")
    return figure


def draw_parts(axes, points, base, kind):
    """Stacked bars, negative parts to the left; a mark is the total, a line the constitutive law."""
    for place, point in enumerate(points):
        ends = {-1: 0.0, 1: 0.0}
        for name, colour in (("operator", OPERATOR), (kind["rest"], REST), ("carried", CARRIED)):
            value = point.values[name]
            if not math.isfinite(value) or value == 0:
                continue
            sign = 1 if value > 0 else -1
            axes.barh(place, value, left=ends[sign], height=0.72, color=colour, linewidth=0, zorder=2)
            ends[sign] += value
        total, error = point.value("total")
        if math.isfinite(total):
            axes.errorbar(total, place, xerr=error if math.isfinite(error) else None, color=TOTAL, marker="o",
                          markersize=3, capsize=1.8, elinewidth=0.9, linestyle="none", zorder=4)
        if math.isfinite(point.values["prescribed"]):
            axes.plot([point.values["prescribed"]] * 2, [place - 0.44, place + 0.44], color="0.25", linewidth=1.4,
                      zorder=3)
    axes.set_yticks(range(len(points)), [point.difference(base) if point is not base else "as stated"
                                         for point in points], fontsize=8)
    axes.set_ylim(len(points) - 0.4, -0.6)
    axes.axvline(0, color="0.6", linewidth=0.6, zorder=1)
    axes.tick_params(which="both", direction="in", top=True)
    axes.tick_params(axis="y", length=0)


def add_legend_of_parts(axes, kind):
    handles = [matplotlib.patches.Patch(facecolor=colour, linewidth=0) for colour in (OPERATOR, REST, CARRIED)]
    handles += [matplotlib.lines.Line2D([], [], color=TOTAL, marker="o", markersize=3, linestyle="none"),
                matplotlib.lines.Line2D([], [], color="0.25", linewidth=1.4, marker="|", linestyle="none",
                                        markersize=9, markeredgewidth=1.4)]
    axes.legend(handles, [*kind["parts"], "sum", "constitutive law"], fontsize=8, frameon=False, ncol=5,
                loc="lower center", bbox_to_anchor=(0.5, 1.0), columnspacing=1.0, handlelength=1.0, handletextpad=0.4)


def colours_by_law(points):
    """A colour for each prescribed value among the points that are in colour."""
    values = sorted({point.values["prescribed"] for point in points if is_in_colour(point, points[0], ANY_START)})
    return dict(zip(values, colours_of(len(values))))


def differs_only_in(point, base, names):
    return not (point.atoms or base.atoms) and all(value == base.alike[name] for name, value in point.alike.items()
                                                   if name not in names)


def is_in_colour(point, base, names=(*TRANSPORT, "amplitude")):
    """Whether a point differs in these settings alone, or is a gas without prescribed transport."""
    if point.atoms or base.atoms:
        return False
    return point.values["prescribed"] == 0 or differs_only_in(point, base, names)


def use_short_logarithms(axes):
    """A logarithmic ordinate of a decade or two, with numbers at 1, 2 and 5; none where nothing positive is drawn."""
    if not math.isfinite(axes.dataLim.minpos[1]):
        return
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())


def draw_local(axes, points, kind, against, colours, **coloured):
    """Local diffusivities against the gradient, or against the noise; of shear waves then without the operator's."""
    beyond = kind is OF_SHEAR and against == "particle_noise"
    for point in points:
        if not point.local:
            continue
        x, x_error = point.local[against], point.local[against + "_error"]
        y, y_error = point.local["diffusivity"], point.local["diffusivity_error"]
        if beyond:
            y = y - np.nan_to_num(point.values["operator"])
        shown = (x > 0) & (y > 0) & ~(y_error > 0.5 * y)
        if not shown.any():
            continue
        style = {"marker": "D" if point.atoms else "o", "linewidth": 0.6}
        if is_in_colour(point, points[0], **coloured):
            axes.errorbar(x[shown], y[shown], xerr=np.nan_to_num(x_error[shown]), yerr=np.nan_to_num(y_error[shown]),
                          color=colours[point.values["prescribed"]], markersize=3, elinewidth=0.6, zorder=3, **style)
        else:
            axes.plot(x[shown], y[shown], color=OF_ATOMS if point.atoms else OF_OTHERS, markersize=2, zorder=2, **style)
    axes.set_xscale("log")
    use_short_logarithms(axes)
    axes.tick_params(which="both", direction="in", top=True, right=True)
    axes.set_ylabel(f"local  ${kind['symbol']}${' less operator' * beyond}   [{DIFFUSIVITY_UNIT}]")


def pressure_stress(point):
    """Amplitudes of strain and of the stress of pressure forces, with the error of the latter, in windows of a twelfth
    of the record that overlap by half, as long as the mean amplitude is above 5 % of the one imposed.

    Strain: k times the integral of a. Stress: what momentum the mean amplitude lost in the window beyond what viscous
    forces and moving particles took, over k and the window's length; its error is that of the amplitudes at both
    ends."""
    curve, k = point.curve, point.values["wave_vector"]
    window = max(2, len(curve["time"]) // 12)
    starts = np.arange(0, len(curve["time"]) - window, window // 2)
    low = np.flatnonzero(curve["amplitude"] < 0.05 * point.values["imposed_amplitude"])
    if len(low):
        starts = starts[starts + window <= low[0]]
    ends = starts + window

    def integral(rate):
        steps = np.diff(curve["time"]) * (rate[1:] + rate[:-1]) / 2
        return np.concatenate(([0.0], np.cumsum(steps)))

    strain, rest = k * integral(curve["amplitude"]), integral(curve["operator"] + curve["carried"]) - curve["amplitude"]
    scale = float(point.settings["density"]) / (k * (curve["time"][ends] - curve["time"][starts]))
    error = np.hypot(curve["amplitude_error"][starts], curve["amplitude_error"][ends])
    return (strain[starts] + strain[ends]) / 2, scale * (rest[ends] - rest[starts]), scale * error


def draw_stresses(axes, points):
    """Stress against strain of the first point and of those that differ from it in amplitude or in size alone."""
    base = points[0]
    for name, style in (("amplitude", {"marker": "o", "linestyle": "-"}), ("particles", {"marker": "s",
                                                                                      "linestyle": "--"})):
        group = [point for point in points if differs_only_in(point, base, (name,))]
        group.sort(key=lambda point: float(point.settings[name]))
        if name == "particles":
            group = [point for point in group if point is not base]
        for point, colour in zip(group, colours_of(len(group)) if name == "amplitude" else COLOURS[1::2]):
            strain, stress, error = pressure_stress(point)
            shown = (stress > 0) & ~(error > 0.5 * stress)
            axes.errorbar(strain[shown], stress[shown], yerr=np.nan_to_num(error[shown]), color=colour, markersize=3,
                          linewidth=0.9, elinewidth=0.6, label=point.text(name), **style)
    if math.isfinite(axes.dataLim.minpos[1]):
        axes.set_xscale("log")
        use_short_logarithms(axes)
    axes.set_xlabel(r"strain  $k \int \; a\,\mathrm{d}t$")
    axes.set_ylabel(f"stress of pressure forces   [{lucy_tables.PRESSURE_UNIT}]")
    axes.tick_params(which="both", direction="in", top=True, right=True)
    axes.legend(fontsize=8, frameon=False, ncol=2)


def read_green_kubo(path):
    path = path / "viscosity.csv" if path.is_dir() else path
    columns = ("energy_per_particle", "particles", "viscosity", "viscosity_error")
    return [lucy_tables.numbers(path, row, columns) for row in lucy_tables.read_rows(path, columns)]


def draw_wave_vectors(axes, atoms, green_kubo):
    """nu(k) by the integral; Green-Kubo values stand at the left, where k would be 0."""
    energies = sorted({point.energy for point in atoms})
    largest = max(point.values["wave_vector"] for point in atoms)
    for energy, colour in zip(energies, COLOURS):
        group = [point for point in atoms if point.energy == energy]
        k = [point.values["wave_vector"] for point in group]
        values = [point.value("integral" if math.isfinite(point.values["integral"]) else "total") for point in group]
        axes.errorbar(k, [value for value, _ in values], yerr=np.nan_to_num([error for _, error in values]),
                      color=colour, marker="o",
                      markersize=4, capsize=2, linestyle="none", zorder=3, label=f"$E/N = {energy:g}$, waves")
        found = [row for row in green_kubo if math.isclose(row["energy_per_particle"], energy, rel_tol=1e-9)]
        if found:
            density = float(group[0].settings["density"])
            size = np.linspace(0, 0.012 * largest * (len(found) - 1), len(found))
            axes.errorbar(size, [row["viscosity"] / density for row in found],
                          yerr=np.nan_to_num([row["viscosity_error"] / density for row in found]), color=colour,
                          marker="s", markerfacecolor="white", markersize=4.5, capsize=2, linestyle="none", zorder=3,
                          label=f"$E/N = {energy:g}$, Green-Kubo")
    use_short_logarithms(axes)
    axes.set_xlim(-0.04 * largest, 1.08 * largest)
    axes.set_xlabel(r"wave vector  $k$   [$1/\sigma$]")
    axes.set_ylabel(r"$\nu(k)$ of atoms   [" + DIFFUSIVITY_UNIT + "]")
    axes.tick_params(which="both", direction="in", top=True, right=True)
    axes.legend(fontsize=8, frameon=False)


def draw_summary(points, kind, green_kubo):
    atoms = [point for point in points if point.atoms and math.isfinite(point.values["total"])]
    stresses = kind is OF_SHEAR and not points[0].atoms
    panels = 2 + stresses + bool(atoms)
    height = max(2.9 * panels + 0.4, 0.2 * len(points) + 1.1)
    figure = plt.figure(figsize=(11.2, height), layout="constrained")
    grid = figure.add_gridspec(panels, 2, width_ratios=(1.25, 1))
    # Atoms have a scale of their own.
    kinds = [some for some in ([p for p in points if not p.atoms], [p for p in points if p.atoms]) if some]
    places = grid[:, 0].subgridspec(len(kinds), 1, height_ratios=[len(some) + 0.2 for some in kinds])
    bars = [figure.add_subplot(places[index]) for index in range(len(kinds))]
    for axes, some in zip(bars, kinds):
        draw_parts(axes, some, points[0], kind)
    add_legend_of_parts(bars[0], kind)
    bars[-1].set_xlabel(f"{kind['name']}  ${kind['symbol']}$   [{DIFFUSIVITY_UNIT}]")
    colours = colours_by_law(points)
    by_gradient, by_noise = figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1])
    draw_local(by_gradient, points, kind, "gradient", colours)
    draw_local(by_noise, points, kind, "particle_noise", colours, names=ANY_START)
    handles = [matplotlib.lines.Line2D([], [], color=colour, marker="o", markersize=3, linewidth=0.6)
               for colour in colours.values()]
    labels = [f"prescribed ${value:g}$" if index == 0 else f"${value:g}$" for index, value in enumerate(colours)]
    for label, colour, marker, there in (
            ("others", OF_OTHERS, "o", any(not (p.atoms or is_in_colour(p, points[0])) for p in points)),
            ("atoms", OF_ATOMS, "D", any(point.atoms for point in points))):
        if there:
            handles.append(matplotlib.lines.Line2D([], [], color=colour, marker=marker, markersize=3, linewidth=0.6))
            labels.append(label)
    across = 5
    by_row = [index for column in range(across) for index in range(column, len(handles), across)]  # it goes by columns
    by_gradient.legend([handles[index] for index in by_row], [labels[index] for index in by_row], fontsize=8,
                       frameon=False, ncol=across, loc="lower left", bbox_to_anchor=(-0.12, 1.0), columnspacing=1.0,
                       handlelength=1.6, handletextpad=0.4)
    by_gradient.set_xlabel(kind["gradient"])
    by_noise.set_xlabel(r"kinetic energy per particle beyond the wave's   [$\epsilon$]")
    if stresses:
        draw_stresses(figure.add_subplot(grid[2, 1]), points)
    if atoms:
        draw_wave_vectors(figure.add_subplot(grid[panels - 1, 1]), atoms, green_kubo)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path,
                        help="output directory of `lucy shear-wave` or `lucy temperature-wave`")
    parser.add_argument("--green-kubo", type=pathlib.Path,
                        help="output directory of `lucy green-kubo`, or its viscosity.csv, to draw its values too")
    options = parser.parse_args()
    kind = OF_TEMPERATURE if (options.directory / "temperature_wave.csv").exists() else OF_SHEAR
    points = read_points(options.directory, kind)
    if not points:
        lucy_tables.fail(f"{options.directory / kind['stem']}.csv has no rows")
    green_kubo = read_green_kubo(options.green_kubo) if options.green_kubo else []
    for point in points:
        if point.curve is None:
            print(f"wave plots: point {point.number} has no curve (status {point.status})")
    points = [point for point in points if point.curve is not None]
    if not points:
        print("wave plots: not drawn, no point has a curve")
        return
    plt.rcParams.update(lucy_tables.STYLE)
    lucy_tables.save(draw_amplitudes(points, kind), options.directory, "amplitudes")
    lucy_tables.save(draw_summary(points, kind, green_kubo), options.directory, kind["stem"])


if __name__ == "__main__":
    main()
