#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_deps.sh
cmake --preset release -DTRIVALENT_BUILD_BENCHMARKS=ON
cmake --build --preset release
ctest --preset release -j "$(nproc)"
