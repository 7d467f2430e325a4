#!/usr/bin/env bash
# The tour on the shipped bench data: a leg whose log hides one effect that its model does not have.
# Needs PLUMBLINE, the program; writes into out/demo, where the models and the report stay.
set -euo pipefail

root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)
program=${PLUMBLINE:?the path of the plumbline program}
data=$root/validation/trials/leg_bench_demo
work=out/demo
cd -- "$root"
mkdir -p -- "$work"

trials=("$data/siso_mLA" "$data/siso_mLS" "$data/mimo")
model=robots/mabel/leg_bench.yaml

step() { printf '\n=== %s\n\n$ plumbline %s\n\n' "$1" "$2"; }

step "1. Hold the model against the measurements" "compare TRIALS --model $model"
"$program" compare "${trials[@]}" --model "$model"

step "2. Ask which physics is missing" "diagnose TRIALS --model $model"
"$program" diagnose "${trials[@]}" --model "$model" --json "$work/diagnosis.json" --save "$work/found.yaml"

effect=$(sed -n 's/^ *"effect": "\(.*\)",*$/\1/p' <(sed -n '/"accepted"/,/"candidates"/p' "$work/diagnosis.json") | head -n 1)
at=$(sed -n 's/^ *"at": "\(.*\)",*$/\1/p' <(sed -n '/"accepted"/,/"candidates"/p' "$work/diagnosis.json") | head -n 1)
if [[ -z $effect ]]; then
  echo "The diagnosis named nothing: the demo ends here."
  exit 1
fi

step "3. Add it to the model" "add $effect --at $at --model $model -o added.yaml"
"$program" add "$effect" --at "$at" --model "$model" -o "$work/added.yaml"

step "4. Fit its values on the train trials" "fit TRIALS --model added.yaml --free '$effect@$at:*' -o fitted.yaml"
"$program" fit "${trials[@]}" --model "$work/added.yaml" --free "$effect@$at:*" -o "$work/fitted.yaml"

step "5. See the error fall, on a motion the fit never saw" "ladder TRIALS --model fitted.yaml"
"$program" ladder "${trials[@]}" --model "$work/fitted.yaml"

step "6. Look at it" "report TRIALS --model fitted.yaml --diagnosis diagnosis.json -o report.html"
"$program" report "${trials[@]}" --model "$work/fitted.yaml" --diagnosis "$work/diagnosis.json" -o "$work/report.html"

step "7. Watch it" "render mimo --model fitted.yaml --measured --whole -o mimo.png (and .mp4)"
draw() { "$program" render "$data/mimo" --model "$work/fitted.yaml" --measured --whole "$@"; }
draw --at 1.5s -o "$work/mimo.png" || echo "no picture: see the line above"
if command -v ffmpeg >/dev/null; then
  draw --from 1s --to 2s --fps 30 --size 640x360 -o "$work/mimo.mp4" || echo "no video: see the line above"
fi

printf '\nIn plain words: the model lacked %s at %s. What was hidden in the data stands in\n%s.\n' \
  "$effect" "$at" "validation/trials/leg_bench_demo/truth.json"
printf 'To look at: file://%s\n' "$root/$work/report.html" "$root/$work"/mimo.*
