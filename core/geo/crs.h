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
/// Heights are ellipsoidal (WGS 84) unless the reference system or `vertical_datum` says otherwise;
/// then the geoid grid must be installed, or Open fails and names it. Never uses the network.
/// Threads: one object a thread.
class GlobeTransform {
 public:
  /// crs: an authority's code ("EPSG:4326", "EPSG:4326+5773"), WKT, or what else PROJ reads, but
  ///   neither a URL nor a path, nor anything that names files.
  /// vertical_datum: "EPSG:5773" and the like, or "ellipsoid"; empty: what `crs` says, else the
  ///   ellipsoid.
  /// about: a point of the DEM. Where there are several ways between two datums, the best one there
  ///   is taken for all points, so that a DEM across their border has no tear; longitudes of
  ///   FromGeodetic are those within half a turn of it. Unset: PROJ decides point by point.
  /// Errors: kUnsupportedData unknown or unusable, with the reason and the remedy (kinds "no-crs",
  ///   "unknown-crs", "local-crs", "no-geoid-grid"); "outside-crs" where `about` has no image.
  static Result<GlobeTransform> Open(const std::string& crs, const std::string& vertical_datum,
                                     std::optional<MapPoint> about = std::nullopt);
  ~GlobeTransform();
  GlobeTransform(GlobeTransform&&) noexcept;
  GlobeTransform& operator=(GlobeTransform&&) noexcept;

  /// Longitudes come within [-180, 180].
  /// There and back is the same point within a micrometre; within a millimetre where the datum is
  /// not WGS 84 and the system has no heights (the datum shift's own effect on heights is dropped).
  /// Errors: kUnsupportedData where a point has no image (kind "outside-crs").
  [[nodiscard]] Result<std::vector<Geodetic>> ToGeodetic(const std::vector<MapPoint>& points) const;
  [[nodiscard]] Result<std::vector<Ecef>> ToEcef(const std::vector<Geodetic>& points) const;
  [[nodiscard]] Result<std::vector<Geodetic>> FromEcef(const std::vector<Ecef>& points) const;
  [[nodiscard]] Result<std::vector<MapPoint>> FromGeodetic(
      const std::vector<Geodetic>& points) const;

  /// "EPSG:4326" where the reference system has a code, "EPSG:4326+5773" where both its parts have
  /// one, else its name.
  [[nodiscard]] std::string Name() const;

 private:
  struct State;
  explicit GlobeTransform(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace farhorizon
