// From exact lines of sight to what is published. Directions are taken on the ground as angles from the
// edge's own: the half turn from it is where sights are given (lines_of_sight.h), and curves that bound them turn
// one way only, so that the ends of a patch hold its least and its greatest.
#include "core/pipeline/edge_measures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/parallel_for.h"
#include "core/geometry/interval_set.h"
#include "core/horizon/lines_of_sight/skyline_drop.h"

namespace farhorizon {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

// Directions on the ground, as they are seen from one edge.
class EdgeCompass {
 public:
  EdgeCompass(std::array<double, 2> along, const GroundStep& step)
      : step_(step), along_(along), ground_(OnGround(along[0], along[1])) {}

  [[nodiscard]] double length_m() const { return std::hypot(ground_[0], ground_[1]); }

  // Whether azimuths rise as directions turn from columns to rows.
  [[nodiscard]] bool KeepsSense() const { return Determinant() < 0; }
  [[nodiscard]] double azimuth() const { return std::atan2(ground_[0], ground_[1]) * kDegrees; }

  // The angle on the ground from the edge's direction, in degrees, 0 to 180.
  [[nodiscard]] double Angle(const PlanMotion& motion, double t) const {
    const auto [dot, cross] = DotAndCross(motion, t);
    return HalfTurnAngle(dot, cross) * kDegrees;
  }

  [[nodiscard]] double Cosine(const PlanMotion& motion, double t) const {
    const auto [dot, cross] = DotAndCross(motion, t);
    return dot / std::hypot(dot, cross);
  }

 private:
  [[nodiscard]] std::array<double, 2> OnGround(double x, double y) const {
    return {step_.column_east_m * x + step_.row_east_m * y,
            step_.column_north_m * x + step_.row_north_m * y};
  }
  [[nodiscard]] double Determinant() const {
    return step_.column_east_m * step_.row_north_m - step_.row_east_m * step_.column_north_m;
  }
  [[nodiscard]] std::array<double, 2> DotAndCross(const PlanMotion& motion, double t) const {
    const auto [x, y] = motion.At(t);
    const std::array<double, 2> ground = OnGround(x, y);
    return {ground[0] * ground_[0] + ground[1] * ground_[1],
            std::abs(Determinant()) * (along_[0] * y - along_[1] * x)};
  }

