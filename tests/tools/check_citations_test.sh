#!/usr/bin/env bash
# check_citations.sh must see what it is there to see: each case adds one line to one file of a small
# sound tree and expects the very offence, or none.
set -euo pipefail
check="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/check_citations.sh"
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

expect() { # STATUS TEXT FILE LINE: what check_citations.sh does when FILE ends with LINE
  local output status=0
  rm -rf "${tree:?}"/*
  mkdir -p "$tree/core/horizon/kinetic" "$tree/service" "$tree/tests"
  printf '%s\n' '# tree' 'After [Euler36].' '## Sources' '- [Euler36] L. Euler.' >"$tree/README.md"
  echo '// After [Euler36, section 2].' >"$tree/core/horizon/kinetic/scene.h"
  echo '# After core/horizon/kinetic.' >"$tree/tests/run.sh"
  echo "$4" >>"$tree/$3"
  output=$("$check" "$tree" 2>&1) || status=$?
  if [[ $status -ne $1 || $output != *"$2"* ]]; then
    echo "FAILED: $3 with '$4': expected status $1 and '$2', got $status and: $output"
    failures=$((failures + 1))
  fi
}

sound='all there'
code=core/horizon/kinetic/scene.h
# References that resolve, and what only looks like one.
expect 0 "$sound" $code '/// As [Euler36] says, see scene.h, kinetic/scene.h and core/horizon/kinetic/scene.h.'
expect 0 "$sound" $code 'const int x = names[Gauss27];  // at [0, 1], [A, B] and [MINUTES]'
expect 0 "$sound" $code 'Read("gone.h");'
expect 0 "$sound" $code '// tests/*.cpp, FILE.cpp and {core,service}/gone.h stand for others; so does build/gone.txt'
expect 0 "$sound" README.md $'- [Gauss27] C. F. Gauss, after [Euler36].\n## More\nAfter [Gauss27].'
# Keys.
expect 1 'core/horizon/kinetic/scene.h:2: [Gauss27] is not in README' $code '// [Gauss27]'
expect 1 'scene.h:2: [Gauss27] is not in README' $code 'int x = 0;  ///< as in [Gauss27, theorem 3]'
expect 1 'tests/run.sh:2: [Gauss27] is not in README' tests/run.sh $'\t# as in [Gauss27]'
expect 1 '[RFC 9457] is not in README' $code '// [RFC 9457]'
expect 1 'core/horizon/notes.md:1: [Gauss27] is not in README' core/horizon/notes.md '[Gauss27]'
expect 1 'README.md:5: [Gauss27] is not in README' README.md '  after [Gauss27].'
expect 1 'README.md:5: [Gauss27] is cited nowhere' README.md '- [Gauss27] C. F. Gauss.'
expect 1 '[3D Tiles] is cited nowhere' README.md '- [3D Tiles] A specification.'
expect 1 'README.md:5: [Euler36] is listed twice' README.md '- [Euler36] L. Euler.'
# Files.
expect 1 'scene.h:2: horizon.md does not exist' $code '// Proofs: horizon.md, section 7.'
expect 1 'scene.h:2: sweep.cpp does not exist' $code 'int x = 0;  // below 2^36 (sweep.cpp)'
expect 1 'sweep/scene.h does not exist' $code '// see sweep/scene.h'
expect 1 'core/horizon/README.md does not exist' $code '// core/horizon/README.md, theorem 3.'
expect 1 'service/viewer does not exist' $code '// As in service/viewer.'
expect 1 'gone.sh does not exist' tests/run.sh '# Calls gone.sh.'
expect 1 'core/gone.h does not exist' core/horizon/notes.md 'See core/gone.h.'

# A folder that is no tree.
if "$check" "$tree/core" >/dev/null 2>"$tree/said" || ! grep -q 'is this the root' "$tree/said"; then
  echo 'FAILED: a folder without sources went unnoticed'
  failures=$((failures + 1))
fi

((failures == 0)) && echo 'check_citations_test: every offence was seen'
