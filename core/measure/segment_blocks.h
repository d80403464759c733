#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/measure/line_box.h"
#include "core/measure/skyline_net.h"

namespace farhorizon {

/// The segments of a net by square blocks of the plan, to find those that lines of a box meet.
class SegmentBlocks {
 public:
  SegmentBlocks() = default;
  /// Requires: net outlives it. Cost: O(n log n), n the blocks that the segments reach.
  explicit SegmentBlocks(const SkylineNet& net);

  /// Calls visit(segment), once each, for the segments with an end above `above_m` that lie in
  /// blocks which lines of the box meet, until it returns true; whether it did.
  /// Requires: the box's range of directions is below an eighth of a turn.
  /// Cost: the blocks along the lines, and what is visited.
  bool Visit(const LineBox& box, double above_m,
             const std::function<bool(std::int32_t segment)>& visit);

 private:
  struct Entry {
    std::int32_t block;
    std::int32_t segment;
    double height_m;  // of the higher end
  };

  bool VisitBlock(std::int32_t column, std::int32_t row, double above_m,
                  const std::function<bool(std::int32_t segment)>& visit);
  [[nodiscard]] std::int32_t ColumnOf(double column) const;
  [[nodiscard]] std::int32_t RowOf(double row) const;

  double column_ = 0;  // where the first block begins
  double row_ = 0;
  std::int32_t columns_ = 0;
  std::int32_t rows_ = 0;
  std::vector<Entry> entries_;           // by block, falling in each
  std::vector<std::size_t> starts_;      // per block, and the end
  std::vector<double> highest_;          // per block
  std::vector<std::uint32_t> found_in_;  // per segment: the last search that found it
  std::uint32_t search_ = 0;
};

}  // namespace farhorizon
