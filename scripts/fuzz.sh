#!/usr/bin/env bash
# Builds the fuzz targets and runs each for some time; fails if one of them finds anything.
# usage: scripts/fuzz.sh [SECONDS [TARGET...]]   default: 60 seconds each of all targets
# Corpora grow in results/fuzz/corpus; what crashes lies in results/fuzz/findings.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-60}
shift || true
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] || targets=(off obj ply stl vtk vtp vtu xyz atoms options repair)

scripts/install_deps.sh
cmake --preset release >/dev/null
cmake --build --preset release --target trivalent
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target "${targets[@]/#/fuzz_}"
results=results/fuzz
mkdir -p "$results/findings" "$results/logs"
tests/fuzz/make_corpus.py build/release/bin/trivalent "$results/seeds"

failed=0
for target in "${targets[@]}"; do
  mkdir -p "$results/corpus/$target"
  log=$results/logs/$target
  # Without LeakSanitizer's look after every run, which needs ptrace; leaks show at the end.
  if build/fuzz/bin/fuzz_"$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 \
    -max_len=20000 -print_final_stats=1 -artifact_prefix="$results/findings/$target-" \
    "$results/corpus/$target" "$results/seeds/$target" >"$log" 2>&1; then
    runs=$(awk '/number_of_executed_units/ {print $2}' "$log")
    echo "$target: nothing found in $seconds s, $runs runs, $(ls "$results/corpus/$target" | wc -l) inputs kept"
  else
    echo "$target: FOUND something, see $log"
    failed=1
  fi
done
exit $failed
