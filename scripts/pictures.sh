#!/usr/bin/env bash
# Makes the README's pictures again (docs/images). Needs PLUMBLINE, the program, or ./plumb build before; Chromium and
# Node.js, which ./plumb test installs; and once the npm client.
set -euo pipefail

root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)
program=${PLUMBLINE:-$root/build/validation/cli/plumbline}
npm=$root/build/npm
data=validation/trials/leg_bench_demo
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$root"

report_pictures() {
  "$program" report "$data/siso_mLA" "$data/siso_mLS" "$data/mimo" -o "$work/report.html"
  cmake -DROOT="$root" -DNPM="$npm" -DPAGE="$work/report.html" -DOUT="$root/docs/images" -P scripts/pictures.cmake
}

mkdir -p docs/images
report_pictures
