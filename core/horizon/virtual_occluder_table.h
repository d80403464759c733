#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/segment.h"

namespace farhorizon {

/// The virtual occluders of each of a number of edges, in one block of memory.
class VirtualOccluderTable {
 public:
  void Reserve(std::size_t edges, std::size_t segments) {
    ends_.reserve(edges);
    segments_.reserve(segments);
  }
  /// Appends the list of the next edge.
  void Append(std::span<const Segment> list) {
    segments_.insert(segments_.end(), list.begin(), list.end());
    ends_.push_back(segments_.size());
  }

  /// The list of edge i. Requires: i + 1 lists have been appended.
  [[nodiscard]] std::span<const Segment> Of(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
    return std::span(segments_).subspan(begin, ends_[i] - begin);
  }

 private:
  std::vector<Segment> segments_;
  std::vector<std::size_t> ends_;  ///< of each list
};

}  // namespace farhorizon
