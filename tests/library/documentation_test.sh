#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests man pages, which man reads without a warning, completions, which bash answers with, and the reference, which
# must be up to date. Usage: documentation_test.sh PROGRAM SOURCE_FOLDER FOLDER
set -euo pipefail
program=$1 source=$2 folder=$3
rm -rf "$folder"
mkdir -p "$folder"
failed=0
fail() {
  printf 'failed: %s\n' "$*" >&2
  failed=1
}

# --- man pages ---
"$program" documentation --man program -o "$folder/wavetracer.1"
"$program" documentation --man config -o "$folder/wavetracer.toml.5"
for page in wavetracer.1 wavetracer.toml.5; do
  if command -v man >/dev/null; then
    warnings=$(MANROFFSEQ='' MANWIDTH=80 LC_ALL=C.UTF-8 man --warnings -E UTF-8 -l -Tutf8 -Z "$folder/$page" 2>&1 >/dev/null)
    [ -z "$warnings" ] || fail "$page: $warnings"
    MANWIDTH=100 LC_ALL=C.UTF-8 man -E UTF-8 -l "$folder/$page" | col -b >"$folder/$page.txt"
  fi
done
if command -v man >/dev/null; then
  for words in 'wavetracer run' '--resume' 'EXIT STATUS' 'NO_COLOR' 'scene info'; do
    grep -q -e "$words" "$folder/wavetracer.1.txt" || fail "wavetracer.1 does not say $words"
  done
  # The page has every key that init prints.
  for key in $("$program" init | sed -n 's/^#\{0,1\} *\([a-z0-9_]*\) = .*/\1/p'); do
    grep -q -e "^ *$key" "$folder/wavetracer.toml.5.txt" || fail "wavetracer.toml.5 has no $key"
  done
fi

# --- completions ---
"$program" documentation --completion bash -o "$folder/bash"
bash -n "$folder/bash" || fail "bash completion"
# answer WORDS...: prints what bash offers for the last word; NAME=VALUE are three words, as bash splits them.
answer() {
  bash -c '
    source "$1"; shift
    compopt() { :; }
    COMP_WORDS=(wavetracer "$@"); COMP_CWORD=$#
    _wavetracer; printf "%s\n" "${COMPREPLY[@]}"' bash "$folder/bash" "$@" | sort | tr '\n' ' '
}
expect() {
  local wanted=$1 got
  shift
  got=$(answer "$@")
  [ "$got" = "$wanted" ] || fail "after \"$*\": \"$got\" instead of \"$wanted\""
}
expect 'run ' ru
expect 'city info materials radar ' scene ''
expect '--resume ' run --res
expect 'trace.rays= ' run -c file.toml --set trace.ra
expect 'fibonacci hilbert horizon random ' run --set trace.directions = ''
expect 'hilbert ' run --set trace.directions = hi
expect 'false true ' run --set trace.reuse =
expect 'auto y z ' scene info --up ''
expect 'all ' thesis al
expect 'vtk ' convert --to v
expect 'coverage ' plot --what cov
expect 'receiver receiver_grid ' help rec
expect 'order.bin_num order.each_depth order.method ' help order.
expect 'brick ' scene city --ground br
expect ' ' run --config ''  # files
expect ' ' run ''
for shell in zsh fish; do
  "$program" documentation --completion "$shell" -o "$folder/$shell"
  ! command -v "$shell" >/dev/null || "$shell" -n "$folder/$shell" || fail "$shell completion"
done

# --- radio materials, by edition and frequency ---
grep -Eq '^concrete +110 to 330 GHz +5.17 +3.16' <<<"$("$program" scene materials --frequency 140e9)" || fail "scene materials"
grep -Eq '^concrete +1 to 100 GHz +5.24 +0.185' <<<"$("$program" scene materials)" || fail "scene materials at 5.9 GHz"
! grep -q vinyl_tile <<<"$("$program" scene materials --edition P.2040-3)" || fail "scene materials --edition"

# --- the reference, and the library of materials ---
"$program" documentation --reference -o "$folder/configuration.md"
cmp -s "$folder/configuration.md" "$source/docs/configuration.md" ||
  fail "docs/configuration.md is stale: cmake --build BUILD --target reference writes it"
"$program" documentation --materials -o "$folder/materials.md"
cmp -s "$folder/materials.md" "$source/docs/materials.md" ||
  fail "docs/materials.md is stale: cmake --build BUILD --target reference writes it"
exit "$failed"
