// Peaks of resident memory (VmHWM, MiB) of `build` on defaults with two threads:
//
//   posts               65²  129²  257²  513²  1000²  1201²  1400²  2000²  3600²
//   flat                 63    66    73    97    220                  666
//   fractal mountains    68    74    87   127    251           369    680
//   one degree of 3"                                    281
//   one degree of 1"                                                          2450
//   noise of 0 to 2      70    80   105   227    722          1174
//
// Beside 64 MiB that any build takes, of which 42 are pages of the program, its libraries and the
// database of reference systems, that is 250 bytes a post of mountains at 513², 155 to 190 from
// 1000² on, 130 to 160 of a plain, and 560 to 660 of noise, where every post is on the skyline of
// its neighbours and each edge of it is kept. A thread adds 8 to 10 MiB, its stack and its heap.
// Levels and formats change less than two MiB of 127 (12 levels instead of 5: 128), for they are
// made one after the other of what is there already. White noise, at the end of its work budget,
// took 205 MiB at 129².
//
// Processor time: 36 microseconds a post from 1201² to 3600², 44 to 60 below, 160 of noise. What
// stays undecided is decided up to three times by `approximate`. The horizon is found twice with
// --horizon-context, which is at most as much again.
#include "core/pipeline/build_cost.h"

#include <algorithm>

namespace farhorizon {

namespace {

constexpr std::int64_t kMebibyte = std::int64_t{1} << 20U;
constexpr std::int64_t kBytesOfAny = 72 * kMebibyte;
constexpr std::int64_t kBytesOfThread = 10 * kMebibyte;
constexpr std::int64_t kBytesOfPost = 280;
// Of each post beyond the first million: so that a DEM which fits is not refused.
constexpr std::int64_t kManyPosts = 1'000'000;
constexpr std::int64_t kBytesOfFurtherPost = 200;
constexpr double kSecondsOfAny = 0.5;
constexpr double kSecondsOfPost = 40e-6;
constexpr double kShareOfApproximate = 3;
constexpr double kShareOfContext = 2;

std::int64_t BytesBesidePosts(const BuildOptions& options) {
  return kBytesOfAny + kBytesOfThread * options.threads;
}

}  // namespace

BuildCost EstimateBuild(std::int64_t posts, const BuildOptions& options) {
  const double seconds = (kSecondsOfAny + kSecondsOfPost * static_cast<double>(posts)) *
                         (options.approximate ? kShareOfApproximate : 1) *
                         (options.horizon_context ? kShareOfContext : 1);
  const std::int64_t further = std::max<std::int64_t>(0, posts - kManyPosts);
  return {
      BytesBesidePosts(options) + kBytesOfPost * (posts - further) + kBytesOfFurtherPost * further,
      seconds};
}

std::int64_t PostsWithin(std::int64_t memory_bytes, const BuildOptions& options) {
  const std::int64_t bytes = std::max<std::int64_t>(0, memory_bytes - BytesBesidePosts(options));
  const std::int64_t further = bytes - kBytesOfPost * kManyPosts;
  return further < 0 ? bytes / kBytesOfPost : kManyPosts + further / kBytesOfFurtherPost;
}

}  // namespace farhorizon
