#!/usr/bin/env bash
# check_assumptions.sh must see what it is there to see: each case adds lines to one file of a small
# sound tree and expects the very offence, or none.
set -euo pipefail
check="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/check_assumptions.sh"
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

expect() { # STATUS TEXT FILE LINES: what check_assumptions.sh does when FILE ends with LINES
  local output status=0
  rm -rf "${tree:?}"/*
  mkdir -p "$tree/core/io" "$tree/proto"
  printf '%s\n' '# Assumptions' '' '| code | decided | stated |' '|---|---|---|' \
    '| `height-unit` | taken for metres | `--height-unit` |' >"$tree/proto/assumptions.md"
  echo 'return Assumption{"height-unit", "metres"};' >"$tree/core/io/value_scale.cpp"
  printf '%s\n' "$4" >>"$tree/$3"
  output=$("$check" "$tree" 2>&1) || status=$?
  if [[ $status -ne $1 || $output != *"$2"* ]]; then
    echo "FAILED: $3 with '$4': expected status $1 and '$2', got $status and: $output"
    failures=$((failures + 1))
  fi
}

code=core/io/value_scale.cpp
table=proto/assumptions.md
row='| `void-fill` | left out | `--nodata` |'
expect 0 '1 assumptions, each with its row' $code '// as Assumption{"elsewhere", "x"} has it'
expect 0 'each with its row' $code 'Print("void-fill"); Error{ErrorCode::kIo, "void-fill"};'
expect 1 'value_scale.cpp: the assumption void-fill has no row' $code 'Assumption{"void-fill", "x"};'
expect 1 'the assumption void-fill has no row' $code $'dem.assumptions.push_back(\n    {"void-fill", "x"});'
expect 1 'the assumption void-fill has no row' $code 'way->assumptions.push_back(Assumption{"void-fill", "x"});'
expect 1 'the assumption void-fill has no row' $code 'assumptions_.push_back({"void-fill", "x"});'
expect 1 'the assumption void-fill has no row' $code $'AssumeFill(\n  "void-fill", "x");'
expect 1 'the assumption void-fill has no row' $code $'return {\n    "void-fill", Text()};'
expect 1 '"Void fill" is no code' $code 'Assumption{"Void fill", "x"};'
expect 1 'assumptions.md:6: nothing in core/ makes the assumption void-fill' $table "$row"
expect 1 'assumptions.md:6: height-unit stands twice' $table '| `height-unit` | once more | `--height-unit` |'
expect 1 'assumptions.md:6: an ill-formed row' $table '| void-fill | left out | `--nodata` |'
expect 1 'assumptions.md:6: an ill-formed row' $table '| `void-fill` | left out |'
expect 1 'alphabetical order' $table $'| `void` | left out | `--nodata` |\n| `alpha` | left out | `--nodata` |'

# A folder that is no tree.
if "$check" "$tree/core" >/dev/null 2>"$tree/said" || ! grep -q 'is this the root' "$tree/said"; then
  echo 'FAILED: a folder without sources went unnoticed'
  failures=$((failures + 1))
fi

((failures == 0)) && echo 'check_assumptions_test: every offence was seen'
