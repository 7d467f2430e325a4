#!/usr/bin/env bash
# Proves that packages.txt is complete: a minimal Debian 12 in a temporary folder, nothing in it but this
# repository, and there ./plumb with the given arguments (without any: build). Needs root and debootstrap.
# Everything is removed at the end.
set -euo pipefail

root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)
mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}

if ((EUID != 0)) || ! command -v debootstrap >/dev/null; then
  echo "fresh_machine: must be root, with debootstrap installed" >&2
  exit 2
fi

machine=$(mktemp -d "${TMPDIR:-/tmp}/plumbline-fresh.XXXXXX")
clean_up() {
  local place
  for place in proc dev; do
    if mountpoint -q "$machine/$place"; then umount -- "$machine/$place" || return; fi
  done
  rm -rf --one-file-system -- "$machine"
}
trap clean_up EXIT

echo "fresh_machine: installing a minimal Debian 12 in $machine" >&2
debootstrap --variant=minbase bookworm "$machine" "$mirror" >"$machine.log" 2>&1 || {
  tail -n 20 -- "$machine.log" >&2
  exit 3
}
rm -f -- "$machine.log"
mount -t proc proc "$machine/proc"
mount --bind /dev "$machine/dev"
cp -L -- /etc/resolv.conf "$machine/etc/resolv.conf"
mkdir -p "$machine/plumbline"
tar -C "$root" -c --exclude='./build*' --exclude=./.git . | tar -C "$machine/plumbline" -x --no-same-owner

chroot "$machine" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
  /plumbline/plumb "${@:-build}"
