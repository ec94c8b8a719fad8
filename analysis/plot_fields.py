#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The fields that `lucy fields` found, as maps, and their power spectra.

    plot_fields.py DIR          reads DIR/fields.h5, writes fields.png, .svg and spectra.png, .svg into DIR

Maps: density; the smoothed velocity (arrows) over its speed, of sheared particles without the mean flow; temperature
(by the fluid's equation of state; of atoms the kinetic one); pressure. Spectra are divided by the variance of their
field, and end where the grid's rings of |k| are no longer whole.
"""

import argparse
import pathlib
import sys

from lucy_tables import COLOURS, PRESSURE_UNIT, STYLE, fail, save

try:
    import matplotlib

    matplotlib.use("Agg")
    import h5py
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter
except ImportError as missing:
    sys.exit(f"plot_fields.py needs numpy, matplotlib and h5py (Debian: python3-matplotlib, python3-h5py): {missing}")

ARROWS = 20  # along the longer edge
MEDIA = {b"atoms": "atoms", b"isentropic": "isentropic fluid", b"ideal-gas": "ideal gas",
         b"van-der-waals": "van der Waals fluid", b"dense-fluid": "dense fluid"}
SPEED_UNIT = r"$\sqrt{\epsilon/m}$"
LABELS = {
    "density": r"density $\rho$",
    "internal_energy": r"internal energy $e$",
    "temperature": r"temperature $kT$",
    "kinetic_temperature": r"kinetic temperature $kT_{\rm kin}$",
    "pressure": r"pressure $P$",
    "velocity_smoothed": "smoothed velocity",
    "velocity_smoothed_peculiar": "smoothed velocity, peculiar",
}


def read(path):
    try:
        with h5py.File(path, "r") as file:
            return {
                "provenance": dict(file["provenance"].attrs),
                "parameters": dict(file["parameters"].attrs),
                "x": file["grid/x"][...],
                "y": file["grid/y"][...],
                "edges": file["grid"].attrs["edges"],
                "offset": float(file["grid"].attrs["offset"]),
                "fields": {name: field[...] for name, field in file["fields"].items()},
                "spectra": {name: {key: values[...] for key, values in spectrum.items()}
                            for name, spectrum in file["spectra"].items()},
                "whole_up_to": float(file["spectra"].attrs["whole_up_to"]),
            }
    except (OSError, KeyError) as error:
        fail(f"cannot read {path} as fields of Lucy: {error}")


def title(data):
    provenance, parameters = data["provenance"], data["parameters"]
    words = [rf"$N$ = {parameters['particles']}, {MEDIA[bytes(parameters['medium'])]}"]
    if parameters["strain_rate"] != 0:
        words.append(rf"$\dot\gamma$ = {parameters['strain_rate']:g}")
    if provenance["frames"] == 1:
        words.append(f"$t$ = {provenance['time']:g}")
    else:
        words.append(f"average over {provenance['frames']} frames, $t$ = {provenance['first_time']:g} to "
                     f"{provenance['time']:g}")
    weight = "Lucy" if parameters["kernel"] == b"lucy" else "Monaghan"
    words.append(rf"{weight} weight, $h$ = {parameters['range']:g} $\sigma$")
    return ",   ".join(words)


def velocity_name(data):
    """Of sheared particles the mean flow would hide everything else."""
    return "velocity_smoothed_peculiar" if "velocity_smoothed_peculiar" in data["fields"] else "velocity_smoothed"


def closed(data, values):
    """The map with its first column and row once more at the far edges, the row displaced by the sliding image."""
    wide = np.hstack([values, values[:, :1]])
    offset = data["offset"] if data["provenance"]["frames"] == 1 else 0.0
    x = np.append(data["x"], data["edges"][0])
    return np.vstack([wide, np.interp(x - offset, data["x"], values[0], period=data["edges"][0])])


def draw_map(axes, data, values, colours, label):
    half = [data["edges"][d] / len(data["xy"[d]]) / 2 for d in range(2)]
    (width, height) = data["edges"]
    image = axes.imshow(closed(data, values), origin="lower", cmap=colours, interpolation="bilinear", aspect="equal",
                        extent=(-half[0], width + half[0], -half[1], height + half[1]))
    bar = axes.figure.colorbar(image, ax=axes, fraction=0.046, pad=0.03)
    bar.outline.set_linewidth(0.6)
    bar.ax.tick_params(labelsize=8, width=0.6)
    axes.set_title(label, fontsize=10)
    axes.set(xlim=(0, width), ylim=(0, height))


def draw_arrows(axes, data, velocity):
    """Every few nodes; the fastest arrow bridges the distance to the next."""
    every = max(1, round(max(velocity.shape[:2]) / ARROWS))
    rows, columns = (np.arange(every // 2, length, every) for length in velocity.shape[:2])
    shown = velocity[np.ix_(rows, columns)]
    fastest = np.nanmax(np.hypot(shown[..., 0], shown[..., 1]))
    if not fastest > 0:
        return
    spacing = every * data["edges"][0] / len(data["x"])
    axes.quiver(data["x"][columns], data["y"][rows], shown[..., 0], shown[..., 1], angles="xy", scale_units="xy",
                scale=fastest / (1.15 * spacing), width=0.0042, color="white", edgecolor="black", linewidth=0.3,
                pivot="middle")


def draw_fields(data):
    fields = data["fields"]
    velocity = fields[velocity_name(data)]
    speed = np.hypot(velocity[..., 0], velocity[..., 1])
    temperature = "temperature" if "temperature" in fields else "kinetic_temperature"
    panels = [("density", fields["density"], "viridis", r"$m/\sigma^2$"),
              (velocity_name(data), speed, "cividis", SPEED_UNIT),
              (temperature, fields[temperature], "inferno", r"$\epsilon$")]
    if "pressure" in fields:
        panels.append(("pressure", fields["pressure"], "magma", PRESSURE_UNIT))
    width, height = data["edges"]
    rows = 2 if width <= 3 * height else len(panels)  # a long box: one map below the other
    columns = -(-len(panels) // rows)
    size = 3.9 if rows == 2 else 8.5
    figure, grid = plt.subplots(rows, columns, squeeze=False, layout="constrained",
                                figsize=(columns * size + 0.3, rows * (size * 0.86 * height / width + 0.35) + 0.4))
    for axes, (name, values, colours, unit) in zip(grid.flat, panels):
        draw_map(axes, data, values, colours, f"{LABELS[name]}  ({unit})")
        if name.startswith("velocity"):
            draw_arrows(axes, data, velocity)
    for axes in grid.flat[len(panels):]:
        axes.set_visible(False)
    for axes in grid[-1]:
        axes.set_xlabel(r"$x/\sigma$")
    for axes in grid[:, 0]:
        axes.set_ylabel(r"$y/\sigma$")
    figure.suptitle(title(data), fontsize=10)
    return figure


def weight_in_fourier_space(kernel, reach, wave_numbers):
    """The integral of w(r) J_0(k r) r, one at k = 0; J_0 is a mean over angles."""
    r = (np.arange(200) + 0.5) * reach / 200
    q = r / reach
    if kernel == b"lucy":
        weight = (1 + 3 * q) * (1 - q) ** 3
    else:
        weight = np.where(q < 0.5, 1 - 6 * q**2 + 6 * q**3, 2 * (1 - q) ** 3)
    angles = (np.arange(100) + 0.5) * np.pi / 100
    along = r[:, None] * np.cos(angles)
    bessel = np.array([np.cos(k * along).mean(axis=1) for k in wave_numbers])
    return (bessel * weight * r).sum(axis=1) / (weight * r).sum()


def draw_spectra(data):
    velocity = velocity_name(data)
    wanted = [("density", "density", "-"), (f"{velocity}_x", LABELS[velocity] + r", $x$", "-"),
              (f"{velocity}_y", LABELS[velocity] + r", $y$", "-"), ("temperature", LABELS["temperature"], "-"),
              ("kinetic_temperature", LABELS["kinetic_temperature"], "-"), ("pressure", LABELS["pressure"], "--")]
    figure, axes = plt.subplots(figsize=(6.4, 4.6), layout="constrained")
    drawn = []
    for colour, (name, label, line) in zip(COLOURS, wanted):
        spectrum = data["spectra"].get(name)
        if spectrum is None:
            continue
        whole = spectrum["wave_number"] <= data["whole_up_to"]
        k, power = spectrum["wave_number"][whole], spectrum["power"][whole]
        variance = float(np.sum(spectrum["modes"] * spectrum["power"]))
        mean = np.abs(np.nanmean(data["fields"].get(name, np.zeros(1))))
        if not variance > 1e-20 * max(mean**2, 1e-300):  # nothing but rounding, or not known
            why = "is constant" if variance >= 0 else "is not known everywhere"
            print(f"{name}: no spectrum is drawn, the field {why}")
            continue
        axes.plot(k, power / variance, line, color=colour, linewidth=1.2, marker="o" if len(k) < 60 else "",
                  markersize=2.2, label=label)
        drawn.append((k, power / variance))
    if not drawn:
        plt.close(figure)
        return None
    highest = max(power.max() for _, power in drawn)
    reach = float(data["parameters"]["range"])
    k, modes = (data["spectra"]["density"][key] for key in ("wave_number", "modes"))
    near = (k * reach < 60) & (k <= data["whole_up_to"])
    weight = weight_in_fourier_space(data["parameters"]["kernel"], reach, k[near]) ** 2
    axes.plot(k[near], weight / np.sum(modes[near] * weight), color="0.55", linewidth=1.0, zorder=1,
              label=r"particles at random, $|w_{\mathbf{k}}|^2$")
    axes.axvline(2 * np.pi / reach, color="0.7", linewidth=0.8, zorder=0)
    axes.annotate(r"$2\pi/h$", (2 * np.pi / reach, 0.985), xycoords=("data", "axes fraction"), xytext=(3, 0),
                  textcoords="offset points", va="top", fontsize=9, color="0.4")
    lowest = min(power[power > 0].min() for _, power in drawn if np.any(power > 0))
    axes.set(xscale="log", yscale="log", xlabel=r"$|\mathbf{k}|\,\sigma$",
             ylabel=r"$\langle|f_{\mathbf{k}}|^2\rangle$ / variance of $f$",
             ylim=(max(lowest, 1e-9 * highest) / 2, 3 * highest))
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.legend(fontsize=8, frameon=False, loc="lower left")
    axes.set_title(title(data), fontsize=9)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, help="results of lucy fields")
    directory = parser.parse_args().directory
    data = read(directory / "fields.h5")
    plt.rcParams.update(STYLE)
    save(draw_fields(data), directory, "fields")
    spectra = draw_spectra(data)
    if spectra:
        save(spectra, directory, "spectra")


if __name__ == "__main__":
    main()
