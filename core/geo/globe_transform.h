#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "core/geo/frames.h"

namespace farhorizon {

/// Map coordinates in a DEM's reference system: x east, y north (degrees or the map's unit), z
/// metres above the system's vertical datum, whichever that is and however it counts.
struct MapPoint {
  double x = 0;
  double y = 0;
  double z = 0;
};

/// What the call says of the way to the globe beside the reference system.
struct GlobeOptions {
  /// "EPSG:5773" and the like, a datum's name ("EGM96"), or "ellipsoid"; empty: what the system
  /// says, or the ellipsoid where it says nothing.
  std::string vertical_datum = {};
  /// A code ("EPSG:1173") or a name of PROJ's operations from the system to WGS 84, or "ballpark";
  /// empty: chosen for the system (core/geo/datum_choice.h).
  std::string datum_operation = {};
  /// A point of the DEM. FromGeodetic returns longitudes within half a turn of it. It has no part
  /// in the choice of an operation, so that tiles of one system fit.
  std::optional<MapPoint> about = {};
};

/// The way from a DEM's reference system to the globe (WGS 84) and back, through PROJ.
///
/// Heights are ellipsoidal unless the reference system or `vertical_datum` says otherwise; then the
/// geoid grid must be installed, or Open fails and names it. Mean sea level without a name is taken
/// for that of EGM96. One operation serves all points: no tear within a DEM, none between two of
/// one system. Never uses the network.
/// Threads: an object is used by one thread at a time.
class GlobeTransform {
 public:
  /// crs: an authority's code ("EPSG:4326", "EPSG:4326+5773"), WKT, a PROJ string, or another
  ///   definition that PROJ reads, except those that CheckCrsText refuses.
  /// Errors: kUnsupportedData, with the reason and the remedy: kinds "no-crs", "unknown-crs",
  ///   "local-crs", "no-geoid-grid", and "outside-crs" where `about` has no image; kInvalidArgument
  ///   where there is no such datum operation; kIo where PROJ's database is missing.
  static Result<GlobeTransform> Open(const std::string& crs, const GlobeOptions& options = {});
  ~GlobeTransform();
  GlobeTransform(GlobeTransform&&) noexcept;
  GlobeTransform& operator=(GlobeTransform&&) noexcept;

  /// Longitudes are within [-180, 180].
  /// There and back is the same point within a micrometre; within a millimetre where the datum is
  /// not WGS 84 and the system has no heights (the datum shift's own effect on heights is dropped).
  /// Errors, of all four: kUnsupportedData, kind "outside-crs", where a point has no image.
  [[nodiscard]] Result<std::vector<Geodetic>> ToGeodetic(const std::vector<MapPoint>& points) const;
  [[nodiscard]] Result<std::vector<Ecef>> ToEcef(const std::vector<Geodetic>& points) const;
  [[nodiscard]] Result<std::vector<Geodetic>> FromEcef(const std::vector<Ecef>& points) const;
  [[nodiscard]] Result<std::vector<MapPoint>> FromGeodetic(
      const std::vector<Geodetic>& points) const;

  /// "EPSG:4326" where the reference system has a code, "EPSG:4326+5773" where both its parts have
  /// one; otherwise its name, as NameOf has it (core/geo/crs_name.h).
  [[nodiscard]] std::string Name() const;

  /// A full turn in the unit of a geographic system's axes; 0 for any other system.
  [[nodiscard]] double FullTurn() const;

  /// Whether the place is in the area where the system is used; true where none is stated.
  [[nodiscard]] bool InAreaOfUse(const Geodetic& place) const;

  /// What was assumed about the way: codes "datum-operation" and "vertical-datum".
  [[nodiscard]] const Assumptions& assumptions() const;

 private:
  struct State;
  explicit GlobeTransform(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace farhorizon
