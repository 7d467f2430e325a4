#!/usr/bin/env bash
# Fits MuJoCo's and Bullet's contact to the train tosses and predicts the held-out ones: peers.sh DATA EVALUATIONS OUT.
# Needs Debian's libmujoco-dev, libbullet-dev and libeigen3-dev; writes OUT/mujoco and OUT/bullet.
set -euo pipefail

(($# == 3)) || { sed -n 2p "$0" >&2; exit 2; }
data=$1 evaluations=$2 out=$3
here=$(cd -- "$(dirname -- "$0")" && pwd)
mkdir -p -- "$out"
g++ -O2 -std=c++17 -DBT_USE_DOUBLE_PRECISION -isystem /usr/include/bullet -isystem /usr/include/eigen3 "$here/peers.cpp" \
  -o "$out/peers" -lmujoco -lBulletDynamics-float64 -lBulletCollision-float64 -lLinearMath-float64
for simulator in mujoco bullet; do
  "$out/peers" "$simulator" "$data" "$evaluations" "$out/$simulator"
done