  GroundStep step_;
  std::array<double, 2> along_;
  std::array<double, 2> ground_;
};

// To whole steps, outwards, but for what rounding does.
Interval Outwards(const Interval& interval, double step) {
  constexpr double kSlack = 1e-3;
  const double from = std::floor(interval[0] / step + kSlack);
  const double to = std::max(std::ceil(interval[1] / step - kSlack), from + 1);
  return {from * step, to * step};
}

// Angles from the edge's direction to azimuths.
std::vector<Interval> AzimuthsOf(const std::vector<Interval>& angles, const EdgeCompass& compass) {
  std::vector<Interval> turned = angles;
  const bool across_start = turned.size() > 1 && turned.front()[0] <= 0 && turned.back()[1] >= 180;
  if (across_start) {
    turned.back()[1] = turned.front()[1] + 180;
    turned.erase(turned.begin());
  }
  std::vector<Interval> azimuths;
  for (const Interval& angle : turned) {
    const double base = compass.azimuth();
    const Interval real = compass.KeepsSense() ? Interval{base + angle[0], base + angle[1]}
                                               : Interval{base - angle[1], base - angle[0]};
    const Interval rounded = Outwards(real, kAzimuthStep);
    const double width = rounded[1] - rounded[0];
    if (width >= 180) return {{0, 180}};
    double from = std::fmod(rounded[0], 180.0);
    if (from < 0) from += 180;
    if (from > 180 - kAzimuthStep / 2) from = 0;
    azimuths.push_back({from, from + width});
  }
  azimuths = UnionOf(std::move(azimuths));
  // The last may reach the first again, half a turn on.
  if (azimuths.size() > 1 && azimuths.back()[1] >= azimuths.front()[0] + 180) {
    azimuths.back()[1] = std::max(azimuths.back()[1], azimuths.front()[1] + 180);
    azimuths.erase(azimuths.begin());
  }
  if (azimuths.size() == 1 && azimuths[0][1] - azimuths[0][0] >= 180) return {{0, 180}};
  return azimuths;
}

// The integral over t of the difference of the cosines: that of the sine over the patch. By Gauss's rule of
// eight points on each quarter of the range.
double MeasureOf(const LineOfSightCell& patch, const EdgeCompass& compass) {
  constexpr std::array<double, 4> kPoints = {0.1834346424956498, 0.5255324099163290,
                                             0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> kWeights = {0.3626837833783620, 0.3137066458778873,
                                              0.2223810344533745, 0.1012285362903763};
  constexpr int kParts = 4;
  const double half = (patch.to - patch.from) / (2 * kParts);
  double sum = 0;
  for (int part = 0; part < kParts; ++part) {
    const double middle = patch.from + (2 * part + 1) * half;
    for (std::size_t i = 0; i < kPoints.size(); ++i) {
      for (const double t : {middle - half * kPoints[i], middle + half * kPoints[i]}) {
        sum += kWeights[i] * (compass.Cosine(patch.first, t) - compass.Cosine(patch.last, t));
      }
    }
  }
  return std::max(sum * half, 0.0);
}

}  // namespace

EdgeMeasures MeasuresOf(const LinesOfSight& sights, std::array<double, 2> along,
                        const GroundStep& step) {
  const EdgeCompass compass(along, step);
  EdgeMeasures view;
  std::vector<Interval> angles;
  for (const LineOfSightCell& patch : sights) {
    angles.push_back(
        {std::min(compass.Angle(patch.first, patch.from), compass.Angle(patch.first, patch.to)),
         std::max(compass.Angle(patch.last, patch.from), compass.Angle(patch.last, patch.to))});
    view.spans.push_back(Outwards({patch.from, patch.to}, kSpanStep));
    view.line_measure_m += MeasureOf(patch, compass) * compass.length_m();
  }
  view.spans = UnionOf(std::move(view.spans));
  angles = UnionOf(std::move(angles));
  for (const Interval& angle : angles) view.angular_share += (angle[1] - angle[0]) / 180;
  view.azimuths = AzimuthsOf(angles, compass);
  return view;
}

Result<std::vector<EdgeMeasures>> MeasureEdges(const Terrain& terrain, const Horizon& horizon,
                                               const Georeference& georeference, int threads,
                                               const Watch& watch) {
  Result<std::vector<LinesOfSight>> sights = FindLinesOfSight(terrain, horizon, threads, watch);
  if (!sights) return std::move(sights.error());
  watch.Report(Stage::kEdgeMeasures, 0);
  std::vector<std::array<double, 2>> middles;
  for (const HorizonEdge& e : horizon.edges) {
    const Point3i a = terrain.Point(e.edge.a);
    const Point3i b = terrain.Point(e.edge.b);
    middles.push_back({(a.x + b.x) / 2.0, (a.y + b.y) / 2.0});
  }
  Result<std::vector<GroundStep>> steps = georeference.StepsAt(middles);
  if (!steps) return std::move(steps.error());
  const SkylineDrops skyline_drops(terrain, horizon, kSkylineDropStep / terrain.dem().quantum_m);
  std::vector<EdgeMeasures> views(horizon.edges.size());
  const auto look = [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
    for (std::size_t i = begin; i < end; ++i) {
      const Edge edge = horizon.edges[i].edge;
      const Point3i a = terrain.Point(edge.a);
      const Point3i b = terrain.Point(edge.b);
      const std::array<double, 2> along = {static_cast<double>(b.x) - a.x,
                                           static_cast<double>(b.y) - a.y};
      views[i] = MeasuresOf((*sights)[i], along, (*steps)[i]);
      views[i].skyline_drop_m = skyline_drops.Of(i) * terrain.dem().quantum_m;
    }
  };
  if (!ParallelForBatches(views.size(), kBatch, threads, Stage::kEdgeMeasures, watch, look)) {
    return Error{ErrorCode::kCancelled, "stopped while weighing horizon edges"};
  }
  return views;
}

}  // namespace farhorizon
