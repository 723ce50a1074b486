#!/usr/bin/env bash
# The four-bar of the comparison with other programs: positions, velocities and accelerations of A and B over a turn.
# Runs linkgram and those other programs that are installed for the given Python, each scored against mpmath
# (50 digits) where that is installed: pip install mpmath numpy "pylinkage[numba]==1.3.0"
# Usage: benches/peers.sh [PYTHON] [POSITIONS]
set -euo pipefail
cd "$(dirname "$0")/.."
python=${1:-python3}
positions=${2:-3600}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cargo bench --quiet --no-default-features --bench ratios -- --engine "$positions" "$work/rows" >"$work/time"
"$python" benches/peers.py "$positions" "$work"
