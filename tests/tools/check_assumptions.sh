#!/usr/bin/env bash
# proto/assumptions.md has a row for every code of an assumption that core/ makes, and no other:
# - a code is the first text of `Assumption{"code", …}`, of `return {"code", …}`, of what is pushed into
#   `assumptions`, or of a call of Assume…("code", …);
# - a row is `| `code` | what was decided | how to state it |`, each code once, in alphabetical order.
#   tests/tools/check_assumptions.sh [ROOT]       default: the tree this script stands in
set -euo pipefail
export LC_ALL=C
cd "${1:-"$(dirname "${BASH_SOURCE[0]}")/../.."}"

table=proto/assumptions.md
if [[ ! -d core || ! -f $table ]]; then
  echo "$PWD: no core/ or no $table here: is this the root of the tree?" >&2
  exit 1
fi
bad=0
offence() {
  echo "$1: $2" >&2
  bad=1
}

# One line for each code: FILE CODE. Calls may go over several lines, so each file becomes one line;
# comments are left out.
making='((Assumption|return) ?[{]|Assume[A-Za-z]* ?[(]|[Aa]ssumptions_?([.]|->)(push_back|emplace_back)[(](Assumption)? ?[{]?) ?"[^"]*"'
declare -A made=()
while read -r file code; do
  made[$code]=$file
done < <(
  find core \( -name '*.h' -o -name '*.cpp' \) -print0 | sort -z | making=$making xargs -0 awk '
    function codes() {
      gsub(/[ \t]+/, " ", text)
      while (match(text, ENVIRON["making"])) {
        call = substr(text, RSTART, RLENGTH)
        text = substr(text, RSTART + RLENGTH)
        sub(/^[^"]*"/, "", call)
        print name, substr(call, 1, length(call) - 1)
      }
    }
    FNR == 1 { codes(); name = FILENAME; text = "" }
    { sub(/(^|[ \t])\/\/.*/, ""); text = text " " $0 }
    END { codes() }'
)
for code in "${!made[@]}"; do
  [[ $code =~ ^[a-z][a-z0-9-]*$ ]] || offence "${made[$code]}" "\"$code\" is no code: small letters, digits and -"
done

declare -A listed=()
last=
while IFS=: read -r line row; do
  if [[ ! $row =~ ^\|\ \`([a-z0-9-]+)\`\ \|\ [^|]{5,}\ \|\ [^|]{5,}\ \|$ ]]; then
    offence "$table:$line" 'an ill-formed row'
    continue
  fi
  code=${BASH_REMATCH[1]}
  [[ ! -v listed[$code] ]] || offence "$table:$line" "$code stands twice"
  [[ -v listed[$code] || $code > $last ]] || offence "$table:$line" "$code is not in alphabetical order"
  [[ -v made[$code] ]] || offence "$table:$line" "nothing in core/ makes the assumption $code"
  listed[$code]=$line
  last=$code
done < <(grep -nE '^\|' "$table" | grep -vE ':\|(-+\|)+$|:\| code \|')
for code in "${!made[@]}"; do
  [[ -v listed[$code] ]] || offence "${made[$code]}" "the assumption $code has no row in $table"
done

((bad)) || echo "check_assumptions: ${#listed[@]} assumptions, each with its row"
exit "$bad"
