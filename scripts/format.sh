#!/usr/bin/env bash
# Formats all C++ sources; with --check only says which are not formatted, and fails if there are any.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mode=(-i)
[[ ${1:-} == --check ]] && mode=(--dry-run --Werror)
git ls-files '*.cpp' '*.h' | xargs clang-format-14 "${mode[@]}"
