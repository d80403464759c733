// Reads, triangulates and georeferences a DEM, and describes it for the report. The terrain and its
// georeference refer to the DEM inside the object, which therefore lives on the heap.
#include "core/pipeline/terrain_input.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/io/dem/read_dem.h"
#include "core/io/file.h"
#include "core/pipeline/placement_check.h"

namespace farhorizon {

namespace {

// A flat grid of few posts between the outermost ones of `header`, all with data: its place is the
// DEM's, its cells are wider.
Dem StandInFor(const Dem& header) {
  constexpr std::int32_t kMostPosts = 65;
  Dem coarse = header;
  coarse.assumptions.clear();
  coarse.columns = std::min(header.columns, kMostPosts);
  coarse.rows = std::min(header.rows, kMostPosts);
  coarse.transform.step_x *= static_cast<double>(header.columns - 1) / (coarse.columns - 1);
  coarse.transform.step_y *= static_cast<double>(header.rows - 1) / (coarse.rows - 1);
  coarse.heights.assign(
      static_cast<std::size_t>(coarse.columns) * static_cast<std::size_t>(coarse.rows), 0);
  return coarse;
}

// Whether rows of degrees beyond a pole may have no data, so that only those who read them can say:
// where others lie between the poles.
bool HasRowsOnTheGlobe(const Dem& dem, double full_turn) {
  const double first = dem.transform.origin_y;
  const double last = first + (dem.rows - 1) * dem.transform.step_y;
  const double pole = full_turn / 4;
  return full_turn > 0 && std::min(first, last) < pole && std::max(first, last) > -pole;
}

// Requires: the apron leaves a cell. Heights may be unread.
Dem WithoutApron(const Dem& dem, int apron) {
  Dem inner = dem;
  inner.columns -= 2 * apron;
  inner.rows -= 2 * apron;
  inner.transform.origin_x += apron * dem.transform.step_x;
  inner.transform.origin_y += apron * dem.transform.step_y;
  inner.heights.clear();
  if (dem.heights.empty()) return inner;
  inner.heights.reserve(static_cast<std::size_t>(inner.columns) *
                        static_cast<std::size_t>(inner.rows));
  for (std::int32_t row = apron; row < dem.rows - apron; ++row) {
    const auto first = dem.heights.begin() + std::ptrdiff_t{row} * dem.columns + apron;
    inner.heights.insert(inner.heights.end(), first, first + inner.columns);
  }
  return inner;
}

}  // namespace

Result<std::unique_ptr<TerrainInput>> TerrainInput::Open(const std::filesystem::path& path,
                                                         const BuildOptions& options,
                                                         const RunControl& control,
                                                         std::int64_t most_decoded) {
  std::unique_ptr<TerrainInput> input(new TerrainInput());
  Result<Dem> dem = ReadDem(path, {.max_posts = options.max_posts,
                                   .crs = options.crs,
                                   .vertical_datum = options.vertical_datum,
                                   .nodata = options.nodata,
                                   .height_unit = options.height_unit,
                                   .most_decoded = most_decoded});
  if (!dem) return std::move(dem.error()).WithContext("read DEM");
  input->dem_ = *std::move(dem);
  input->posts_ = std::int64_t{input->dem_.columns} * input->dem_.rows;
  input->Assume(input->dem_.assumptions, control);
  if (options.apron > 0) {
    if (Status cut = input->CutApron(options.apron); !cut) return std::move(cut.error());
  }
  input->header_only_ = input->dem_.heights.empty();
  if (input->header_only_) input->dem_ = StandInFor(input->dem_);
  Result<Terrain> terrain = Terrain::Build(input->dem_);
  if (!terrain) return std::move(terrain.error()).WithContext("triangulate DEM");
  input->terrain_ = *terrain;
  Result<Georeference> georeference =
      Georeference::Of(*input->terrain_,
                       {.vertical_datum = options.vertical_datum.value_or(""),
                        .datum_operation = options.datum_operation.value_or("")},
                       options.frame);
  if (!georeference) return std::move(georeference.error()).WithContext("place DEM on the globe");
  input->georeference_.emplace(*std::move(georeference));
  Status placed = CheckPlacement(*input->terrain_, *input->georeference_);
  if (!placed && input->header_only_ && placed.error().kind == "outside-crs" &&
      HasRowsOnTheGlobe(input->dem_, input->georeference_->FullTurn())) {
    placed = Ok{};
  }
  if (!placed) {
    return std::move(placed.error()).WithContext("place DEM on the globe");
  }
  input->Assume(input->georeference_->assumptions(), control);
  if (input->header_only_) return input;
  Result<std::string> sha256 = Sha256OfFile(path);
  if (!sha256) return std::move(sha256.error()).WithContext("read DEM");
  input->report_.sha256 = *std::move(sha256);
  input->Describe();
  return input;
}

Status TerrainInput::CutApron(int apron) {
  if (std::min(dem_.columns, dem_.rows) < 2 * apron + 2) {
    return Error{ErrorCode::kInvalidArgument,
                 "--apron is " + std::to_string(apron) + ", which leaves no cell of the DEM's " +
                     std::to_string(dem_.columns) + " x " + std::to_string(dem_.rows) + " posts",
                 "invalid-parameter"};
  }
  report_.apron = apron;
  Dem inner = WithoutApron(dem_, apron);
  dem_around_ = std::exchange(dem_, std::move(inner));
  if (dem_.heights.empty()) return Ok{};
  Result<Terrain> around = Terrain::Build(dem_around_);
  if (!around) return std::move(around.error()).WithContext("triangulate DEM");
  around_ = *around;
  return Ok{};
}

void TerrainInput::Assume(const Assumptions& assumptions, const RunControl& control) {
  for (const Assumption& assumption : assumptions) {
    assumptions_.push_back(assumption);
    control.Assume(assumption);
  }
}

void TerrainInput::Describe() {
  report_.columns = dem_.columns;
  report_.rows = dem_.rows;
  report_.crs = georeference_->CrsName();
  report_.cell_m = {RoundUp(georeference_->column_step_m()), RoundUp(georeference_->row_step_m())};
  report_.height_quantum_m = dem_.quantum_m;
  report_.heights_rounded = dem_.quantized;
  bool first = true;
  for (VertexId v = 0; v < terrain_->post_count(); ++v) {
    if (!dem_.HasData(v)) {
      ++report_.nodata_posts;
      continue;
    }
    const double height = dem_.HeightM(v);
    report_.heights_m = {first ? height : std::min(report_.heights_m[0], height),
                         first ? height : std::max(report_.heights_m[1], height)};
    first = false;
  }
}

}  // namespace farhorizon
