#!/usr/bin/env bash
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# ./lucy over a build that is up to date: silent, exit codes passed on, paths taken from the caller's folder.
set -euo pipefail

root=${LUCY_SOURCE_DIRECTORY:?}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

# expect NAME STATUS ARGS...: runs ./lucy ARGS in $work, keeps its output, compares the exit code.
expect() {
  local name=$1 expected=$2 status=0
  shift 2
  (cd "$work" && "$root/lucy" "$@") >"$work/out" 2>"$work/err" || status=$?
  if [[ $status != "$expected" ]]; then
    printf 'FAILED: %s: exit code %s instead of %s\n' "$name" "$status" "$expected" >&2
    cat "$work/out" "$work/err" >&2
    failures=$((failures + 1))
  fi
}

silent() {
  if [[ -s $work/err ]]; then
    printf 'FAILED: %s: standard error holds\n' "$1" >&2
    cat "$work/err" >&2
    failures=$((failures + 1))
  fi
}

expect "bring the build up to date" 0 --version
expect "nothing to build" 0 --version
silent "nothing to build"
grep -qF 0.1.0 "$work/out" || { echo "FAILED: --version printed no version" >&2; failures=$((failures + 1)); }

cp "$root/inputs/quick.toml" "$work/here.toml"
expect "a path relative to the caller's folder" 0 check here.toml
silent "a path relative to the caller's folder"

expect "bad input" 2 check missing.toml
grep -qF missing.toml "$work/err" || { echo "FAILED: the missing file is not named" >&2; failures=$((failures + 1)); }
if grep -qE 'building|installing' "$work/err"; then
  echo "FAILED: the launcher spoke although there was nothing to build" >&2
  failures=$((failures + 1))
fi
expect "bad usage" 2 no-such-command

ln -s "$root/lucy" "$work/link"
status=0
(cd / && "$work/link" --version) >/dev/null 2>"$work/err" || status=$?
[[ $status == 0 ]] || { echo "FAILED: called through a symbolic link" >&2; failures=$((failures + 1)); }
silent "called through a symbolic link"

exit $((failures > 0))
