#!/usr/bin/env bash
# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# ./lucy on machines that are not this one: a copy of the launcher runs among stand-ins for dpkg-query, apt-get, sudo,
# id, cmake and ninja, which note how they were called. Nothing is installed and nothing is compiled.
set -euo pipefail

launcher=${LUCY_SOURCE_DIRECTORY:?}/lucy
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

problem() {
  printf 'FAILED: %s: %s\n' "$scene" "$*" >&2
  sed 's/^/  | /' "$work/out" "$work/err" "$calls" >&2
  failures=$((failures + 1))
}

stand_in() {
  printf '#!/bin/bash\n%s\n' "$2" >"$bin/$1"
  chmod +x "$bin/$1"
}

# A source folder with only the launcher in it, and a PATH with only what a bare machine has and the stand-ins.
# Knobs, as files in $tree: missing (packages not installed), user (uid), lists_absent, broken, slow.
new_machine() {
  scene=$1
  tree=$work/${scene// /_}
  bin=$tree/.bin
  calls=$tree/.calls
  mkdir -p "$bin"
  : >"$calls"
  cp "$launcher" "$tree/lucy"
  printf '0\n' >"$tree/user"
  : >"$tree/missing"
  local tool
  for tool in bash cat chmod cksum dirname env flock grep mkdir nproc readlink rm sed sleep tail touch true; do
    ln -s "$(type -P "$tool")" "$bin/$tool"
  done
  stand_in id "cat $tree/user"
  stand_in dpkg-query "
    for package; do
      [[ \$package == -* || \$package == *Status* ]] && continue
      grep -qxF \"\$package\" $tree/missing || echo \"installed \$package\"
    done"
  stand_in apt-get "
    echo \"apt-get \$*\" >>$calls
    case \" \$* \" in
      *' update '*) rm -f $tree/lists_absent ;;
      *' install '*)
        [[ -e $tree/lists_absent ]] && { echo 'E: Unable to locate package'; exit 100; }
        : >$tree/missing ;;
    esac"
  stand_in cmake "echo \"cmake \$*\" >>$calls; touch $tree/build/build.ninja"
  stand_in ninja "
    [[ \" \$* \" == *' -t query '* ]] && exit 0
    echo \"ninja begins \$*\" >>$calls
    [[ -e $tree/slow ]] && sleep 1
    echo '[1/2] Looking up the commit'
    if [[ -e $tree/broken ]]; then
      echo 'FAILED: particle.o'
      echo 'particle.cpp:1: error: no such particle'
      exit 1
    fi
    if [[ ! -e $tree/build/lucy ]]; then
      echo '[2/2] Building CXX object x'
      printf '#!/bin/bash\necho \"ran \$*\"\nexit \"\${1:-0}\"\n' >$tree/build/lucy
    fi
    chmod +x $tree/build/lucy
    echo 'ninja ends' >>$calls"
  stand_in ctest "echo \"ctest \$*\" >>$calls; [[ ! -e $tree/tests_fail ]] || exit 8"
}

add_sudo() {
  stand_in sudo "
    echo \"sudo \$*\" >>$calls
    [[ \$1 == -n ]] && shift
    exec \"\$@\""
}

launch() {
  status=0
  (cd / && PATH=$bin "$tree/lucy" "$@") >"$work/out" 2>"$work/err" </dev/null || status=$?
}

exits() { [[ $status == "$1" ]] || problem "exit code $status instead of $1"; }
says() { grep -qF -- "$1" "$work/err" || problem "standard error does not say '$1'"; }
prints() { grep -qxF -- "$1" "$work/out" || problem "standard output has no line '$1'"; }
called() { grep -qE -- "$1" "$calls" || problem "no call '$1'"; }
not_called() { if grep -qE -- "$1" "$calls"; then problem "call '$1'"; fi; }

new_machine "everything there"
launch 3 "two words"
exits 3
prints "ran 3 two words"
says "building in"
called 'cmake --fresh --preset release'
not_called '^(apt-get|sudo)'
: >"$calls"
launch 4
exits 4
[[ ! -s $work/err ]] || problem "it speaks although nothing was built"
not_called 'cmake'

new_machine "root with packages missing"
printf 'libgsl-dev\nninja-build\n' >"$tree/missing"
launch 0
exits 0
says "installing with apt-get: ninja-build libgsl-dev"
called '^apt-get .*install .*ninja-build libgsl-dev$'
not_called 'update|sudo'

new_machine "root without package lists"
echo g++ >"$tree/missing"
touch "$tree/lists_absent"
launch 0
exits 0
called '^apt-get .* update$'
[[ $(grep -c ' install ' "$calls") == 2 ]] || problem "the installation was not tried again"

new_machine "user with sudo"
echo 1000 >"$tree/user"
echo cmake >"$tree/missing"
add_sudo
launch 0
exits 0
says "installing with apt-get through sudo: cmake"
called '^sudo env .*apt-get'

new_machine "user without sudo"
echo 1000 >"$tree/user"
echo cmake >"$tree/missing"
launch 0
exits 1
says "needs root or sudo: cmake"
not_called .

new_machine "user without sudo and without matplotlib"
echo 1000 >"$tree/user"
echo python3-matplotlib >"$tree/missing"
launch 0
exits 0
says "going on without pictures"
launch 0
exits 0
[[ ! -s $work/err ]] || problem "it complains again"

new_machine "tests need GoogleTest and pass their exit code on"
echo libgtest-dev >"$tree/missing"
launch 0
exits 0
not_called apt-get
launch test -R box
exits 0
called '^apt-get .*install .*libgtest-dev$'
called '^ninja begins .*lucy_program lucy_tests$'
called '^ctest .* -R box$'
touch "$tree/tests_fail"
launch test
exits 1

new_machine "a build that fails"
touch "$tree/broken"
launch 0
exits 1
says "particle.cpp:1: error: no such particle"
says "the build failed"

new_machine "a folder that was moved"
launch 0
mv "$tree" "$tree.moved"
ln -s "$tree.moved" "$tree"
: >"$calls"
launch 0
exits 0
called 'cmake --fresh'
called 'ninja begins .* -t clean'

new_machine "two launches at once"
touch "$tree/slow"
launch 0 &
first=$!
(launch 0 && exit "$status")
wait "$first"
[[ $(grep -o 'ninja [a-z]*' "$calls" | tr '\n' ' ') == 'ninja begins ninja ends ninja begins ninja ends ' ]] ||
  problem "the two builds overlapped"

exit $((failures > 0))
