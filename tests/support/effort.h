#pragma once

namespace farhorizon {

/// How many rounds of a random test to run: all in an ordinary build, a tenth under the sanitizers,
/// where each takes some ten times as long.
constexpr int Rounds(int rounds) {
#ifdef __SANITIZE_ADDRESS__
  return rounds < 10 ? 1 : rounds / 10;
#else
  return rounds;
#endif
}

/// How many posts the side of a large grid has: all in an ordinary build, a third under the
/// sanitizers, which leaves a ninth of the grid.
constexpr int GridSide(int posts) {
#ifdef __SANITIZE_ADDRESS__
  return posts / 3;
#else
  return posts;
#endif
}

}  // namespace farhorizon
