#include "service/overall_progress.h"

#include <algorithm>
#include <array>

namespace farhorizon {

namespace {

/// Where each stage stands in the whole; about what they take on a tile of 400 x 300 posts.
struct StageShare {
  std::string_view stage;
  double from;
  double to;
};
constexpr std::array kShares = {
    StageShare{"read", 0, 2},       StageShare{"sweep", 2, 10},   StageShare{"decide", 10, 30},
    StageShare{"simplify", 30, 70}, StageShare{"encode", 70, 97}, StageShare{"measure", 70, 97},
    StageShare{"write", 97, 99},
};

}  // namespace

int OverallPercent(std::string_view stage, double done) {
  for (const StageShare& share : kShares) {
    if (share.stage != stage) continue;
    return static_cast<int>(share.from + (share.to - share.from) * std::clamp(done, 0.0, 1.0));
  }
  return 0;
}

}  // namespace farhorizon
