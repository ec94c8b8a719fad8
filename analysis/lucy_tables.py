# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the plotting scripts have in common: reading tables, complaining in one sentence, saving a picture.

Nothing here needs more than Python itself.
"""

import csv
import math
import pathlib
import sys
import tomllib

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")  # told apart by everyone
STYLE = {"font.size": 10, "axes.linewidth": 0.8, "svg.hashsalt": "lucy", "mathtext.fontset": "cm"}
DOTS_PER_INCH = 200
REFERENCE = pathlib.Path(__file__).resolve().parent.parent / "reference"

TIME_UNIT = r"$\sigma\,\sqrt{m/\epsilon}$"
VISCOSITY_UNIT = r"$\sqrt{m\,\epsilon}\,/\sigma$"  # in two dimensions pressure is force per length
SERIES = "sampled series"  # a state that is none: stresses from elsewhere
PRESSURE_UNIT = r"$\epsilon/\sigma^2$"


def fail(sentence, code=2):
    """Ends the script: code 2 for bad input, 1 for work that failed."""
    print(f"{pathlib.Path(sys.argv[0]).name}: {sentence}", file=sys.stderr)
    sys.exit(code)


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


def numbers(path, row, columns):
    return {column: number(path, row, column) for column in columns}


def read_toml(path):
    """A TOML file as a dictionary; None when it cannot be read."""
    try:
        with open(path, "rb") as file:
            return tomllib.load(file)
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError):
        return None


def same_state(first, second):
    """Same number of particles and same energy; what has none (nan) is like its kind."""
    pairs = ((first[key], second[key]) for key in ("particles", "energy_per_particle"))
    return all(math.isclose(*pair, rel_tol=1e-9) or all(map(math.isnan, pair)) for pair in pairs)


def state_name(row):
    """For a title or the terminal; a series from elsewhere belongs to no state."""
    if not math.isfinite(row["particles"]) or row["particles"] <= 0 or not math.isfinite(row["energy_per_particle"]):
        return SERIES
    return f"E/N = {row['energy_per_particle']:g}, N = {row['particles']:.0f}"


def with_error(value, error):
    """13.52(41): the error in units of the last digits, two of them; 13.52 with no error known."""
    if not math.isfinite(value):
        return "unknown"
    if not (math.isfinite(error) and error > 0):
        return f"{value:.4g}"
    places = 1 - math.floor(math.log10(float(f"{error:.1e}")))
    if places <= 0:
        return f"{value:.0f}({error:.0f})"
    return f"{value:.{places}f}({f'{error:.{places}f}'.lstrip('0.')})"


def instability_bands(rates):
    """Ranges of rate, from {rate: unstable}; they end midway, on a logarithmic axis, to the next stable rate."""
    order = sorted(rates)
    bands = []
    for index, rate in enumerate(order):
        if not rates[rate]:
            continue
        low = math.sqrt(order[index - 1] * rate) if index > 0 else rate / 1.1
        high = math.sqrt(order[index + 1] * rate) if index + 1 < len(order) else rate * 1.1
        if index > 0 and rates[order[index - 1]]:
            bands[-1] = (bands[-1][0], high)
        else:
            bands.append((low, high))
    return bands


def save(figure, directory, stem):
    """Writes DIR/STEM.png and DIR/STEM.svg, each complete or not at all, without dates: same table, same picture."""
    for name, metadata in ((f"{stem}.png", {"Software": None}), (f"{stem}.svg", {"Date": None})):
        temporary = directory / f".{name}.tmp"
        try:
            figure.savefig(temporary, format=name[-3:], dpi=DOTS_PER_INCH, metadata=metadata)
            temporary.replace(directory / name)
        except OSError as error:
            temporary.unlink(missing_ok=True)
            fail(f"cannot write {directory / name}: {error}", code=1)
