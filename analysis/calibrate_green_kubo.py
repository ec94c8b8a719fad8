#!/usr/bin/python3
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Do the error bars of `lucy green-kubo` cover the truth as often as they should?

    analysis/calibrate_green_kubo.py [--process one|two|both] [--realisations 400] [--time 20000] [--out DIR]

Made-up stresses of which the viscosity is known exactly: sums of independent Ornstein-Uhlenbeck processes,

    C(t) = sum_k variance_k exp(-t/tau_k),      eta = int_0^inf C dt = sum_k variance_k tau_k      (V = kT = 1)

    one     variance 0.55, tau 25.6: like the Lucy fluid at E = N
    two     variances 0.05, 0.04, tau 0.5, 13: a fast and a slow part, like E = N/2

updated exactly from sample to sample, stationary from the first. Each realisation is a file with two independent
columns, P_xy and (P_xx - P_yy)/2, sampled every --interval, that the program analyses like any other series
(`--from-series`).
For both estimators, the integral up to the cut-off and the low-frequency spectrum, the fraction of realisations with

    |estimate - eta| <= k error,      k = 1, 2

is compared with a Gaussian's 0.6827 and 0.9545; a realisation without an estimate or without an error covers nothing.

Prints one row of a markdown table per process and estimator, the uncertainty in brackets being the binomial standard
error of the last digits, and writes DIR/calibration.csv (one row per realisation and estimator), DIR/calibration.png
and DIR/calibration.svg (how (estimate - eta)/error is distributed). Exit code 0; 1 when the fraction within one error
lies further than three binomial standard errors from 0.6827 or the program fails; 2 for bad input. The seed fixes all
results.
"""

import argparse
import concurrent.futures
import csv
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as missing:
    sys.exit(f"calibrate_green_kubo.py needs numpy and matplotlib (Debian: python3-matplotlib): {missing}")

import lucy_tables

PROCESSES = {"one": ((0.55, 25.6),), "two": ((0.05, 0.5), (0.04, 13.0))}  # (variance, tau) of each part
TITLES = {"one": "one exponential", "two": "two exponentials"}
ESTIMATORS = {"viscosity": "integral", "viscosity_spectrum": "spectrum"}
EXPECTED = (math.erf(1 / math.sqrt(2)), math.erf(2 / math.sqrt(2)))
BLOCK = 64  # samples advanced at once


class ProgramFailed(Exception):
    """What the program said, in one sentence."""


def truth(process):
    return sum(variance * tau for variance, tau in PROCESSES[process])


def ornstein_uhlenbeck(variance, tau, samples, interval, generator):
    """x_{n+1} = f x_n + sqrt(variance (1 - f^2)) xi_n with f = exp(-interval/tau), x_0 stationary.

    Blocks of the recursion are written as a triangular matrix, so that only one step per block is a step of Python's.
    """
    factor = math.exp(-interval / tau)
    blocks = -(-samples // BLOCK)
    kicks = math.sqrt(variance * -math.expm1(-2 * interval / tau)) * generator.standard_normal((blocks, BLOCK))
    powers = np.arange(BLOCK)[:, None] - np.arange(BLOCK)
    inner = kicks @ np.where(powers >= 0, factor ** np.maximum(powers, 0), 0.0).T  # as if each block began from zero
    before = np.empty(blocks)  # the value just before each block
    value = math.sqrt(variance) * generator.standard_normal()
    for block in range(blocks):
        before[block] = value
        value = factor**BLOCK * value + inner[block, -1]
    return (inner + before[:, None] * factor ** np.arange(1, BLOCK + 1)).ravel()[:samples]


def series(process, realisation, settings):
    """Two independent columns: (samples, 2)."""
    generator = np.random.default_rng([settings.seed, list(PROCESSES).index(process), realisation])
    samples = int(round(settings.time / settings.interval))
    return np.stack([sum(ornstein_uhlenbeck(variance, tau, samples, settings.interval, generator)
                         for variance, tau in PROCESSES[process]) for _ in range(2)], axis=1)


def write_series(path, values):
    """One formatting of all rows at once is several times faster than numpy.savetxt."""
    path.write_text("pxy,difference\n" + "%.9g,%.9g\n" * len(values) % tuple(values.ravel().tolist()), encoding="ascii")


def analyse(task):
    """(process, realisation, {column: number}) of one realisation, by the program."""
    process, realisation, settings = task
    with tempfile.TemporaryDirectory(prefix="lucy_calibration_") as folder:
        folder = pathlib.Path(folder)
        write_series(folder / "series.csv", series(process, realisation, settings))
        command = [settings.lucy, "green-kubo", "--from-series", folder / "series.csv", "--pxy", "pxy", "--difference",
                   "difference", "--interval", repr(settings.interval), "--volume", "1", "--temperature", "1",
                   "--no-pictures", "--out", folder / "out"]
        if settings.length:
            command += ["--length", repr(settings.length)]
        finished = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
        where = f"process {process}, realisation {realisation}"
        if finished.returncode != 0:
            said = (finished.stderr.strip().splitlines() or ["nothing on standard error"])[0]
            raise ProgramFailed(f"{where}: lucy green-kubo ended with exit code {finished.returncode}: {said}")
        wanted = [name + suffix for name in ESTIMATORS for suffix in ("", "_error")]
        try:
            with open(folder / "out" / "viscosity.csv", newline="", encoding="utf-8") as file:
                row = next(csv.DictReader(file))
            return process, realisation, {name: float(row[name]) for name in wanted}
        except (OSError, StopIteration, KeyError, TypeError, ValueError) as problem:
            raise ProgramFailed(f"{where}: no result in viscosity.csv ({problem!r})") from None


def run(settings):
    """{process: {column: array over realisations}}."""
    processes = PROCESSES if settings.process == "both" else (settings.process,)
    tasks = [(process, realisation, settings) for process in processes for realisation in range(settings.realisations)]
    found = {process: [None] * settings.realisations for process in processes}
    with concurrent.futures.ProcessPoolExecutor(settings.processes) as pool:
        futures = [pool.submit(analyse, task) for task in tasks]
        try:
            for done, future in enumerate(concurrent.futures.as_completed(futures), start=1):
                process, realisation, values = future.result()
                found[process][realisation] = values
                if sys.stderr.isatty():
                    print(f"\r{done} of {len(tasks)}", end="\n" if done == len(tasks) else "", file=sys.stderr)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return {process: {name: np.array([row[name] for row in rows]) for name in rows[0]}
            for process, rows in found.items()}


def summarise(process, estimator, values, errors):
    """The row of the table, and whether one-sigma bars cover as they should."""
    eta, count = truth(process), len(values)
    usable = np.isfinite(values) & (errors > 0)
    if usable.sum() < 2:
        return f"| {process} | {ESTIMATORS[estimator]} | {count} | {count - usable.sum()} |" + " - |" * 7, False
    distances = np.full(count, np.inf)
    distances[usable] = np.abs(values[usable] - eta) / errors[usable]
    cells, good = [], True
    for sigmas, expected in enumerate(EXPECTED, start=1):
        fraction = float(np.mean(distances <= sigmas))
        noise = math.sqrt(expected * (1 - expected) / count)
        agrees = abs(fraction - expected) <= 3 * noise
        good = good and (agrees or sigmas > 1)
        cells.append(f"{fraction:.3f}({noise * 1000:.0f})" + ("" if agrees else " !"))
    scatter = values[usable].std(ddof=1)
    typical = errors[usable].mean()
    mean, mean_error = values[usable].mean(), scatter / math.sqrt(usable.sum())
    bias = lucy_tables.with_error((mean - eta) / typical, mean_error / typical)
    return (f"| {process} | {ESTIMATORS[estimator]} | {count} | {count - usable.sum()} | {eta:.6g} "
            f"| {lucy_tables.with_error(mean, mean_error)} | {scatter:.3g} | {typical / scatter:.3f} | {bias} "
            f"| {cells[0]} | {cells[1]} |"), good


def draw(results):
    figure, panels = plt.subplots(len(results), 2, figsize=(7.6, 0.5 + 2.7 * len(results)), squeeze=False, sharex=True,
                                  sharey=True)
    edges = np.linspace(-4, 4, 33)
    fine = np.linspace(-4, 4, 400)
    for row, (process, columns) in zip(panels, results.items()):
        for axes, (estimator, name) in zip(row, ESTIMATORS.items()):
            values, errors = columns[estimator], columns[estimator + "_error"]
            usable = np.isfinite(values) & (errors > 0)
            distances = (values[usable] - truth(process)) / errors[usable]
            weights = np.full(len(distances), 1 / len(values) / (edges[1] - edges[0]))
            axes.hist(np.clip(distances, edges[0], edges[-1]), edges, weights=weights, color=lucy_tables.COLOURS[0],
                      alpha=0.45, edgecolor="white", linewidth=0.5)
            axes.plot(fine, np.exp(-fine**2 / 2) / math.sqrt(2 * math.pi), color="black", linewidth=1.2)
            for sigma in (-1, 1):
                axes.axvline(sigma, color="0.5", linewidth=0.7, linestyle=":")
            covered = np.sum(np.abs(distances) <= 1) / len(values)
            noise = math.sqrt(EXPECTED[0] * (1 - EXPECTED[0]) / len(values))
            axes.text(0.03, 0.95, f"{TITLES[process]}\n{name}", transform=axes.transAxes, va="top", fontsize=9)
            axes.text(0.97, 0.95, f"within one error\n{covered:.3f}({1000 * noise:.0f})", transform=axes.transAxes,
                      va="top", ha="right", fontsize=9)
            axes.tick_params(direction="in", top=True, right=True)
            axes.set_xlim(-4, 4)
    panels[0][0].set_ylim(0, 1.45 * panels[0][0].get_ylim()[1])
    for axes in panels[-1]:
        axes.set_xlabel(r"$(\hat\eta - \eta)\,/\,$error")
    for row in panels:
        row[0].set_ylabel("density")
    figure.tight_layout()
    return figure


def positive(kind):
    def parse(text):
        value = kind(text)
        if not 0 < value < math.inf:
            raise ValueError
        return value
    parse.__name__ = "number above zero"
    return parse


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--process", choices=(*PROCESSES, "both"), default="both")
    parser.add_argument("--realisations", type=positive(int), default=400, help="of each process (default: 400)")
    parser.add_argument("--time", type=positive(float), default=20000.0, help="length of a series (default: 20000)")
    parser.add_argument("--interval", type=positive(float), default=0.2, help="between samples (default: 0.2)")
    parser.add_argument("--length", type=positive(float), help="longest lag (default: the program's)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=positive(int), default=2, help="programs at a time (default: 2)")
    parser.add_argument("--lucy", type=pathlib.Path, default=lucy_tables.REFERENCE.parent / "lucy",
                        help="the program (default: the launcher beside analysis/)")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("runs/calibration"),
                        help="directory of the results (default: runs/calibration)")
    settings = parser.parse_args()
    if settings.seed < 0:
        lucy_tables.fail("--seed must be zero or above")
    if settings.time < 100 * settings.interval:
        lucy_tables.fail(f"--time {settings.time:g} holds fewer than 100 samples at --interval {settings.interval:g}")
    program = shutil.which(settings.lucy) or shutil.which(settings.lucy.absolute())
    if program is None:
        lucy_tables.fail(f"--lucy {settings.lucy} is no program")
    settings.lucy = program
    try:
        settings.out.mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        lucy_tables.fail(f"cannot write {settings.out}: {problem}")
    subprocess.run([program, "--version"], capture_output=True, check=False)  # alone: the launcher may have to build
    try:
        results = run(settings)
    except ProgramFailed as problem:
        lucy_tables.fail(str(problem), code=1)

    try:
        with open(settings.out / "calibration.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(("process", "realisation", "estimator", "truth", "value", "error"))
            for process, columns in results.items():
                for realisation in range(settings.realisations):
                    for estimator, name in ESTIMATORS.items():
                        writer.writerow((process, realisation, name, f"{truth(process):.9g}",
                                         f"{columns[estimator][realisation]:.9g}",
                                         f"{columns[estimator + '_error'][realisation]:.9g}"))
    except OSError as problem:
        lucy_tables.fail(f"cannot write {settings.out / 'calibration.csv'}: {problem}", code=1)
    plt.rcParams.update(lucy_tables.STYLE)
    lucy_tables.save(draw(results), settings.out, "calibration")

    print(f"Series of {settings.time:g} time units, sampled every {settings.interval:g}; seed {settings.seed}.\n")
    print("| process | estimator | realisations | without error | truth | mean | scatter | mean error / scatter "
          "| bias / mean error | within 1 error (0.683) | within 2 errors (0.954) |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    agreed = True
    for process, columns in results.items():
        for estimator in ESTIMATORS:
            line, good = summarise(process, estimator, columns[estimator], columns[estimator + "_error"])
            print(line)
            agreed = agreed and good
    return 0 if agreed else 1


if __name__ == "__main__":
    sys.exit(main())
