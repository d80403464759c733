#include "core/simplify/sides/side_posts.h"

#include <algorithm>
#include <cmath>

#include "core/simplify/sides/ranking.h"
#include "core/terrain/part_grid.h"

namespace farhorizon {

SidePosts::SidePosts(const Terrain& terrain) : terrain_(&terrain) {
  const std::int32_t columns = terrain.dem().columns;
  const std::int32_t rows = terrain.dem().rows;
  for (const std::int32_t row : {0, rows - 1}) FindRuns(row * columns, 1, columns);
  for (const std::int32_t column : {0, columns - 1}) FindRuns(column, columns, rows);
}

void SidePosts::FindRuns(VertexId first, std::int32_t step, std::int32_t count) {
  std::int32_t begin = 0;
  for (std::int32_t i = 0; i <= count; ++i) {
    if (i < count && terrain_->dem().HasData(first + i * step)) continue;
    if (i > begin) AddRun({first + begin * step, step, begin, count, {}, {}}, i - begin);
    begin = i + 1;
  }
}

void SidePosts::AddRun(Run run, std::int32_t count) {
  for (std::int32_t i = 0; i < count; ++i) {
    run.m.push_back(terrain_->dem().HeightM(run.first + i * run.step));
  }
  run.leave = RankRun(run.m);
  runs_.push_back(std::move(run));
}

double SidePosts::ShareOf(double triangles) {
  // 2.5: less halves the skyline's quality where the side is a ridge, more takes triangles from
  // the inside (measured on alpine, rolling and lidar tiles).
  return std::min(1.0, 2.5 * std::sqrt(triangles));
}

std::vector<std::size_t> SidePosts::Staying(const Run& run, double share) const {
  const int depth = SidePartDepth(run.side, share);
  std::vector<std::size_t> staying;
  for (std::size_t i = 0; i < run.leave.size(); ++i) {
    const std::int64_t on_side = run.offset + static_cast<std::int64_t>(i);
    if (run.leave[i] > 1 - share || PartGrid::IsCutAt(on_side, run.side, depth)) {
      staying.push_back(i);
    }
  }
  return staying;
}

std::vector<SidePosts::Height> SidePosts::At(double share) const {
  std::vector<Height> heights;
  for (const Run& run : runs_) {
    const std::vector<std::size_t> staying = Staying(run, share);
    const std::vector<double> fitted = FitRun(run.m, staying);
    for (std::size_t i = 0; i < staying.size(); ++i) {
      heights.push_back({run.first + static_cast<std::int32_t>(staying[i]) * run.step, fitted[i]});
    }
  }
  return heights;
}

}  // namespace farhorizon
