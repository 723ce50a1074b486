#!/usr/bin/env bash
# Cost follows the question: instructions of whole runs (process start to exit) under callgrind, by what is
# asked of one scene; peak memory of a run without valgrind beside them. Needs valgrind, GNU time (apt-get
# install valgrind time) and python3. Usage: benches/instructions.sh [SCENE]
set -euo pipefail
cd "$(dirname "$0")/.."
scene=${1:-examples/s000-ch3a-1.json}
cargo build --quiet --release --no-default-features --features cli
program=${CARGO_TARGET_DIR:-target}/release/linkgram
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The scene with another question; nothing published.
asking() {
  python3 - "$scene" "$2" >"$work/$1.json" <<'PY'
import json, sys
scene = json.load(open(sys.argv[1]))
for key in ("published", "errata", "expect"):
    scene.pop(key, None)
scene["find"] = json.loads(sys.argv[2])
print(json.dumps(scene))
PY
}
asking one '["v(B)"]'
asking velocities '["v(A)", "v(B)", "v(C)", "v(D)", "omega(3)", "omega(4)", "omega(5)"]'
asking accelerations '["v(A)", "v(B)", "v(C)", "v(D)", "omega(3)", "omega(4)", "omega(5)", "a(A)", "a(B)", "a(C)", "a(D)", "alpha(3)", "alpha(4)", "alpha(5)"]'

printf '| %-34s | %14s | %9s |\n' "run" "instructions" "peak kB"
printf '|%s|%s|%s|\n' "$(printf -- '-%.0s' {1..36})" "$(printf -- '-%.0s' {1..16})" "$(printf -- '-%.0s' {1..11})"
measure() {
  local name=$1
  shift
  valgrind --tool=callgrind --callgrind-out-file="$work/out" "$program" "$@" >/dev/null 2>"$work/log"
  local count peak
  count=$(sed -n 's/.*Collected : \([0-9]*\).*/\1/p' "$work/log")
  # A process counts as its own what the one was that it was forked from, so that must be a small one.
  peak=$(/usr/bin/time -f %M "$program" "$@" 2>&1 >/dev/null | tail -n 1)
  printf '| %-34s | %14s | %9s |\n' "$name" "$count" "$peak"
}
measure "start-up only (--version)" --version
measure "one velocity" solve "$work/one.json"
measure "all velocities" solve "$work/velocities.json"
measure "velocities and accelerations" solve "$work/accelerations.json"
measure "the same with the sheet" draw "$work/accelerations.json" -o "$work/sheet.svg"
