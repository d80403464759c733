#pragma once

#include <cstdint>
#include <vector>

#include "core/terrain/dem.h"

namespace farhorizon {

/// Into how many parts a level is cut: 2^columns beside one another, 2^rows below one another.
struct PartDepth {
  int columns = 0;
  int rows = 0;

  [[nodiscard]] std::int64_t Parts() const { return std::int64_t{1} << (columns + rows); }
  friend bool operator==(const PartDepth&, const PartDepth&) = default;
};

/// Neither side is halved more often. So a level has 256 parts at most.
inline constexpr int kMostPartDepth = 4;

/// How often a side of `posts` posts may be halved where that share of them are vertices of a
/// level: each piece has 32 of them or more. The posts at which it would be cut are vertices of
/// every such level, cut or not, so that two tiles agree on the side that they share.
int SidePartDepth(std::int64_t posts, double share);

/// The least depth, both sides halved alike as far as `most` goes, at which parts of `triangles`
/// have part_triangles in the mean or less; `most` where none is deep enough. part_triangles: 0: a
/// level is never cut.
PartDepth PartDepthFor(std::int64_t triangles, std::int64_t part_triangles, const PartDepth& most);

/// Where a tile is cut: along columns and rows of posts, each piece into two halves of as many
/// cells, but for an odd one, again and again. So lines of one depth are lines of a greater one.
class PartGrid {
 public:
  PartGrid() = default;
  /// Requires: columns, rows >= 2; depth at most kMostPartDepth.
  PartGrid(std::int32_t columns, std::int32_t rows, const PartDepth& depth);

  [[nodiscard]] const PartDepth& depth() const { return depth_; }
  /// Whether a side of `posts` posts that is halved `depth` times is cut at post i.
  static bool IsCutAt(std::int64_t i, std::int64_t posts, int depth);
  /// Whether the straight edge between two posts has points on both sides of a line.
  [[nodiscard]] bool IsCrossedBy(std::int32_t x, std::int32_t y, std::int32_t to_x,
                                 std::int32_t to_y) const {
    return depth_ != PartDepth{} && (columns_.IsBetween(x, to_x) || rows_.IsBetween(y, to_y));
  }
  /// Whether post (x, y) lies on a line.
  [[nodiscard]] bool IsOnLine(std::int32_t x, std::int32_t y) const {
    return columns_.Has(x) || rows_.Has(y);
  }
  /// Of a triangle that crosses no line the part, counted from 0: by its box of columns and rows.
  [[nodiscard]] std::int32_t ColumnPart(std::int32_t least_x) const {
    return columns_.After(least_x);
  }
  [[nodiscard]] std::int32_t RowPart(std::int32_t least_y) const { return rows_.After(least_y); }

 private:
  // The cuts of one side, counted along it.
  class Cuts {
   public:
    Cuts() = default;
    Cuts(std::int32_t posts, int depth);
    // Whether a cut lies strictly between p and q.
    [[nodiscard]] bool IsBetween(std::int32_t p, std::int32_t q) const {
      if (up_to_.empty()) return false;
      return p < q ? Before(q) > After(p) : Before(p) > After(q);
    }
    [[nodiscard]] bool Has(std::int32_t p) const { return !up_to_.empty() && After(p) > Before(p); }
    // How many cuts are at p or before it.
    [[nodiscard]] std::int32_t After(std::int32_t p) const {
      return up_to_.empty() ? 0 : up_to_[static_cast<std::size_t>(p)];
    }

   private:
    [[nodiscard]] std::int32_t Before(std::int32_t p) const { return p == 0 ? 0 : After(p - 1); }
    std::vector<std::int8_t> up_to_;  // per post of the side; empty: no cuts
  };

  PartDepth depth_;
  Cuts columns_;
  Cuts rows_;
};

}  // namespace farhorizon
