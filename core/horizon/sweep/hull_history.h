#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/horizon/sweep/hull_scene.h"
#include "core/terrain/dem.h"

namespace farhorizon {

/// The changes of the hulls during a sweep, in order, and some states in between from which they
/// can be replayed.
///
/// A hull that starts or is extended is so by the vertex that the plane passes. Extensions of one
/// hull by successive vertices, as level ground has them, are one record. Memory: 16 bytes a
/// record; the states take at most 8 bytes a post of the DEM, or 1 MiB where that is more.
class HullHistory {
 public:
  /// Of a DEM of columns x rows posts.
  HullHistory(std::int32_t columns, std::int32_t rows) : columns_(columns), rows_(rows) {}

  /// The vertex `by` makes this change. Requires: where it has a post, that is the vertex.
  void Append(VertexId by, const HullChange& change);
  /// A replay may begin here: `scene` are the hulls before `next`, the next vertex. Where states
  /// take too much memory, every second one is dropped, and from then on of those that are offered.
  void OfferState(VertexId next, const HullScene& scene);

  [[nodiscard]] std::size_t record_count() const { return records_.size(); }
  /// At least one, once one has been offered: the first.
  [[nodiscard]] std::size_t state_count() const { return states_.size(); }
  /// The next vertex at a state.
  [[nodiscard]] VertexId VertexAt(std::size_t state) const { return states_[state].vertex; }

  /// The scene while changes are replayed. Requires: the history outlives it.
  class Replay {
   public:
    Replay(const HullHistory& history, std::size_t state);

    [[nodiscard]] const HullScene& scene() const { return scene_; }

    /// Applies the next changes as long as accept(vertex) is true for the vertex that makes them.
    template <typename Accept>
    void ApplyWhile(const Accept& accept) {
      while (next_ < history_.records_.size() && accept(history_.records_[next_].by + repeated_)) {
        ApplyNext();
      }
    }

   private:
    void ApplyNext();

    const HullHistory& history_;
    HullScene scene_;
    std::size_t next_;           // record
    std::int32_t repeated_ = 0;  // extensions of that record that have been applied
  };

 private:
  struct Record {
    HullChange::Kind kind;
    VertexId by;
    std::int32_t hull;
    /// kMerge: HullChange::other. kExtension: how many vertices by + 1, by + 2, ... extend the hull
    /// likewise.
    std::int32_t other;
  };
  struct State {
    VertexId vertex;
    std::size_t next_record;
    HullSnapshot hulls;
  };

  std::int32_t columns_;
  std::int32_t rows_;
  std::vector<Record> records_;
  std::vector<State> states_;
  std::size_t state_bytes_ = 0;
  std::size_t offered_ = 0;
  std::size_t stride_ = 1;  // every so many offers are taken
};

}  // namespace farhorizon
