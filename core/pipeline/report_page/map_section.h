#pragma once

#include <cstdint>
#include <vector>

#include "core/io/horizon_features.h"
#include "core/io/picture.h"
#include "core/pipeline/ground_step.h"
#include "core/pipeline/report.h"
#include "core/pipeline/report_page/html.h"
#include "core/pipeline/report_page/picture_frame.h"

namespace farhorizon {

/// What the map of the terrain is made from.
///
/// reliefs: the terrain's, then those of the levels. step: at the terrain's middle.
struct MapContents {
  const Report& report;
  const std::vector<HorizonFeature>& features;
  const PictureFrame& frame;
  const std::vector<GreyPicture>& reliefs;
  GroundStep step;
  double exaggeration = 1;
  std::int64_t terrain_triangles = 0;
};

/// The pictures, one figure each, with the horizon edges over the first, the choice of what is
/// shown, and the colours' meaning.
/// Errors: those of EncodeJpeg and EncodePng.
Result<Html> MapSection(const MapContents& map);

}  // namespace farhorizon
