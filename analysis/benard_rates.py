#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast the averaged flow of `lucy benard` shears: rate = (2 D:D)^(1/2), D the traceless rate of
deformation.

    analysis/benard_rates.py POINT.h5...

Prints <rate>, <rate^2>^(1/2) and <rate>/<rate^2>, means over the cell. A stress tau that does not depend on the rate
dissipates as much as a viscosity tau <rate>/<rate^2> would. Differences are centred, of the fields at cell centres.
"""

import argparse
import pathlib
import sys

try:
    import h5py
    import numpy as np
except ImportError as missing:
    sys.exit(f"benard_rates.py needs numpy and h5py (Debian: python3-numpy, python3-h5py): {missing}")

from lucy_tables import fail


def read_flow(path):
    """(spacings, velocities, whether the sides are periodic)"""
    try:
        with h5py.File(path, "r") as file:
            axes = [file[f"grid/{axis}"][:] for axis in "xy"]
            velocities = [file[f"fields/velocity_{axis}"][:] for axis in "xy"]
            side = file["parameters"].attrs["side"]
    except (OSError, KeyError) as error:
        fail(f"cannot read {path} as a point file of lucy benard: {error}")
    side = side.decode() if isinstance(side, bytes) else side
    return [axis[1] - axis[0] for axis in axes], velocities, side == "periodic"


def rates(spacings, velocities, periodic):
    """At every cell centre. Velocities change sign across walls, which stand half a spacing beyond the last centres."""
    u, v = velocities

    def along_x(field):
        left, right = (field[:, -1:], field[:, :1]) if periodic else (-field[:, :1], -field[:, -1:])
        wide = np.concatenate([left, field, right], axis=1)
        return (wide[:, 2:] - wide[:, :-2]) / (2 * spacings[0])

    def along_y(field):
        high = np.concatenate([-field[:1], field, -field[-1:]], axis=0)
        return (high[2:] - high[:-2]) / (2 * spacings[1])

    return np.hypot(along_y(u) + along_x(v), along_x(u) - along_y(v))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=pathlib.Path, nargs="+", help="point file of `lucy benard`")
    files = parser.parse_args().file
    width = max(len(str(file)) for file in files)
    print(f"{'':{width}}    <rate>  <rate^2>^(1/2)  <rate>/<rate^2>")
    for file in files:
        rate = rates(*read_flow(file))
        square = (rate**2).mean()
        print(f"{str(file):{width}}  {rate.mean():8.5f}  {square**0.5:14.5f}  {rate.mean() / square:15.2f}")


if __name__ == "__main__":
    main()
