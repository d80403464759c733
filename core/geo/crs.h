#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geo/frames.h"

namespace farhorizon {

/// Map coordinates in a DEM's reference system: x east, y north (degrees or the map's unit), z in
/// metres above whatever its vertical datum is.
struct MapPoint {
  double x = 0;
  double y = 0;
  double z = 0;
};

/// The way from a DEM's reference system to the globe and back, through PROJ.
///
/// Heights are ellipsoidal unless the reference system or `vertical_datum` says otherwise; then the
/// geoid grid must be installed, or Open fails and names it. Never uses the network.
/// Threads: one object a thread.
class GlobeTransform {
 public:
  /// crs: whatever PROJ reads ("EPSG:4326", WKT), but neither a URL nor a path.
  /// vertical_datum: "EPSG:5773" and the like; empty: what `crs` says, else the ellipsoid.
  /// Errors: kUnsupportedData unknown or unusable, with the reason and the remedy (kinds "no-crs",
  ///   "unknown-crs", "local-crs", "no-geoid-grid").
  static Result<GlobeTransform> Open(const std::string& crs, const std::string& vertical_datum);
  ~GlobeTransform();
  GlobeTransform(GlobeTransform&&) noexcept;
  GlobeTransform& operator=(GlobeTransform&&) noexcept;

  /// Errors: kUnsupportedData where a point has no image (kind "outside-crs").
  [[nodiscard]] Result<std::vector<Geodetic>> ToGeodetic(const std::vector<MapPoint>& points) const;
  [[nodiscard]] Result<std::vector<Ecef>> ToEcef(const std::vector<Geodetic>& points) const;
  [[nodiscard]] Result<std::vector<Geodetic>> FromEcef(const std::vector<Ecef>& points) const;
  [[nodiscard]] Result<std::vector<MapPoint>> FromGeodetic(
      const std::vector<Geodetic>& points) const;

  /// "EPSG:4326" where the reference system has a code, else its name.
  [[nodiscard]] std::string Name() const;

 private:
  struct State;
  explicit GlobeTransform(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace farhorizon
