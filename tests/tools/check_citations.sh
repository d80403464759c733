#!/usr/bin/env bash
# What comments and READMEs refer to exists:
# - every citation key, a name and a year or an RFC in square brackets, begins a line of README
#   "Sources";
# - every source that is listed there is cited somewhere;
# - every source file, script and README that is named, alone or by the end of its path, is there, and
#   so is every path that begins with a folder of the root.
#   tests/tools/check_citations.sh [ROOT]       default: the tree this script stands in
set -euo pipefail
export LC_ALL=C
cd "${1:-"$(dirname "${BASH_SOURCE[0]}")/../.."}"

bad=0
offence() {
  echo "$1: $2" >&2
  bad=1
}

folders=()
for folder in config core docker proto service tests; do
  [[ ! -d $folder ]] || folders+=("$folder")
done
if ((${#folders[@]} == 0)) || [[ ! -f README.md ]]; then
  echo "$PWD: no README.md or no sources here: is this the root of the tree?" >&2
  exit 1
fi
mapfile -t files < <(find "${folders[@]}" -type f | sort; find . -maxdepth 1 -type f | cut -c3- | sort)
mapfile -t readers < <(printf '%s\n' "${files[@]}" | grep -E '\.(h|cpp|sh|md)$|(^|/)CMakeLists\.txt$')

# What a path may be: any tail of a file's path, as comments name files from their own folder.
declare -A tails
for file in "${files[@]}"; do
  tail=$file
  while tails[$tail]=1 && [[ $tail == */* ]]; do tail=${tail#*/}; done
done

# One line for each key and each path: KIND FILE:LINE WHAT. Of sources, only comments are read.
rooted="^($(IFS='|'; echo "${folders[*]}"))/"
found=$(rooted=$rooted awk '
  FNR == 1 { sources = 0; prose = FILENAME ~ /\.md$/; slashes = FILENAME ~ /\.(h|cpp)$/ }
  prose && FILENAME == "README.md" && /^## / { sources = /^## Sources/ }
  {
    text = $0
    if (slashes) { if (!(at = index(text, "//"))) next; text = substr(text, at) }
    else if (!prose) { if (!match(text, /(^|[ \t])# /)) next; text = substr(text, RSTART) }
    place = FILENAME ":" FNR
    if (sources && match(text, /^- \[[^]]+\]/)) {
      print "source", place, substr(text, RSTART + 3, RLENGTH - 4)
      text = substr(text, RSTART + RLENGTH)
    }
    rest = text
    while (match(rest, /\[[0-9A-Z][^][(),;:]*[],;]/)) {
      print "key", place, substr(rest, RSTART + 1, RLENGTH - 2)
      rest = substr(rest, RSTART + RLENGTH)
    }
    rest = text
    while (match(rest, /[A-Za-z0-9_.\/*<>{}$-]+/)) {
      word = substr(rest, RSTART, RLENGTH)
      rest = substr(rest, RSTART + RLENGTH)
      sub(/[.-]+$/, "", word)
      sub(/^(\.\/)+/, "", word)
      if (word !~ /[A-Za-z0-9_]\.(h|cpp|sh|md)$/ && word !~ ENVIRON["rooted"]) continue
      if (word !~ /[*<>{}$]/ && word !~ /^[\/.-]/) print "path", place, word
    }
  }' "${readers[@]}")

declare -A listed cited
while read -r place key; do
  [[ ! -v listed[$key] ]] || offence "$place" "[$key] is listed twice"
  listed[$key]=$place
done < <(sed -n 's/^source //p' <<<"$found")
((${#listed[@]})) || offence README.md 'lists no sources'

while read -r place key; do
  if [[ -v listed[$key] ]]; then
    cited[$key]=1
  elif [[ $key =~ ^([A-Z][A-Za-z]+[0-9]{2,4}|RFC\ [0-9]+)$ ]]; then
    offence "$place" "[$key] is not in README \"Sources\""
  fi
done < <(sed -n 's/^key //p' <<<"$found")
for key in "${!listed[@]}"; do
  [[ -v cited[$key] ]] || offence "${listed[$key]}" "[$key] is cited nowhere"
done

count=0
while read -r place path; do
  [[ ! $path =~ ^[A-Z]+\.(h|cpp|sh)$ ]] || continue # a placeholder
  count=$((count + 1))
  [[ -v tails[$path] || -e $path ]] || offence "$place" "$path does not exist"
done < <(sed -n 's/^path //p' <<<"$found")

((bad)) || echo "check_citations: ${#listed[@]} sources and $count names of files, all there"
exit "$bad"
