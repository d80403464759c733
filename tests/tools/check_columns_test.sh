#!/usr/bin/env bash
# check_columns.sh must see lines that are too long, and no others.
set -euo pipefail
check="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/check_columns.sh"
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

expect() { # STATUS TEXT FILE LINE: what check_columns.sh does when FILE ends with LINE
  local output status=0
  rm -rf "${tree:?}"/*
  mkdir -p "$tree/core/base" "$tree/service" "$tree/tests"
  echo '#pragma once' >"$tree/core/base/result.h"
  echo "$4" >>"$tree/$3"
  output=$("$check" "$tree" 2>&1) || status=$?
  if [[ $status -ne $1 || $output != *"$2"* ]]; then
    echo "FAILED: $3 with '$4': expected status $1 and '$2', got $status and: $output"
    failures=$((failures + 1))
  fi
}

x97=$(printf 'x%.0s' {1..97})
expect 0 'within 100 columns' core/base/result.h "// $x97"
expect 0 'within 100 columns' core/base/result.h "// ${x97:1}…"
expect 0 'within 100 columns' tests/long.sh "# $x97$x97"
expect 1 "core/base/result.h:2: 101 columns: // ${x97}y" core/base/result.h "// ${x97}y"
expect 1 'core/base/result.h:2: 101 columns' core/base/result.h "// ${x97}…"
expect 1 '1 lines are longer' service/main.cpp "int ${x97}y;"
expect 1 'tests/a.cpp:1:' tests/a.cpp "///< ${x97}"

((failures == 0)) && echo 'check_columns_test: every long line was seen'
