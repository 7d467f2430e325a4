#!/usr/bin/env bash
# Everything that is too long for every run of continuous integration, in six slices that take turns. scripts/slices.txt says what
# a slice consists of; each line of it is one test of ctest, label `slice` (tests/slices), and runs `slices.sh piece`.
#
#   slices.sh number            the slice whose turn it is: the commit's number, modulo six
#   slices.sh names N           regular expression of the pieces of slice N
#   slices.sh others N          of what is neither a quick test nor a piece of slice N
#   slices.sh piece KIND WHAT SECONDS
#
# A piece ends with 0, with 1 when something is wrong (and says how to repeat it), or with 77 when it was cut off by its
# budget of seconds or lacks what it needs. ctest lists the latter as tests that did not run: a slow machine fails nobody.
set -euo pipefail

root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)
build=$root/build
table=$root/scripts/slices.txt
jobs=$(nproc)
readonly count=6 did_not_run=77

# Whoever owns the folder: a checkout in a container belongs to somebody else.
git_here() { git -c safe.directory="$root" -C "$root" "$@"; }

number() {
  if [[ ! -e $root/.git ]] || ! command -v git >/dev/null; then
    echo "slices: no git here: slice 0" >&2
    echo 0
  elif [[ $(git_here rev-parse --is-shallow-repository) == true ]]; then
    # The number is not known; the commit's name is as good.
    echo "slices: not all commits are here: a slice by the commit's name" >&2
    echo $((0x$(git_here rev-parse HEAD | cut -c1-8) % count))
  else
    echo $(($(git_here rev-list --count HEAD) % count))
  fi
}

# Lines of the table: slice (* for all of them), kind, what, seconds.
rows() { grep -vE '^(#|$|out )' "$table"; }

names() {
  local slice kind what seconds
  while read -r slice kind what seconds; do
    if [[ $slice == "$1" || $slice == '*' ]]; then echo "slice_${kind}_${what//\//_}"; fi
  done < <(rows)
}

as_expression() { printf '^(%s)$\n' "$(paste -sd '|')"; }

# The slow tests stand in the table, too: as pieces, and in its lines of what is left out.
others() {
  {
    comm -23 <(for ((slice = 0; slice < count; slice++)); do names "$slice"; done | sort -u) <(names "$1" | sort -u)
    rows | awk '$2 == "slow" { print $3 }'
    awk '$1 == "out" && $2 == "slow" { print $3 }' "$table"
  } | as_expression
}

# within SECONDS HOW COMMAND...: HOW is what a person types to repeat it.
within() {
  local seconds=$1 how=$2 status=0 begin=$SECONDS
  shift 2
  timeout --kill-after=20 "$seconds" "$@" || status=$?
  if ((status == 124 || (status == 137 && SECONDS - begin >= seconds))); then
    echo "slices: cut off after $seconds s; whole: $how"
    exit "$did_not_run"
  elif ((status == did_not_run)); then
    exit "$did_not_run"
  elif ((status)); then
    echo "slices: failed (status $status); to repeat it: $how"
    exit 1
  fi
}

# ctest inside ctest keeps its log in a folder of its own; the outer one's stays whole.
slow() {
  local what=$1 folder=$build/slices/$1
  mkdir -p "$folder"
  printf 'subdirs("%s")\n' "$build" >"$folder/CTestTestfile.cmake"
  within "$2" "./plumb test --all -R '^$what\$'" \
    ctest --test-dir "$folder" -R "^$what\$" --no-tests=error --output-on-failure --timeout 3600 | tee "$folder/output"
  if grep -q '(Skipped)' "$folder/output"; then exit "$did_not_run"; fi
}

sanitized() {
  local what=$1
  local repeat="cmake --preset sanitize && cmake --build --preset sanitize --target test_$what && ctest --preset sanitize -R '^$what\$'"
  cd -- "$root"
  # shellcheck disable=SC2016 # the inner shell expands them
  within "$2" "$repeat" bash -euc '
    cmake --preset sanitize >/dev/null
    ninja -C build-sanitize -j "$1" "test_$2" | tail -n 20
    ctest --preset sanitize -R "^$2\$" --output-on-failure' _ "$jobs" "$what"
}

# C++ files that differ from what stood some commits ago: whoever landed several at once has all of them looked at.
changed_files() {
  local before
  before=$(git_here rev-list --first-parent --max-count=7 HEAD | tail -n 1)
  git_here diff --name-only --diff-filter=d "$before" HEAD -- '*.cpp' '*.h'
}

lint() {
  local -a files
  if [[ $1 == changed ]]; then
    if [[ ! -e $root/.git ]] || ! command -v git >/dev/null; then
      echo "slices: no git here: what has changed is not known"
      exit "$did_not_run"
    fi
    mapfile -t files < <(changed_files)
  else
    mapfile -t files < <(cd -- "$root" && find "${1//+//}" -name '*.cpp' | sort)
  fi
  if ((!${#files[@]})); then
    echo "slices: nothing to look at"
    return 0
  fi
  cd -- "$root"
  # The script stops by itself and says which files are left; the hard end is for a file that hangs.
  within $(($2 + 60)) "./plumb lint FILE (the files named above)" bash scripts/lint.sh --seconds "$2" "${files[@]}"
}

# Damaged inputs for every reader: as many on every machine, so that the same commit has the same answer.
fuzz() {
  within "$2" "build/tests/fuzz/fuzz_readers 3600 $1 '' 500" "$build/tests/fuzz/fuzz_readers" 3600 "$1" '' 500
}

gauntlet() {
  if [[ ! -d ${PLUMBLINE_GAUNTLET_DATA:-} ]]; then
    echo "slices: the recordings are not part of the repository; PLUMBLINE_GAUNTLET_DATA names no folder with them"
    exit "$did_not_run"
  fi
  mkdir -p "$build/slices"
  within "$2" "./plumb gauntlet --data \$PLUMBLINE_GAUNTLET_DATA --only '$1'" \
    env PLUMBLINE="$build/validation/cli/plumbline" PYTHONPATH="$build/python" /usr/bin/python3 \
    "$root/scripts/gauntlet/gauntlet.py" --data "$PLUMBLINE_GAUNTLET_DATA" --only "$1" --out "$build/slices/gauntlet" |
    tee "$build/slices/gauntlet-$1"
  # A machine whose folder is not there is left out by the gauntlet itself, without a row.
  if ! grep -q "^| .*$1" "$build/slices/gauntlet-$1"; then exit "$did_not_run"; fi
}

case ${1:-} in
  number) number ;;
  names) names "$2" | as_expression ;;
  others) others "$2" ;;
  piece)
    case $2 in
      slow | sanitized | lint | fuzz | gauntlet) "$2" "$3" "$4" ;;
      *) echo "slices: no such kind: $2" >&2 && exit 2 ;;
    esac
    ;;
  *)
    sed -n '5,8s/^# *//p' "${BASH_SOURCE[0]}" >&2
    exit 2
    ;;
esac
