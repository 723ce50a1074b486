#!/usr/bin/env bash
# Time of whole commands, process start to exit: `draw` of 3-1, `check` of four-bars from files, and
# `draw` of two crowded sheets. Beside the time on the clock stands the processor time, user and system, which other
# jobs on the machine disturb less. Needs python3. Usage: benches/commands.sh [RUNS] [SCENES]
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --quiet --release --no-default-features --features cli
program=$(realpath "${CARGO_TARGET_DIR:-target}/release/linkgram")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 benches/commands.py "$program" "$work" "${1:-101}" "${2:-10000}"
