#!/usr/bin/env bash
# check_names.sh must see what it is there to see: each case adds lines to one file of a small sound
# tree, two of whose sources are one compilation, and expects the very offence, or none.
set -euo pipefail
check="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/check_names.sh"
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

expect() { # STATUS TEXT FILE LINES: what check_names.sh does when FILE ends with LINES
  local output status=0 name
  rm -rf "${tree:?}"/*
  mkdir -p "$tree"/{core,service,tests} "$tree/build/tests/a.dir/Unity"
  echo 'inline Dem MakeDem(int columns, int rows) {' >"$tree/tests/terrains.h"
  echo 'Status Build(const Dem& dem);' >"$tree/core/build.h"
  for name in a b; do
    printf '%s\n' 'namespace {' "int Only_$name(int x) {" '  return Twice(x);' '}' >"$tree/tests/$name.cpp"
  done
  printf '#include "%s"\n' "$tree/tests/a.cpp" "$tree/tests/b.cpp" >"$tree/build/tests/a.dir/Unity/unity_0_cxx.cxx"
  printf '%s\n' "$4" >>"$tree/$3"
  output=$("$check" "$tree/build" "$tree" 2>&1) || status=$?
  if [[ $status -ne $1 || $output != *"$2"* ]]; then
    echo "FAILED: $3 with '$4': expected status $1 and '$2', got $status and: $output"
    failures=$((failures + 1))
  fi
}

expect 0 'each with a name of its own' tests/b.cpp 'int Twice(int x) {'
expect 0 'each with a name of its own' tests/b.cpp $'}  // namespace\nint Only_a(int x) {'
expect 0 'each with a name of its own' tests/b.cpp '  return Only_a(MakeDem(3, 4));'
expect 0 'each with a name of its own' tests/b.cpp 'const auto kDem = MakeDem(3, 4);'
expect 1 'Only_a is a function in each of' tests/b.cpp 'std::vector<int> Only_a(double x) {'
expect 1 'MakeDem is a function of a header' tests/b.cpp 'Dem MakeDem(int columns, int rows, int height) {'
expect 1 'MakeDem is a function of a header' tests/b.cpp $'template <typename Height>\nDem MakeDem(Height height) {'
expect 1 'Build is a function of a header' tests/a.cpp 'const Dem& Build('

# A build of each source by itself.
rm -r "$tree/build"
mkdir "$tree/build"
if "$check" "$tree/build" "$tree" >/dev/null 2>"$tree/said" || ! grep -q 'compiled together' "$tree/said"; then
  echo 'FAILED: a build without such compilations went unnoticed'
  failures=$((failures + 1))
fi

((failures == 0)) && echo 'check_names_test: every offence was seen'
