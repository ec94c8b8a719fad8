#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Do the error bars of single runs cover the long-run value as often as they should?

    analysis/coverage.py DIR/replicas.csv [--reference VALUE --reference-error E]

Every replica in the file (of a sweep with many replicas, 200 or more for a meaningful answer) counts as an independent
short run with its own error bar. For each point of the table the fraction of runs with

    |value - long-run value| <= k sqrt(error^2 + (error of the long-run value)^2),      k = 1, 2

is compared with a Gaussian's 0.6827 and 0.9545. The long-run value of a run is the mean over all the other runs, its
error that of this mean from their spread; or the reference given (then the file must hold a single point). Runs that
gave no error bar are counted and left out of the fractions, not out of the long-run value.

One row of a markdown table per point; the uncertainty in brackets is the binomial standard error of the last digits.
Exit code 0; 1 when a fraction lies further than three binomial standard errors from its expectation; 2 for bad input.
"""

import argparse
import csv
import math
import sys

import numpy as np

EXPECTED = (math.erf(1 / math.sqrt(2)), math.erf(2 / math.sqrt(2)))
POINT_COLUMNS = ("particles", "energy_per_particle", "strain_rate")
COLUMNS = POINT_COLUMNS + ("replica", "viscosity", "viscosity_error")


class BadInput(Exception):
    """What is wrong with the input, in one sentence."""


def read_points(path):
    """The points of the file in its order: {(particles, energy, rate): (values, errors)}."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = csv.DictReader(file)
            missing = [name for name in COLUMNS if name not in (rows.fieldnames or ())]
            if missing:
                raise BadInput(f"{path}: column {missing[0]} is missing; a replicas.csv of `lucy sweep` is expected")
            points = {}
            for row in rows:
                try:
                    point = tuple(float(row[name]) for name in POINT_COLUMNS)
                    value, error = float(row["viscosity"]), float(row["viscosity_error"])
                except (TypeError, ValueError):
                    raise BadInput(f"{path}, line {rows.line_num}: a number is missing or not a number") from None
                points.setdefault(point, []).append((value, error))
    except (OSError, UnicodeDecodeError, csv.Error) as problem:
        raise BadInput(f"{path} cannot be read: {problem}") from None
    return {point: tuple(np.array(pairs).T) for point, pairs in points.items()}


def long_run(values, reference, reference_error):
    """Long-run value and its error, as seen from each run."""
    if reference is not None:
        return np.full(len(values), reference), np.full(len(values), reference_error)
    others = len(values) - 1
    means = (values.sum() - values) / others
    squares = (values**2).sum() - values**2 - others * means**2
    return means, np.sqrt(np.maximum(squares, 0.0) / (others - 1) / others)


def covered(values, errors, centres, centre_errors):
    """Fractions within one and two errors."""
    distances = np.abs(values - centres) / np.hypot(errors, centre_errors)
    return tuple(float(np.mean(distances <= sigmas)) for sigmas in (1, 2))


def plain(number):
    """A number as a person would write it."""
    return f"{number:.6g}" if number == 0 or 1e-4 <= abs(number) < 1e6 else f"{number:.3e}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("file", help="replicas.csv of a sweep")
    parser.add_argument("--reference", type=float, help="long-run viscosity known from elsewhere")
    parser.add_argument("--reference-error", type=float, help="its standard error")
    arguments = parser.parse_args()
    reference, reference_error = arguments.reference, arguments.reference_error
    if (reference is None) != (reference_error is None):
        raise BadInput("--reference and --reference-error belong together")
    if reference is not None and not (math.isfinite(reference) and 0 <= reference_error < math.inf):
        raise BadInput("--reference must be a finite number and --reference-error a finite one not below zero")

    points = {}
    for point, (values, errors) in read_points(arguments.file).items():
        if point[2] == 0:
            continue  # no viscosity at equilibrium
        measured = np.isfinite(values)
        points[point] = values[measured], errors[measured]
    if not points:
        raise BadInput(f"{arguments.file} holds no sheared runs")
    if reference is not None and len(points) > 1:
        raise BadInput(f"{arguments.file} holds {len(points)} points; --reference wants exactly one")

    lines, agreed = [], True
    for (particles, energy, rate), (values, errors) in points.items():
        name = f"particles {particles:.0f}, energy {energy:g}, rate {rate:g}"
        if reference is None and len(values) < 3:
            raise BadInput(f"{arguments.file}, {name}: {len(values)} runs; at least 3 are needed without --reference")
        usable = np.isfinite(errors) & (errors >= 0)
        runs = int(usable.sum())
        if runs == 0:
            raise BadInput(f"{arguments.file}, {name}: no run gave an error bar")
        centres, centre_errors = long_run(values, reference, reference_error)
        fractions = covered(values[usable], errors[usable], centres[usable], centre_errors[usable])
        cells = []
        for fraction, expected in zip(fractions, EXPECTED):
            noise = math.sqrt(expected * (1 - expected) / runs)
            good = abs(fraction - expected) <= 3 * noise
            agreed = agreed and good
            cells.append(f"{fraction:.3f}({noise * 1000:.0f})" + ("" if good else " !"))
        centre = reference if reference is not None else values.mean()
        centre_error = reference_error if reference is not None else values.std(ddof=1) / math.sqrt(len(values))
        scatter = values.std(ddof=1) if len(values) > 1 else math.nan
        typical = math.sqrt(np.mean(errors[usable] ** 2))
        lines.append(f"| {particles:.0f} | {energy:g} | {rate:g} | {runs} | {len(values) - runs} "
                     f"| {plain(centre)} | {plain(centre_error)} | {plain(scatter)} | {plain(typical)} "
                     f"| {cells[0]} | {cells[1]} |")

    print("| N | E/N | rate | runs | without error bar | long-run viscosity | its error | scatter of runs "
          "| root mean square error bar | within 1 error (0.683) | within 2 errors (0.954) |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    print("\n".join(lines))
    return 0 if agreed else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BadInput as problem:
        print(f"coverage: {problem}", file=sys.stderr)
        sys.exit(2)
