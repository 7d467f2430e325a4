#!/usr/bin/env bash
# package.sh BUILD VERSION: the package has what a newcomer needs, and its program works from where it is unpacked.
set -euo pipefail
build=$1 version=$2
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT
cd -- "$scratch"
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$scratch/made" >log 2>&1 || { tail -n 30 log; exit 1; }
package=$(ls "$scratch"/made/plumbline_"$version"*.deb)
dpkg-deb --field "$package" Depends | grep -q libsimbody || { echo "the package does not ask for Simbody"; exit 1; }
dpkg-deb -x "$package" root
PATH=$scratch/root/usr/bin:$PATH
share=$scratch/root/usr/share/plumbline
plumbline --version | grep -q "$version"
plumbline check "$share/robots/mabel/leg_bench.yaml" >/dev/null
demo=$share/validation/trials/leg_bench_demo
plumbline compare "$demo/siso_mLA" "$demo/siso_mLS" "$demo/mimo" --json compare.json >/dev/null
grep -q '"held_out"' compare.json
plumbline add cable_stretch --at leg_angle --model "$share/robots/mabel/leg_bench.yaml" -o added.yaml >/dev/null
drive --help >/dev/null
PLUMBLINE_CONTROLLERS='' plumbline simulate --scenario "$share/robots/mabel/scenarios/hopping.yaml" --help >/dev/null
PYTHONPATH=$scratch/root/usr/lib/python3/dist-packages /usr/bin/python3 -c '
import plumbline
assert plumbline.load_model("'"$share"'/robots/mabel/leg_bench.yaml").motors'
echo "$(basename "$package"): $(du -k "$package" | cut -f 1) kB"
