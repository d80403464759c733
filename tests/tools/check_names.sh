#!/usr/bin/env bash
# Where several test sources are one compilation, no function of an unnamed namespace has the name of
# one in another of these sources, or of one that a header of the project declares: overload resolution
# would take it for the other without a word, and a test would test something else.
#   tests/tools/check_names.sh BUILD         BUILD: of a build with CMAKE_UNITY_BUILD
#   tests/tools/check_names.sh BUILD ROOT    default: the tree this script stands in
set -euo pipefail
export LC_ALL=C
build=$(realpath "$1")
cd "${2:-"$(dirname "${BASH_SOURCE[0]}")/../.."}"

mapfile -t batches < <(find "$build" -path '*/tests/*/Unity/unity_*.cxx' | sort)
if ((${#batches[@]} == 0)); then
  echo "$build: no test sources that are compiled together; make it by cmake --preset dev" >&2
  exit 1
fi

# One line for each function: BATCH NAME FILE. Names before a bracket, at the start of a line.
functions='
  function name() {
    text = $0
    sub(/\(.*/, "", text)
    if (text !~ /^[A-Za-z].*[ &*]/ || text ~ /=/) return ""
    sub(/.*[^A-Za-z0-9_]/, "", text)
    return text ~ /[a-z]/ ? text : ""
  }'
declared=$(find core service tests -name '*.h' -print0 | xargs -0 awk "$functions"'
  /^[A-Za-z].*\(/ { found = name(); if (found != "") print found }' | sort -u)
defined=$(for batch in "${batches[@]}"; do
  sed -n 's/^#include "\(.*\)"$/\1/p' "$batch" | grep '^/' | xargs -r awk -v batch="$batch" "$functions"'
    FNR == 1 { unnamed = 0 }
    /^namespace \{/ { unnamed = 1 }
    /^}  \/\/ namespace$/ { unnamed = 0 }
    unnamed && /^[A-Za-z].*\(/ { found = name(); if (found != "") print batch, found, FILENAME }'
done | sort -u)

bad=0
offence() {
  echo "$1" >&2
  bad=1
}
while read -r _ name file; do
  offence "$file: $name is a function of a header, too; give this one another name"
done < <(awk 'NR == FNR { declared[$1] = 1; next } $2 in declared' <(echo "$declared") <(echo "$defined"))
while read -r name files; do
  offence "$name is a function in each of$files; give all but one another name"
done < <(awk '
  { key = $1 " " $2; files[key] = files[key] " " $3; count[key]++ }
  END { for (key in count) if (count[key] > 1) { split(key, part, " "); print part[2], files[key] } }' \
  <(echo "$defined"))

((bad)) || echo "check_names: $(wc -l <<<"$defined") functions, each with a name of its own"
exit "$bad"
