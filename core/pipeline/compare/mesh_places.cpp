#include "core/pipeline/compare/mesh_places.h"

#include <utility>

#include "core/pipeline/post_places.h"

namespace farhorizon {

Result<PostPlaces> MeshPlaces::For(MeshFrame frame, const CoveredPart* part) {
  if (!IsStraightOnGlobe(frame)) {
    PostPlaces over_grid;
    over_grid.column_m = input_->georeference().column_step_m();
    over_grid.row_m = input_->georeference().row_step_m();
    return over_grid;
  }
  if (!on_globe_) {
    Result<PostPlaces> places = FindPostPlaces(input_->terrain(), input_->georeference());
    if (!places) return places;
    on_globe_ = *std::move(places);
  }
  if (part == nullptr) return *on_globe_;
  PostPlaces places = *on_globe_;
  places.positions.clear();
  const std::int32_t columns = input_->dem().columns;
  for (std::int32_t r = 0; r < part->dem.rows; ++r) {
    const auto from =
        on_globe_->positions.begin() + (r + part->first[1]) * columns + part->first[0];
    places.positions.insert(places.positions.end(), from, from + part->dem.columns);
  }
  return places;
}

}  // namespace farhorizon
