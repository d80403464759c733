#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace farhorizon {

/// Whose axes a local frame has.
enum class FrameAxes {
  kTile,   ///< east, north and up in the middle of the tile
  kPlace,  ///< east, north and up at a stated place, for all tiles of a pipeline
  kGlobe,  ///< earth-fixed
};

/// The axes that positions are rounded along. lon_deg, lat_deg: of kPlace.
struct FrameChoice {
  FrameAxes axes = FrameAxes::kTile;
  double lon_deg = 0;
  double lat_deg = 0;
  friend bool operator==(const FrameChoice&, const FrameChoice&) = default;
};

/// "tile", "globe", or longitude and latitude, "7.5,46", as few digits as tell the doubles.
std::string FrameText(const FrameChoice& frame);

/// The choice that FrameText or a person writes so; nullopt for any other text, and for a place
/// beyond 180 degrees of longitude or 90 of latitude.
std::optional<FrameChoice> FrameFromText(std::string_view text);

}  // namespace farhorizon
