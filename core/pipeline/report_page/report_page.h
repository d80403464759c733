#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/io/horizon_features.h"
#include "core/io/local_mesh.h"
#include "core/io/manifest.h"
#include "core/io/picture.h"
#include "core/pipeline/georeference.h"
#include "core/pipeline/report.h"
#include "core/pipeline/report_page/picture_frame.h"
#include "core/pipeline/report_page/skyline_chart.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// What the page says beside what it shows of the levels.
///
/// artifacts: those written so far. seconds: by stage; empty where nobody measured them, and then
/// the page depends on the input and the options alone.
struct PageContents {
  const Report& report;
  const std::vector<HorizonFeature>& features;
  const std::vector<ManifestEntry>& artifacts;
  StageSeconds seconds;
};

/// Makes report.html: one file that asks the network for nothing, with pictures of the DEM, of the
/// levels and of the horizon edges, skylines, measures, and what was assumed.
///
/// Takes the levels one by one, so that their meshes need not be kept: of each, a picture in grey
/// and its skylines remain.
class ReportPage {
 public:
  /// Draws the DEM. Requires: terrain and georeference outlive the page. Errors: those of
  ///   Georeference::StepsAt. Cost: O(posts + pixels).
  static Result<ReportPage> Start(const Terrain& terrain, const Georeference& georeference,
                                  const Horizon& horizon);

  /// Draws the next level, from its decoded mesh; level 0 is the first.
  /// Errors: those of Georeference::ToGrid. Cost: O(triangles + pixels).
  Status AddLevel(const LocalMesh& decoded);

  /// The page, a few megabytes at most, however large the DEM. Requires: a level was added.
  /// Errors: those of EncodeJpeg and EncodePng.
  [[nodiscard]] Result<std::string> Write(const PageContents& contents) const;

 private:
  ReportPage(const Terrain& terrain, const Georeference& georeference)
      : terrain_(&terrain), georeference_(&georeference) {}

  const Terrain* terrain_;
  const Georeference* georeference_;
  PictureFrame frame_;
  GroundStep step_;
  double base_m_ = 0;
  double exaggeration_ = 1;
  std::vector<GreyPicture> reliefs_;  // the terrain's, then the levels'
  std::vector<SkylineSet> skylines_;
};

}  // namespace farhorizon
