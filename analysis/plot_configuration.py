#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The last configuration of a point, as in Fig. 3 of Posch, Hoover and Kum, Phys. Rev. E 52, 1711 (1995).

    plot_configuration.py POINT.h5 OUT.png [--replica 1] [--velocities peculiar|laboratory]

Dots are the particles in the box; the strips above and below it hold their images (grey), shifted by the offset of the
sliding boundary at that moment. The file must have been written with frames ([output] frame_interval).
"""

import argparse
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import h5py
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as missing:
    sys.exit("plot_configuration.py needs numpy, matplotlib and h5py (Debian: python3-matplotlib, python3-h5py): "
             f"{missing}")

STRIP = 0.12  # of the box height, above and below


def fail(sentence):
    print(f"plot_configuration.py: {sentence}", file=sys.stderr)
    sys.exit(2)


def read_last_frame(path, replica, velocities):
    try:
        with h5py.File(path, "r") as file:
            name = f"particles/replica_{replica:02d}"
            if name not in file:
                present = ", ".join(sorted(file["particles"])) if "particles" in file else "none"
                fail(f"{path} has no frames of replica {replica} (frames of: {present}); "
                     "run with [output] frame_interval")
            group = file[name]
            frame = {
                "position": group["position/value"][-1],
                "time": float(group["position/time"][-1]),
                "edges": group["box/edges/value"][-1],
                "offset": float(group["lees_edwards/offset/value"][-1, 0]),
                "parameters": dict(file["parameters"].attrs),
            }
            if velocities:
                frame["velocity"] = group["momentum/value" if velocities == "peculiar" else "velocity/value"][-1]
            return frame
    except (OSError, KeyError, IndexError) as error:
        fail(f"cannot read {path} as a point file of Lucy: {error}")


def without_noise(offset, width):
    """The offset, but 0 where only rounding tells it from 0 or from a whole box length."""
    return 0.0 if abs(offset - width * round(offset / width)) < 1e-9 * width else offset


def plain(value):
    """Four digits without an exponent."""
    return np.format_float_positional(value, precision=4, unique=False, fractional=False, trim="-")


def draw(frame):
    position = frame["position"]
    width, height = frame["edges"][0, 0], frame["edges"][1, 1]
    offset = without_noise(frame["offset"], width)
    strip = STRIP * height
    figure, axes = plt.subplots(figsize=(6, 6 * (1 + 2 * STRIP) * height / width + 0.5))
    size = np.clip(12000 / len(position), 0.3, 40)

    axes.scatter(*position.T, s=size, color="black", linewidths=0, zorder=3)
    for up in (1, -1):  # the images above move with +offset, those below with -offset
        image = position + [up * offset, up * height]
        near = (image[:, 1] < height + strip) & (image[:, 1] > -strip)
        for turn in range(-2, 3):
            shifted = image[near] + [turn * width, 0]
            inside = (shifted[:, 0] >= 0) & (shifted[:, 0] < width)
            axes.scatter(*shifted[inside].T, s=size, color="0.72", linewidths=0, zorder=2)
        edge = height if up > 0 else 0
        corner = (up * offset) % width
        axes.plot([corner, corner], [edge, edge + up * strip], color="0.5", linewidth=0.9, linestyle="--", zorder=1)
    axes.add_patch(plt.Rectangle((0, 0), width, height, fill=False, linewidth=1.1, zorder=4))
    reach = (0.0, height + 0.6 * strip), (offset, height + 0.6 * strip)
    if abs(offset) > 0.03 * width:
        axes.annotate("", xy=reach[1], xytext=reach[0],
                      arrowprops={"arrowstyle": "-|>", "color": "#D55E00", "linewidth": 1.3, "shrinkA": 0,
                                  "shrinkB": 0},
                      annotation_clip=False, zorder=5)
    elif offset != 0:  # too short for a head
        axes.plot(*zip(*reach), color="#D55E00", linewidth=1.3, zorder=5)
    axes.text(0.0, height + 1.12 * strip, f"image offset {plain(offset)}", color="#D55E00", va="bottom", fontsize=9)

    if "velocity" in frame:
        velocity = frame["velocity"]
        typical = np.sqrt(np.mean(np.sum(velocity**2, axis=1)))
        if typical > 0:  # a typical arrow is as long as the mean distance of neighbours
            spacing = np.sqrt(width * height / len(position))
            axes.quiver(*position.T, *velocity.T, angles="xy", scale_units="xy", scale=typical / spacing, width=0.0018,
                        color="#0072B2", zorder=4)

    parameters = frame["parameters"]
    axes.set_title(f"$N$ = {len(position)},  $E/N$ = {parameters['energy_per_particle']:g},  "
                   rf"$\dot\gamma$ = {parameters['strain_rate']:g},  $t$ = {frame['time']:g}", fontsize=10, loc="right")
    axes.set(xlim=(-0.01 * width, 1.01 * width), ylim=(-strip, height + strip), xlabel=r"$x/\sigma$",
             ylabel=r"$y/\sigma$")
    axes.set_aspect("equal")
    axes.tick_params(direction="out")
    figure.tight_layout()
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("point", type=pathlib.Path, help="H5MD file of one point, with frames")
    parser.add_argument("picture", type=pathlib.Path, help="picture to write (.png, .svg or .pdf)")
    parser.add_argument("--replica", type=int, default=1, help="number of the replica, from 1 (default 1)")
    parser.add_argument("--velocities", choices=("peculiar", "laboratory"), help="draw arrows as well")
    options = parser.parse_args()
    if options.picture.suffix not in (".png", ".svg", ".pdf"):
        fail(f"the picture is to be {options.picture}: it must end in .png, .svg or .pdf")
    frame = read_last_frame(options.point, options.replica, options.velocities)
    plt.rcParams.update({"font.size": 10, "svg.hashsalt": "lucy", "mathtext.fontset": "cm"})
    figure = draw(frame)
    kind = options.picture.suffix[1:]
    metadata = {"png": {"Software": None}, "svg": {"Date": None}, "pdf": {"CreationDate": None}}[kind]
    temporary = options.picture.with_name(f".{options.picture.name}.tmp")
    try:
        figure.savefig(temporary, format=kind, dpi=200, bbox_inches="tight", metadata=metadata)
        temporary.replace(options.picture)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        print(f"plot_configuration.py: cannot write {options.picture}: {error}", file=sys.stderr)
        sys.exit(1)


if __name__ == "__main__":
    main()
