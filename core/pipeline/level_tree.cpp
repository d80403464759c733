#include "core/pipeline/level_tree.h"

#include <cstddef>
#include <utility>

#include "core/base/result.h"

namespace farhorizon {

namespace {

// A tile, and what it and all below it cover.
struct Branch {
  TilesetTile tile;
  MeshRegion region;
};

class TreeBuilder {
 public:
  TreeBuilder(const std::vector<LevelReport>& levels,
              const std::vector<std::vector<TileContentRegion>>& contents)
      : levels_(levels), contents_(contents) {}

  // The tile of a part; as deep as there are levels.
  [[nodiscard]] Branch Of(std::size_t level, const TileContentRegion& content) const {
    const LevelReport& report = levels_[level];
    Branch branch = {{content.uri, report.geometric_error_m, {}, {}}, content.region};
    if (level > 0) {
      const PartDepth& finer = levels_[level - 1].parts;
      const int columns = finer.columns - report.parts.columns;
      const int rows = finer.rows - report.parts.rows;
      for (const TileContentRegion& part : contents_[level - 1]) {
        const PartPlace above = {part.place.column >> columns, part.place.row >> rows};
        if (above == content.place) Add(Of(level - 1, part), branch);
      }
    }
    // A side that is over the meridian of 180 degrees by a rounding is put on it.
    branch.tile.region = branch.region.Box(report.side_step_m);
    return branch;
  }

  static void Add(Branch child, Branch& branch) {
    branch.region.Add(child.region);
    branch.tile.children.push_back(std::move(child.tile));
  }

 private:
  const std::vector<LevelReport>& levels_;
  const std::vector<std::vector<TileContentRegion>>& contents_;
};

}  // namespace

TilesetTile TreeOf(const std::vector<LevelReport>& levels,
                   const std::vector<std::vector<TileContentRegion>>& contents,
                   double root_error_m) {
  Check(!levels.empty() && levels.size() == contents.size() && !contents.back().empty(),
        "a tileset without levels");
  const TreeBuilder builder(levels, contents);
  const std::size_t coarsest = levels.size() - 1;
  const std::vector<TileContentRegion>& parts = contents[coarsest];
  if (parts.size() == 1) return builder.Of(coarsest, parts.front()).tile;
  Branch root = {{"", root_error_m, {}, {}}, parts.front().region};
  for (const TileContentRegion& part : parts) TreeBuilder::Add(builder.Of(coarsest, part), root);
  root.tile.region = root.region.Box(levels[coarsest].side_step_m);
  return root.tile;
}

}  // namespace farhorizon
