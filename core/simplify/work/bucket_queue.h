#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace farhorizon {

/// Vertices by what they cost, in buckets of costs within a factor of 1.5 or so. Within a bucket
/// the order is that of the vertices' numbers, so that neighbours in memory follow each other.
class BucketQueue {
 public:
  /// Bucket 0 is for what costs next to nothing, or goes first for another reason.
  static std::int32_t BucketOf(float cost) {
    // The upper ten bits of a positive float are its exponent and half an octave: no logarithm,
    // which libraries round differently.
    constexpr float kNothing = 1e-12F;  // square metres
    if (!(cost > kNothing)) return 0;
    return 1 + static_cast<std::int32_t>((std::bit_cast<std::uint32_t>(cost) >> 22U) -
                                         (std::bit_cast<std::uint32_t>(kNothing) >> 22U));
  }

  void Add(std::int32_t vertex, std::int32_t bucket) {
    if (bucket >= static_cast<std::int32_t>(buckets_.size())) {
      buckets_.resize(static_cast<std::size_t>(bucket) + 1);
    }
    lowest_ = std::min(lowest_, bucket);
    buckets_[static_cast<std::size_t>(bucket)].push_back(vertex);
  }
  /// The lowest bucket that is not empty; -1: all are.
  std::int32_t Lowest() {
    const auto size = static_cast<std::int32_t>(buckets_.size());
    while (lowest_ < size && buckets_[static_cast<std::size_t>(lowest_)].empty()) ++lowest_;
    return lowest_ < size ? lowest_ : -1;
  }
  /// Empties the bucket into `vertices`, in rising order.
  void Take(std::int32_t bucket, std::vector<std::int32_t>& vertices) {
    vertices.clear();
    std::swap(vertices, buckets_[static_cast<std::size_t>(bucket)]);
    std::sort(vertices.begin(), vertices.end());
  }
  void Clear() {
    buckets_.clear();
    lowest_ = 0;
  }

 private:
  std::vector<std::vector<std::int32_t>> buckets_;
  std::int32_t lowest_ = 0;
};

}  // namespace farhorizon
