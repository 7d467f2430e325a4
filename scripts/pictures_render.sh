#!/usr/bin/env bash
# Makes the pictures of the robot in docs/images: hops, stills and a strip, and the hopper. Needs PLUMBLINE, the program.
set -euo pipefail

root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)
program=${PLUMBLINE:-$root/build/validation/cli/plumbline}
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$root"
mkdir -p docs/images

"$program" simulate --scenario robots/mabel/scenarios/hopping.yaml --seconds 4 -o "$work/plane.csv"
"$program" simulate --scenario robots/mabel/scenarios/hopping_boom.yaml --seconds 3 -o "$work/boom.csv"

draw() { "$program" render --trace "$work/$1.csv" --model "robots/mabel/$2" "${@:4}" -o "docs/images/$3.png"; }

draw plane mabel_planar.yaml hop_stance --at 1.56s --size 640x480
draw plane mabel_planar.yaml hop_strip --from 1.499s --to 1.859s --strip 13 --size 1200x400
draw boom mabel.yaml hop_boom --at 1.54s --camera boom --size 800x480

hopper=robots/hopper
"$program" twin --model $hopper/hopper.yaml --with ground_stiffness_error@toe:scale=1.1 --experiment $hopper/experiments/bounce.yaml -o "$work/twin"
"$program" render "$work/twin/bounce" --at 0.93s --size 720x560 -o docs/images/hopper.png
