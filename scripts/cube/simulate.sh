#!/usr/bin/env bash
# Simulates the held-out tosses in one piece: simulate.sh TRIALS MODEL OUT. TRIALS is what make_trials.py wrote.
set -euo pipefail

(($# == 3)) || { sed -n 2p "$0" >&2; exit 2; }
trials=$1 model=$2 out=$3
plumbline=${PLUMBLINE:-$(cd -- "$(dirname -- "$0")/../.." && pwd)/build/validation/cli/plumbline}
mkdir -p -- "$out"
for toss in "$trials"/toss_0[6-9]?; do
  name=${toss##*/}
  for frames in "$trials" "$trials.other" "$trials.last"; do
    if "$plumbline" simulate "$frames/$name" --model "$model" --method rosenbrock --tolerance 1e-5 -o "$out/$name.csv" \
      >/dev/null; then
      continue 2
    fi
  done
  echo "$name: not simulated" >&2
done
