#include "core/pipeline/compare/mesh_frame.h"

#include <algorithm>
#include <array>

namespace farhorizon {

namespace {

struct Row {
  MeshFrame frame;
  const char* name;
  const char* meaning;
};

constexpr std::array kRows = {
    Row{MeshFrame::kCrs, "crs", "map coordinates of the DEM's reference system"},
    Row{MeshFrame::kLonLat, "lonlat", "longitude and latitude, heights above the ellipsoid"},
    Row{MeshFrame::kEcef, "ecef", "earth-fixed coordinates"},
    Row{MeshFrame::kTile, "tile", "metres east, north and up of farhorizon's frame of the DEM"},
    Row{MeshFrame::kPosts, "posts", "columns and rows, the first row first"},
    Row{MeshFrame::kPostsUp, "posts-up", "columns and rows, the last row first"},
    Row{MeshFrame::kCorner, "corner", "metres from the lower left corner of the map"},
    Row{MeshFrame::kCornerDown, "corner-down", "metres from the upper left corner of the map"},
    Row{MeshFrame::kCentre, "centre", "metres from the middle of the DEM"},
};

const Row& RowOf(MeshFrame frame) { return kRows[static_cast<std::size_t>(frame)]; }

}  // namespace

const char* MeshFrameName(MeshFrame frame) { return RowOf(frame).name; }

const char* MeshFrameMeaning(MeshFrame frame) { return RowOf(frame).meaning; }

std::string MeshFrameNames() {
  std::string names;
  for (const Row& row : kRows) names += (names.empty() ? "" : ", ") + std::string(row.name);
  return names;
}

std::optional<MeshFrame> MeshFrameFromName(std::string_view name) {
  const auto* found = std::ranges::find_if(kRows, [&](const Row& row) { return row.name == name; });
  if (found == kRows.end()) return std::nullopt;
  return found->frame;
}

std::vector<MeshFrame> AllMeshFrames() {
  std::vector<MeshFrame> frames;
  for (const Row& row : kRows) frames.push_back(row.frame);
  return frames;
}

bool IsStraightOnGlobe(MeshFrame frame) {
  return frame == MeshFrame::kEcef || frame == MeshFrame::kTile;
}

}  // namespace farhorizon
