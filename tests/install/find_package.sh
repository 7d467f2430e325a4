#!/usr/bin/env bash
# find_package.sh SOURCE BUILD VERSION: installs below a prefix of its own; the examples then find it, build and work.
set -euo pipefail
source=$1 build=$2 version=$3
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT
cd -- "$scratch"
quietly() { "$@" >log 2>&1 || { tail -n 30 log; exit 1; }; }
for component in development program; do
  quietly cmake --install "$build" --component "$component" --prefix "$scratch/prefix"
done
cp -r "$source/examples" examples
make() { # FOLDER
  quietly cmake -S "examples/$1" -B "built/$1" -G Ninja "-DCMAKE_PREFIX_PATH=$scratch/prefix"
  quietly cmake --build "built/$1"
}

make fit
built/fit/fit_example examples/pendulum/model.yaml examples/pendulum/steps '*damping*' | tee fitted
# The recording was simulated with 2e-4 N m s/rad; the model begins at half of it.
awk '$1 == "viscous@drive:damping" { found = $3 } END { exit !(found > 1.98e-4 && found < 2.02e-4) }' fitted ||
  { echo "the damping is not found"; exit 1; }
status=0
built/fit/fit_example examples/pendulum/model.yaml nowhere '*' 2>refused || status=$?
[ "$status" -eq 2 ] && [ "$(wc -l <refused)" -eq 1 ] && grep -q nowhere refused || { echo "not refused in one line"; cat refused; exit 1; }

make controller
PLUMBLINE_CONTROLLERS=$scratch/built/controller prefix/bin/plumbline simulate --scenario examples/controller/scenario.yaml \
  -o glide.csv >simulated
grep -q "glide, version 1" simulated
# Wanted are 25 rad; gravity pulls the arm back against a proportional controller.
tail -n 1 glide.csv | awk -F, '{ exit !($2 > 22 && $2 < 25) }' || { echo "the arm was not lifted"; exit 1; }

# A version that is not there is refused, and by CMake's own words.
sed 's/find_package(Plumbline [0-9.]*/find_package(Plumbline 99.0/' -i examples/controller/CMakeLists.txt
! cmake -S examples/controller -B built/other -G Ninja "-DCMAKE_PREFIX_PATH=$scratch/prefix" >log 2>&1
grep -q "version: $version" log || { tail -n 20 log; exit 1; }
echo "installed: $(du -sm prefix | cut -f 1) MB"
