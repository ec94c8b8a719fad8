#!/usr/bin/env python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The local viscosity beyond the operator's at given noises of the particles, for every point of `lucy shear-wave`.

    analysis/wave_noise.py DIR

Between the windows of local.csv the logarithms are interpolated linearly; errors are those of the two windows, without
one for the interpolation. A noise outside of a point's windows has no value.
"""

import argparse
import math
import pathlib

from lucy_tables import numbers, read_rows

NOISES = (0.002, 0.001, 0.0005, 0.0003)


def at_noise(windows, noise):
    """(value, error) between the two windows around the noise; None outside. windows: (noise, value, error), rising."""
    for (low, value, error), (high, next_value, next_error) in zip(windows, windows[1:]):
        if low <= noise <= high:
            share = math.log(noise / low) / math.log(high / low)
            result = value ** (1 - share) * next_value ** share
            return result, result * math.hypot((1 - share) * error / value, share * next_error / next_value)
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, help="output directory of `lucy shear-wave`")
    directory = parser.parse_args().directory
    table, local = directory / "shear_wave.csv", directory / "local.csv"
    operators = [numbers(table, row, ["operator"])["operator"] for row in read_rows(table, ["operator"])]
    columns = ["point", "particle_noise", "diffusivity", "diffusivity_error"]
    rows = [numbers(local, row, columns) for row in read_rows(local, columns)]
    print("point" + "".join(f"{noise:>18}" for noise in NOISES))
    for point, operator in enumerate(operators, start=1):
        windows = sorted((row["particle_noise"], row["diffusivity"] - operator, row["diffusivity_error"])
                         for row in rows if row["point"] == point and row["diffusivity"] > operator)
        found = [at_noise(windows, noise) for noise in NOISES]
        if any(found):
            print(f"{point:5}" + "".join(f"{value[0]:>9.3f} +- {value[1]:.3f}" if value else 18 * " " for value in found))


if __name__ == "__main__":
    main()
