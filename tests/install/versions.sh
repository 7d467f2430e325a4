#!/usr/bin/env bash
# versions.sh PROGRAM VERSION ROOT
set -euo pipefail
said=$("$1" --version | head -n 1)
heading=$(grep -m 1 '^## ' "$3/CHANGELOG.md")
[[ $said == *"$2"* ]] || { echo "--version says \"$said\", CMake $2"; exit 1; }
[[ $heading == "## $2"* ]] || { echo "the changelog begins with \"$heading\", CMake has $2"; exit 1; }
