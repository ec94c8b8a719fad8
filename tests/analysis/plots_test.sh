#!/bin/bash
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The plotting scripts on small made-up inputs: pictures appear, nothing is dropped in silence, mistakes get a sentence.
# Exit 77 (skipped) when this machine's Python has no numpy, matplotlib or h5py.
# Commands stand in variables with their interpreter, to be split into words.
# shellcheck disable=SC2086
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
# texts_of SVG: the texts, which matplotlib keeps as comments; expect_text SVG TEXT: it says so
texts_of() { sed -n 's/^ *<!-- \(.*\) -->$/\1/p' "$1"; }
expect_text() { texts_of "$1" | grep -qF -- "$2" || fail "$1 does not say: $2"; }
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

expect_text "$scratch/run/viscosity.svg" "one particle has over 20 %"
expect_text "$scratch/run/viscosity.svg" "published,"
expect_text "$scratch/run/viscosity.svg" "Misprinted published cells"
texts_of "$scratch/run/viscosity.svg" | grep -q 'Lucy.* = 64' || fail "no legend entry of N = 64"

# The value that nobody can read in print is spoken of only beside our own row.
grep -q misprinted "$scratch/output" && fail "a note on a row that was not run"
mkdir "$scratch/other"
other_run() { # other_run ROWS [SED_COMMAND]: plots these rows, with input.toml edited
  { head -n 1 "$scratch/run/table.csv"; printf '%s\n' "$1"; } > "$scratch/other/table.csv"
  sed "${2:-}" "$scratch/run/input.toml" > "$scratch/other/input.toml"
  rm -f "$scratch/other"/viscosity.*
  $viscosity "$scratch/other" > "$scratch/output" 2> "$scratch/error" || fail "$1: $(cat "$scratch/error")"
  [ -s "$scratch/error" ] && fail "plot_viscosity.py warns: $(cat "$scratch/error")"
}
other_run "1024,1,0.005,13,0.2,711,76,0.008,ok"
expect_note "rate 0.005 (faint) contains a misprinted digit"

# Published points stand beside runs under the published conditions only.
row="1024,1,0.5,0.422,0.001,3.41,0.01,0.009,ok"
other_run "$row"
grep -q "left out" "$scratch/output" && fail "published points left out: $(cat "$scratch/output")"
other_run "1024,1,-0.5,0.422,0.001,3.41,0.01,0.009,ok"
expect_text "$scratch/other/viscosity.svg" "published,"
for change in 's/density = 1.0/density = 0.8/' 's/range = 3.0/range = 4.0/' 's/isoenergetic/isokinetic/' 's/=/= =/'; do
  other_run "$row" "$change"
  expect_note "left out"
  texts_of "$scratch/other/viscosity.svg" | grep -q "published, " && fail "published points after $change"
done
expect_note "no readable input.toml"
state='particles = 1024\nenergy_per_particle = 1.0\nstrain_rate'
other_run "$row"$'\n'"1024,1,1,0.17,0.001,0.9,0.01,0.009,ok" \
  "\$a[[point]]\n$state = 0.5\n[[point]]\n$state = 1.0\ndensity = 0.8"
expect_note "published points are in part left out"
expect_note "density = 0.8"

# Nothing to plot: a sentence and no picture. A failed row beside others: no entry in the legend.
other_run "1024,1,0.5,nan,nan,nan,nan,nan,failed"
expect_note "viscosity plot: not drawn"
[ "$(wc -l < "$scratch/output")" -eq 1 ] || fail "more than a sentence: $(cat "$scratch/output")"
[ -e "$scratch/other/viscosity.png" ] && fail "a picture of nothing"
other_run "$row"$'\n'"256,1,0.5,nan,nan,nan,nan,nan,failed"
texts_of "$scratch/other/viscosity.svg" | grep -q 'Lucy.*256' && fail "a legend entry of a failed row"

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
expect_note "viscosity plot: not drawn"

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
for name in zero whole; do
  $configuration "$scratch/run/point_$name.h5" "$scratch/$name.svg" || fail "plot_configuration.py, point_$name.h5"
  texts_of "$scratch/$name.svg" | grep -qx "image offset 0" || fail "rounding is shown as an offset"
done
$configuration "$scratch/run/point_001.h5" "$scratch/offset.svg" || fail "plot_configuration.py, SVG"
expect_text "$scratch/offset.svg" "image offset 6.5"
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
