#!/usr/bin/env bash
# Runs clang-tidy 14 with the limits in .clang-tidy on all C++ sources, or on what changed since a revision:
#
#     scripts/lint.sh [REVISION]
#
# A changed header is checked through the sources that include it. Nothing is compiled: the build tree build/lint only
# tells how each source would be. Limits that a function may exceed stand in scripts/lint_exceptions.txt, with reasons.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# All of it: files are read in the batches in which they are built, so that headers are matched once for many. The
# analyzer looks only at files that are given to it, one by one, and so at changes.
everything=$([[ $# -gt 0 ]] && echo OFF || echo ON)
cmake --preset release -B build/lint -DTRIVALENT_BUILD_TESTS=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
  -DCMAKE_UNITY_BUILD="$everything" >/dev/null

checks=
if [[ $everything == ON ]]; then
  checks=-bugprone-suspicious-include,-clang-analyzer-*
  sources=$(grep -o '"file": "[^"]*"' build/lint/compile_commands.json | cut -d'"' -f4 | grep -v 'viewer_page')
else
  sources=$(git ls-files 'libremesh/*.cpp' 'libdual/*.cpp' 'potentials/*.cpp' 'apps/*.cpp')
  changed=$(git diff --name-only --diff-filter=d "$1" -- '*.cpp' '*.h')
  chosen=$(comm -12 <(sort <<<"$sources") <(sort <<<"$changed"))
  for header in $(grep '\.h$' <<<"$changed" || true); do
    # As it is included: "trivalent/dual/structure.h" or "mesh/mesh.h" or "session.h".
    name=$(sed -E 's#.*/(include|src|trivalent)/##; s#^apps/##' <<<"$header")
    chosen+=$'\n'$(xargs grep -lF "$name\"" <<<"$sources" || true)
  done
  sources=$(sort -u <<<"$chosen" | sed '/^$/d')
fi
[[ -n $sources ]] || exit 0
touch build/lint/apps/commit.cpp  # is made by a build

# OpenMesh means its smart handles to be passed as plain ones.
# Compiler warnings are gcc's business: clang 14 warns of other things, and cannot read some of libstdc++ 12.
run_one() {
  clang-tidy-14 --quiet -p build/lint --checks="$2" --extra-arg=-Wno-everything --extra-arg=-ferror-limit=0 "$1" \
    2>/dev/null
}
export -f run_one
findings=$(xargs -P "$(nproc)" -I{} bash -c 'run_one {} "$0" || true' "$checks" <<<"$sources" |
  grep -E '(warning|error):' | grep -v 'clang-diagnostic-error' |
  grep -v "slicing object from type 'Smart[A-Za-z]*Handle'" | sed "s#$PWD/##" | sort -u || true)

# Files of more than 400 lines.
max_lines=400
for file in $(git ls-files '*.cpp' '*.h' '*.js'); do
  lines=$(wc -l <"$file")
  ((lines <= max_lines)) || findings+=$'\n'"$file: warning: $lines lines, at most $max_lines are allowed [file-size]"
done

# Each line of the list is "FILE FUNCTION CHECK: reason".
unexplained=$(awk '
  FNR == NR { if ($0 !~ /^#/ && NF > 3) { sub(/:$/, "", $3); known[$1 " " $2 " " $3] = 1 }; next }
  {
    split($0, place, ":"); file = place[1]
    match($0, /\[[a-z0-9.,-]+\]$/); check = substr($0, RSTART + 1, RLENGTH - 2); sub(/,.*/, "", check)
    name = "-"; if (match($0, /function \x27[^\x27]+\x27/)) name = substr($0, RSTART + 10, RLENGTH - 11)
    if (!((file " " name " " check) in known)) print
  }' scripts/lint_exceptions.txt - <<<"$findings" | sed '/^$/d')
[[ -z $unexplained ]] && exit 0
echo "$unexplained"
exit 1
