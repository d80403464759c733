#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/io/horizon_features.h"
#include "core/io/picture.h"
#include "core/pipeline/report_page/azimuth_colours.h"
#include "core/pipeline/report_page/picture_frame.h"

namespace farhorizon {

/// The horizon edges of one sector of directions, or the undecided ones: their number, how many of
/// all lines of sight have their skyline on them (line_measure_m), and a picture of them, each in
/// the colour of its ShownAzimuth, that has no other pixels.
struct EdgeLayer {
  std::int64_t edges = 0;
  double line_measure_m = 0;
  PalettePicture picture;
};

/// A layer for each sector, and one for the undecided edges, which are grey.
/// Edges with a greater line_measure_m lie above the others.
/// Cost: O(edges log edges + pixels); the layers are of the frame's size, however many edges.
std::array<EdgeLayer, kSectors + 1> DrawEdgeLayers(const std::vector<HorizonFeature>& features,
                                                   const PictureFrame& frame);

}  // namespace farhorizon
