#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian package in a separate minimal Debian 12, and uses it there as a user would.
# Usage, as root: clean_system.sh PACKAGE.deb FOLDER MIRROR. debootstrap makes FOLDER if it is missing, and it is kept;
# MIRROR is the address of a Debian archive. Needs debootstrap and some 700 MB.
set -euo pipefail
[ $# = 3 ] || { sed -n '3,4s/^# //p' "$0" >&2; exit 2; }
package=$(realpath "$1") root=$2 mirror=$3

[ -d "$root/usr/bin" ] || debootstrap --variant=minbase bookworm "$root" "$mirror"
inside() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
trap 'for folder in dev sys proc; do ! mountpoint -q "$root/$folder" || umount "$root/$folder"; done' EXIT
for folder in proc sys dev; do mountpoint -q "$root/$folder" || mount --bind "/$folder" "$root/$folder"; done
[ ! -e /etc/resolv.conf ] || cp -L /etc/resolv.conf "$root/etc/resolv.conf"

cp "$package" "$root/root/wavetracer.deb"
inside apt-get update -qq
inside apt-get install -qq -y --no-install-recommends man-db pocl-opencl-icd /root/wavetracer.deb >/dev/null

fail() {
  printf 'failed: %s\n' "$*" >&2
  exit 1
}
grep -q '^wavetracer [0-9]' <<<"$(inside wavetracer --version)" || fail "--version"
grep -q '^\*.* CPU ' <<<"$(inside wavetracer devices)" || fail "devices: no CPU device is chosen"
inside wavetracer run -c /usr/share/wavetracer/configs/city.toml --set trace.rays=20000 -o /root/out
for file in paths.h5 links.csv summary.json; do [ -s "$root/root/out/$file" ] || fail "run wrote no $file"; done
awk -F, 'NR > 1 { links += 1 } END { exit links == 0 }' "$root/root/out/links.csv" || fail "links.csv has no links"
inside wavetracer view /root/out -o /root/view.html
inside wavetracer plot /root/out -o /root/plots
inside wavetracer convert /root/out -o /root/out.npz
for file in view.html out.npz; do [ -s "$root/root/$file" ] || fail "no $file"; done
ls "$root"/root/plots/*.csv >/dev/null || fail "plot wrote no data"
for page in wavetracer wavetracer.toml; do inside man -w "$page" >/dev/null || fail "man -w $page"; done
inside bash -c 'source /usr/share/bash-completion/completions/wavetracer && complete -p wavetracer' >/dev/null || fail "completion"
grep -q libwavetracer.so <<<"$(inside ldconfig -p)" || fail "the library is not in the cache of the loader"
inside apt-get remove -qq -y wavetracer >/dev/null
[ ! -e "$root/usr/bin/wavetracer" ] || fail "the program stays after its removal"
printf 'the package serves a clean system\n'
