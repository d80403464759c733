#!/usr/bin/env bash
# Every source is as clang-format-14 would write it.
#   tests/tools/check_format.sh [--fix] [FILE…]      default: all of core/, service/, tests/
# Exit: 0 formatted, 1 not (--fix formats), 77 no clang-format-14 (CTest counts it as skipped).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

if ! command -v clang-format-14 >/dev/null; then
  echo "check_format: no clang-format-14; get it with config/install-dependencies format" >&2
  exit 77
fi
fix=no
[[ ${1:-} != --fix ]] || { fix=yes; shift; }
files=("$@")
((${#files[@]})) || mapfile -t files < <(
  find core service tests -name '*.h' -o -name '*.cpp' | LC_ALL=C sort)
((${#files[@]})) || { echo "check_format: no sources found" >&2; exit 1; }

if [[ $fix == yes ]]; then
  clang-format-14 -i "${files[@]}"
elif ! said=$(clang-format-14 --dry-run -Werror "${files[@]}" 2>&1); then
  grep -E '^[^ ]+:[0-9]+:[0-9]+: error' <<<"$said" | cut -d: -f1,2 | uniq >&2 || echo "$said" >&2
  echo "check_format: these lines are not as clang-format-14 writes them; remedy: $0 --fix" >&2
  exit 1
fi
echo "check_format: ${#files[@]} files as they should be"
