#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the wheel with its extra `pocl` in a separate minimal Debian 12, which has python3 and python3-venv and
# neither a compiler nor OpenCL, and uses it there as a user without root would.
# Usage, as root: clean_system.sh WHEEL FOLDER MIRROR. debootstrap makes FOLDER if it is missing, and it is kept; MIRROR
# is the address of a Debian archive. Needs debootstrap, PyPI and some 2 GB. pip's variables (PIP_...) are passed on.
set -euo pipefail
[ $# = 3 ] || { sed -n '4,5s/^# //p' "$0" >&2; exit 2; }
wheel=$(realpath "$1") root=$2 mirror=$3

[ -d "$root/usr/bin" ] || debootstrap --variant=minbase --include=python3,python3-venv bookworm "$root" "$mirror"
chroot "$root" id user >/dev/null 2>&1 || chroot "$root" useradd --create-home user
mapfile -t pip < <(env | grep '^PIP_' || true)
if [ -n "${PIP_CERT:-}" ]; then install -D -m 644 "$PIP_CERT" "$root$PIP_CERT"; fi
inside() { chroot --userspec=user:user "$root" /usr/bin/env -i PATH=/home/user/venv/bin:/usr/bin:/bin HOME=/home/user LC_ALL=C.UTF-8 "${pip[@]}" "$@"; }
trap 'for folder in dev sys proc; do ! mountpoint -q "$root/$folder" || umount "$root/$folder"; done' EXIT
for folder in proc sys dev; do mountpoint -q "$root/$folder" || mount --bind "/$folder" "$root/$folder"; done
[ ! -e /etc/resolv.conf ] || cp -L /etc/resolv.conf "$root/etc/resolv.conf"

fail() {
  printf 'failed: %s\n' "$*" >&2
  exit 1
}
for program in cc ld clinfo; do ! inside sh -c "command -v $program" >/dev/null || fail "$program is there: this system is not bare"; done
[ ! -d "$root/etc/OpenCL" ] || fail "OpenCL drivers are there: this system is not bare"
rm -rf "$root/home/user/venv" "$root/home/user/out" "$root/home/user/.cache"
mkdir -p "$root/wheel"
rm -f "$root"/wheel/*
cp "$wheel" "$root/wheel/"
cd "$root/home/user"  # chroot keeps a current folder that is inside
inside python3 -m venv /home/user/venv
start=$(date +%s)
inside pip install -q "/wheel/$(basename "$wheel")[pocl]"
printf 'installed in %s s, %s in the environment\n' "$(($(date +%s) - start))" "$(du -sh "$root/home/user/venv" | cut -f 1)"

grep '^wavetracer [0-9]' <<<"$(inside wavetracer --version)" || fail "--version"
grep '^\*.* CPU ' <<<"$(inside wavetracer devices)" || fail "devices: no CPU device is chosen"
inside sh -c 'cd && wavetracer init --minimal >my.toml && wavetracer run -c my.toml -o out/mine' || fail "the first configuration"
rm -rf "$root/home/user/.cache"
start=$(date +%s)
inside sh -c 'cd && exec python3 -' <<'PYTHON' || fail "the demo in Python"
import wavetracer as wt

simulation = wt.Simulation(wt.configs / "demo.toml")
run = simulation.run("out/demo")
print(simulation.device, run, run[3].paths)
assert len(run) == 11 and len(run[3].paths) > 100
assert run[3].paths.select(tx="rsu").cfr([-5e6, 0, 5e6]).shape == (20, 1, 1, 1, 1, 3)
wt.view(run).save("demo.html")
PYTHON
printf 'the demo and its page from Python, kernels compiled anew: %s s\n' "$(($(date +%s) - start))"
inside sh -c 'cd && wavetracer view out/demo -o view.html && wavetracer convert out/demo -o demo.npz --frames 1 &&
  wavetracer convert out/demo -o demo.kml --projection "+proj=tmerc +lat_0=48.137 +lon_0=11.575 +ellps=WGS84 +units=m"' >/dev/null || fail "view and convert"
for file in demo.html view.html demo.npz demo.kml; do [ -s "$root/home/user/$file" ] || fail "no $file"; done
printf 'the wheel serves a bare system\n'
