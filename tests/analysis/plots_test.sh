#!/bin/bash
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The plotting scripts on small made-up inputs: pictures appear, nothing is dropped in silence, mistakes get a sentence.
# Exit 77 (skipped) when this machine's Python has no numpy, matplotlib or h5py.
set -u
source_directory=${LUCY_SOURCE_DIRECTORY:-$(cd "$(dirname "$0")/../.." && pwd)}
python="/usr/bin/python3 -B"
if ! $python -c 'import numpy, matplotlib, h5py' 2> /dev/null; then
  echo "skipped: /usr/bin/python3 lacks numpy, matplotlib or h5py"
  exit 77
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export MPLCONFIGDIR=$scratch/matplotlib
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}
is_png() { [ "$(head -c 4 "$1" | tail -c 3)" = PNG ]; }
# expect_note TEXT: the output of the last plot says so
expect_note() { grep -qF -- "$1" "$scratch/output" || fail "no note: $1"; }
# refused EXIT_CODE TEXT COMMAND...: one line on standard error with the text
refused() {
  local code=$1 text=$2
  shift 2
  "$@" > /dev/null 2> "$scratch/error"
  local result=$?
  [ $result -eq "$code" ] || fail "exit code $result where $code was expected: $*"
  grep -qF -- "$text" "$scratch/error" || fail "no \"$text\" in: $(cat "$scratch/error")"
  grep -q Traceback "$scratch/error" && fail "a stack trace: $*"
  [ "$(wc -l < "$scratch/error")" -le 3 ] || fail "more than three lines: $*"
}

mkdir "$scratch/run"
$python "$source_directory/tests/analysis/make_examples.py" "$scratch/run" || exit 1
viscosity="$python $source_directory/analysis/plot_viscosity.py"
configuration="$python $source_directory/analysis/plot_configuration.py"

$viscosity "$scratch/run" > "$scratch/output" 2> "$scratch/error" || fail "plot_viscosity.py: $(cat "$scratch/error")"
[ -s "$scratch/error" ] && fail "plot_viscosity.py warns: $(cat "$scratch/error")"
is_png "$scratch/run/viscosity.png" || fail "viscosity.png is no PNG"
grep -q '</svg>' "$scratch/run/viscosity.svg" || fail "viscosity.svg is no SVG"
expect_note "rate 0: there is no viscosity or normal stress at zero rate"
expect_note "rate 0.3: no viscosity and no normal stress (status failed)"
expect_note "rate 0.02: no error bar for normal stress"
expect_note "viscosity at N = 1024, E/N = 0.5, rate 0.001 is -0.1 +- 0.3 (arrow from its two-sigma upper bound)"
expect_note "viscosity at N = 1024, E/N = 0.5, rate 0.002 is -2 +- 0.3 (mark at the lower edge)"
expect_note "rate 0.005 (faint) contains a misprinted digit"

# The same table gives the same picture.
cp "$scratch/run/viscosity.svg" "$scratch/before.svg"
$viscosity "$scratch/run" > /dev/null
cmp -s "$scratch/before.svg" "$scratch/run/viscosity.svg" || fail "viscosity.svg differs when made again"

# Without published tables, and with nothing that a logarithmic axis could show.
mkdir "$scratch/alone" "$scratch/none"
cp "$scratch/run/table.csv" "$scratch/alone"
$viscosity "$scratch/alone" --reference "$scratch/none" > "$scratch/output" 2>&1 || fail "without reference"
grep -qi published "$scratch/output" && fail "published points without a reference"
grep -E 'particles|,0,nan' "$scratch/run/table.csv" > "$scratch/none/table.csv"
$viscosity "$scratch/none" --reference "$scratch/none" > "$scratch/output" 2>&1 || fail "no value: $(cat "$scratch/output")"
expect_note "viscosity: no positive value"

refused 2 "cannot read $scratch/missing/table.csv" $viscosity "$scratch/missing"
echo "particles,status" > "$scratch/none/table.csv"
refused 2 "has no column energy_per_particle" $viscosity "$scratch/none"
sed 's/,2.63,/,many,/' "$scratch/run/table.csv" > "$scratch/none/table.csv"
refused 2 'viscosity is "many"' $viscosity "$scratch/none"
head -n 1 "$scratch/run/table.csv" > "$scratch/none/table.csv"
refused 2 "has no rows" $viscosity "$scratch/none"

for options in "" "--velocities peculiar" "--velocities laboratory"; do
  rm -f "$scratch/run/configuration_001.png"
  $configuration "$scratch/run/point_001.h5" "$scratch/run/configuration_001.png" $options 2> "$scratch/error" ||
    fail "plot_configuration.py $options: $(cat "$scratch/error")"
  is_png "$scratch/run/configuration_001.png" || fail "configuration_001.png is no PNG ($options)"
done
refused 2 "has no frames of replica 2" $configuration "$scratch/run/point_001.h5" "$scratch/x.png" --replica 2
refused 2 "cannot read $scratch/run/table.csv" $configuration "$scratch/run/table.csv" "$scratch/x.png"
refused 2 "must end in .png" $configuration "$scratch/run/point_001.h5" "$scratch/x.gif"
refused 1 "cannot write" $configuration "$scratch/run/point_001.h5" "$scratch/missing/x.png"

# A Python without the libraries gets one sentence.
mkdir "$scratch/broken"
for library in numpy matplotlib h5py; do echo "raise ImportError('$library is not here')" > "$scratch/broken/$library.py"; done
refused 1 "needs numpy and matplotlib" env PYTHONPATH="$scratch/broken" $viscosity "$scratch/run"
refused 1 "needs numpy, matplotlib and h5py" env PYTHONPATH="$scratch/broken" $configuration a.h5 b.png

[ $failures -eq 0 ] && echo "all plots as expected"
exit $((failures > 0))
