#!/usr/bin/env bash
# Style (clang-format) and static analysis (clang-tidy) of the project's C++ files; run by ./plumb lint.
# Arguments: files to look at; without any, all of them. --seconds N before them: clang-tidy begins no file after that time, the
# files that are left are named, and the exit status is 77 if nothing else was wrong.
set -euo pipefail

root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)
build=$root/build
here=$PWD
seconds=
if [[ ${1:-} == --seconds ]]; then
  seconds=$2
  shift 2
fi

# All C++ files that git tracks or could track; without git, all outside the build folders.
project_files() {
  cd -- "$root"
  if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    git ls-files --cached --others --exclude-standard -- '*.h' '*.cpp'
  else
    find . -path './build*' -prune -o \( -name '*.h' -o -name '*.cpp' \) -print | sed 's|^\./||'
  fi | while IFS= read -r file; do
    if [[ -f $file ]]; then printf '%s\n' "$root/$file"; fi
  done
}

given_files() {
  cd -- "$here"
  readlink -e -- "$@"
}

if (($#)); then
  mapfile -t files < <(given_files "$@")
else
  mapfile -t files < <(project_files)
fi
((${#files[@]})) || {
  echo "lint: no C++ files" >&2
  exit 2
}

status=0
echo "lint: clang-format, ${#files[@]} files"
clang-format --dry-run -Werror "${files[@]}" || status=1

# Only what is compiled can be analysed; headers are seen through the files that include them.
if [[ ! -f $build/compile_commands.json ]]; then
  echo "lint: no build/compile_commands.json; run ./plumb build first" >&2
  exit 2
fi
database=$build/lint
mkdir -p "$database"
python3 "$root/scripts/lint_commands.py" "$build/compile_commands.json" "$database/compile_commands.json"
sources=()
for file in "${files[@]}"; do
  if [[ $file == *.cpp ]] && grep -qF "\"file\": \"$file\"" "$database/compile_commands.json"; then
    sources+=("$file")
  fi
done

# One file. A file that there is no time for is named, here and in the list of them.
look_at() {
  if [[ -n $end ]] && (($(date +%s) >= end)); then
    echo "lint: no time left for ${1#"$root/"}"
    echo "$1" >>"$left"
  else
    clang-tidy --quiet -p "$database" "$1"
  fi
}
export -f look_at
export root database end=${seconds:+$(($(date +%s) + seconds))} left=$database/left.$$
: >"$left"
trap 'rm -f -- "$left"' EXIT

echo "lint: clang-tidy, ${#sources[@]} files"
if ((${#sources[@]})); then
  # "N warnings generated" counts what other people's headers said and is dropped.
  printf '%s\0' "${sources[@]}" |
    xargs -0 -n 1 -P "$(nproc)" bash -c 'look_at "$1"' _ \
      2> >(grep -vE '^[0-9]+ warnings?( and [0-9]+ errors?)? generated\.$' >&2 || true) || status=1
fi

if ((status)); then
  echo "lint: failed" >&2
elif [[ -s $left ]]; then
  echo "lint: clean as far as it came; $(wc -l <"$left") of ${#sources[@]} files were not looked at"
  status=77
else
  echo "lint: clean"
fi
exit "$status"
