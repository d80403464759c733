#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/horizon/horizon.h"
#include "core/simplify/lines/line_lists.h"
#include "core/simplify/lines/pencils.h"
#include "core/simplify/mesh/half_edge_mesh.h"

namespace farhorizon {

/// The silhouette as the simplifier sees it: over each sampled line the DEM's greatest height,
/// which its horizon edges alone give because they generate it, and the mesh's, with the edge that
/// carries it and the next ones below, so that losing an edge is priced without a search.
class SampledSkyline {
 public:
  static constexpr float kNone = -1e30F;

  /// Requires: `mesh` outlives it and is the whole terrain.
  SampledSkyline(const HalfEdgeMesh& mesh, const Horizon& horizon, std::int32_t directions);

  struct Crossing {
    float height;
    std::int32_t a;
    std::int32_t b;
  };
  [[nodiscard]] const Pencils& pencils() const { return pencils_; }
  [[nodiscard]] const Table<float>& dem() const { return dem_; }
  [[nodiscard]] float top(std::int32_t line) const { return top_[line]; }
  /// Whether the line meets the terrain and is asked still.
  [[nodiscard]] bool Counts(std::int32_t line) const {
    return dem_[line] > kNone && pencils_.IsAsked(line);
  }
  [[nodiscard]] bool Meets(std::int32_t line) const { return dem_[line] > kNone; }
  /// The square of the line's error where the mesh's greatest height over it is `height`.
  [[nodiscard]] float Square(std::int32_t line, float height) const {
    return (height - dem_[line]) * (height - dem_[line]);
  }
  [[nodiscard]] const Crossing& Best(std::int32_t line) const {
    return crossings_[static_cast<std::size_t>(line) * kKept];
  }
  [[nodiscard]] bool Carries(std::int32_t line, std::int32_t v) const {
    return count_[line] > 0 && (Best(line).a == v || Best(line).b == v);
  }
  /// Per vertex: the lines whose top edge ends there, and some that once did.
  LineLists& carried() { return carried_; }

  /// Leaves out every other pencil while at least `least` lines remain: the fewer vertices, the
  /// fewer lines need to judge them.
  void Thin(std::int64_t least);
  /// Posts to each line that counts.
  [[nodiscard]] double PostsPerLine() const { return posts_per_line_; }

  /// The greatest height on the line that is left without the edges of v, as far as is known: too
  /// low where all that is kept ends at v. The loss then looks greater than it is.
  [[nodiscard]] float Without(std::int32_t line, std::int32_t v) const;

  /// The upkeep while the mesh changes. Keeps a crossing among the line's highest, if it is one.
  bool Keep(std::int32_t line, const Crossing& crossing);
  /// Brings what is kept up to date with the mesh, whose vertices go and move; leaves out the edge
  /// a, b.
  void Refresh(std::int32_t line, std::int32_t a = -1, std::int32_t b = -1);
  /// Takes an edge out of all lines.
  void Forget(std::int32_t a, std::int32_t b);
  /// Makes the best crossing that is known the line's top.
  void Crown(std::int32_t line);
  /// A new edge raises the lines that it crosses above their tops.
  void Raise(std::int32_t a, std::int32_t b);

 private:
  static constexpr std::size_t kKept = 5;  // crossings a line

  void CountLines();
  [[nodiscard]] float HeightOn(std::int32_t line, std::int32_t a, std::int32_t b) const;

  const HalfEdgeMesh* mesh_;
  Pencils pencils_;
  Table<float> dem_;                 // per line
  Table<float> top_;                 // per line
  std::vector<Crossing> crossings_;  // kKept a line, highest first
  Table<std::uint8_t> count_;        // per line: of crossings
  std::vector<bool> known_;          // per vertex: an edge of it has been kept somewhere
  LineLists carried_;
  std::int64_t lines_ = 0;  // that count
  double posts_per_line_ = 0;
};

}  // namespace farhorizon
