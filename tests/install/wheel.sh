#!/usr/bin/env bash
# wheel.sh SOURCE BUILD VERSION: pip makes a wheel of the tree and installs it, without an index; the package then works
# from a folder that has nothing to do with either.
set -euo pipefail
source=$1 build=$2 version=$3
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT
cd -- "$scratch"
# An environment of pip's that names an index, or folders, must not help.
pip() { env -u PIP_FIND_LINKS PIP_NO_INDEX=1 PIP_DISABLE_PIP_VERSION_CHECK=1 "$1" -m pip "${@:2}"; }
pip /usr/bin/python3 wheel --no-deps --config-settings "build-dir=$build" -w made "$source" >log 2>&1 || { tail -n 30 log; exit 1; }
wheel=$(ls made/plumbline-"$version"-cp*-linux_*.whl)
/usr/bin/python3 -m venv --system-site-packages own  # numpy is Debian's
pip own/bin/python install --no-index "$wheel" >log 2>&1 || { tail -n 30 log; exit 1; }
cat >use.py <<'END'
import sys
import plumbline
source, version = sys.argv[1:]
assert plumbline.__version__ == version, plumbline.__version__
assert "/own/" in plumbline.__file__, plumbline.__file__
model = plumbline.load_model(source + "/examples/pendulum/model.yaml")
trial = plumbline.load_trial(source + "/examples/pendulum/steps", model=model)
found = plumbline.fit([trial], "*damping*", model=model)
print(found)
try:
    plumbline.load_model("nowhere.yaml")
except plumbline.InputError as error:
    assert "nowhere.yaml" in str(error)
else:
    raise SystemExit("a model that is not there was read")
END
own/bin/python use.py "$source" "$version"
pip own/bin/python uninstall --yes plumbline >log 2>&1
! own/bin/python -c 'import plumbline' 2>/dev/null || { echo "the wheel's list of files leaves some behind"; exit 1; }
echo "$(basename "$wheel"): $(du -k "$wheel" | cut -f 1) kB"
