#!/usr/bin/env bash
# ATRIAS at 1 m/s with one imperfection after the other, and over steps in the ground: the tables of docs/results/atrias.md.
#   scripts/atrias_ladder.sh [ladder|ground]     with no word: both. Some minutes.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
program=${PLUMBLINE:-$root/build/validation/cli/plumbline}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
robot=$root/robots/atrias
# What the controller counts with where the gears have no friction.
no_friction=(--set friction=0 --set load_friction=0)

simulate() {  # scenario model options...
  "$program" simulate --scenario "$robot/scenarios/$1.yaml" --model "$robot/$2" "${@:3}" -o "$work/run.csv" > "$work/run.txt"
}
rung() {  # name scenario model options...
  simulate "$2" "$3" "${@:4}" --seconds 20
  echo "$1 |$(python3 "$root/scripts/running_errors.py" "$work/run.csv" | tail -1 | cut -d'|' -f2-) | $(head -1 "$work/run.txt" | grep -o 'then: .*' || true)"
}

ladder() {
  echo "imperfection | steps | speed error m/s | estimated m/s | apex error cm | x cm | z cm | lean deg | feedback N | force error N | spring torque N m | impact N | flight ms | stance ms | end"
  rung "none" running ladder/ideal.yaml "${no_friction[@]}"
  rung "gears: Coulomb friction" running ladder/coulomb.yaml "${no_friction[@]}"
  rung "gears: friction under load" running ladder/load_friction.yaml "${no_friction[@]}"
  rung "gears: viscous friction" running ladder/viscous.yaml "${no_friction[@]}"
  rung "gears: all three" running ladder/gears.yaml "${no_friction[@]}"
  rung "gears: all three, compensated" running ladder/gears.yaml
  rung "mass of the legs" running ladder/legs.yaml "${no_friction[@]}"
  rung "leaf springs as measured" running ladder/springs.yaml "${no_friction[@]}"
  rung "centre of mass 2 cm ahead" running ladder/trunk.yaml "${no_friction[@]}"
  rung "5 % more mass" running ladder/heavy.yaml "${no_friction[@]}"
  rung "inclinometer off by 2 deg" running ladder/tilt.yaml "${no_friction[@]}"
  rung "boom, not counted with" running ladder/boom.yaml "${no_friction[@]}"
  rung "boom, counted with" running_boom ladder/boom.yaml "${no_friction[@]}"
  rung "drives: torque loop of 60 1/s" running ladder/ideal.yaml "${no_friction[@]}" --set torque_rate=60
  rung "drives: torque loop of 30 1/s" running ladder/ideal.yaml "${no_friction[@]}" --set torque_rate=30
  rung "drives: 100 A" running ladder/ideal.yaml "${no_friction[@]}" --set current_limit=100
  rung "filters as the thesis prints them" running ladder/ideal.yaml "${no_friction[@]}" --set force_noise=5 --set loaded_variance=0.05 --set unloaded_variance=1000
  rung "contact at 80 % of the weight" running ladder/ideal.yaml "${no_friction[@]}" --set contact=0.8
  rung "no adaptation" running ladder/ideal.yaml "${no_friction[@]}" --set learn=0
  rung "the machine in the plane" running atrias.yaml
  rung "the machine at its boom" running_boom atrias_boom.yaml
  rung "its springs as measured" running_boom atrias_measured_springs.yaml
  rung "its centre of mass 2 cm ahead, no compensation" running_boom ladder/everything.yaml "${no_friction[@]}"
  rung "and a torque loop of 60 1/s" running_boom ladder/everything.yaml "${no_friction[@]}" --set torque_rate=60
}

ground() {
  echo "step in the ground, edge | end | speed errors of the steps from there on, m/s"
  for height in 0.06 0.11 0.15 -0.06 -0.11 -0.15; do
    for edge in 10.15 10.3 10.4; do
      simulate running atrias.yaml --platform "$edge" 1000 "$height" --seconds 14
      echo "$height m, $edge m | $(head -1 "$work/run.txt" | grep -o 'then: .*' || echo runs on) |" \
        "$(python3 "$root/scripts/running_errors.py" "$work/run.csv" --steps | awk '$2 > 10.3 {printf "%s ", $10}')"
    done
  done
}

case ${1:-both} in
  ladder) ladder ;;
  ground) ground ;;
  both) ladder; echo; ground ;;
  *) echo "$0: found '$1', expected ladder or ground" >&2; exit 2 ;;
esac
