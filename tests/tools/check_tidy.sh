#!/usr/bin/env bash
# clang-tidy-19 with the rules of .clang-tidy.
#   tests/tools/check_tidy.sh [FILE.cpp…]    default: what differs from origin/main, committed or not
#   tests/tools/check_tidy.sh --all
# The compile commands are those of the dev preset, but for precompiled headers: g++'s are none for
# clang. They stand in build/tidy.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

command -v clang-tidy-19 >/dev/null || {
  echo "check_tidy: no clang-tidy-19; get it with config/install-dependencies lint" >&2
  exit 1
}
build=build/tidy
cmake --preset dev -B "$build" -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >/dev/null

files=("$@")
if [[ ${1:-} == --all ]]; then
  mapfile -t files < <(find core service tests -name '*.cpp' | LC_ALL=C sort)
elif ((!$#)); then
  base=$(git merge-base HEAD origin/main 2>/dev/null) || base=HEAD
  mapfile -t files < <({
    git diff --name-only --diff-filter=d "$base" -- '*.cpp'
    git ls-files --others --exclude-standard -- '*.cpp'
  } | LC_ALL=C sort -u)
fi
# clang-tidy guesses the flags of a file that nothing builds, and then complains about the guess.
known=()
for file in "${files[@]}"; do
  if grep -qF "$PWD/${file#"$PWD/"}\"" "$build/compile_commands.json"; then
    known+=("$file")
  else
    echo "check_tidy: $file is in no target of $build: not checked" >&2
  fi
done
((${#known[@]})) || { echo "check_tidy: nothing to check"; exit 0; }

# Boost 1.74's Asio does not see coroutines under clang unless it is told. GCC-only warnings flags
# and the sanitizers' are no business of clang's front end.
printf '%s\0' "${known[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy-19 --quiet -p "$build" \
  --extra-arg=-Wno-unknown-warning-option --extra-arg=-DBOOST_ASIO_HAS_CO_AWAIT=1 \
  --extra-arg=-DBOOST_ASIO_HAS_STD_COROUTINE=1
echo "check_tidy: ${#known[@]} files clean"
