#!/usr/bin/env bash
# No line of a source, comments included, is longer than 100 columns: clang-format leaves comments as
# they are.
#   tests/tools/check_columns.sh [ROOT]       default: the tree this script stands in
set -euo pipefail
export LC_ALL=C
cd "${1:-"$(dirname "${BASH_SOURCE[0]}")/../.."}"

mapfile -t files < <(find core service tests -name '*.h' -o -name '*.cpp' | sort)
((${#files[@]})) || { echo "check_columns: no sources found" >&2; exit 1; }
# A column is a character: the bytes that go on with one in UTF-8 do not count.
if ! awk -v most=100 '
  {
    line = $0
    gsub(/[\200-\277]/, "", line)
    if (length(line) <= most) next
    printf "%s:%d: %d columns: %s\n", FILENAME, FNR, length(line), $0
    ++long
  }
  END {
    if (long) print "check_columns: " long " lines are longer than " most " columns"
    exit long > 0
  }' "${files[@]}" >&2; then
  exit 1
fi
echo "check_columns: ${#files[@]} files within 100 columns"
