// From exact lines of sight to published measures. Directions are taken as angles on the ground
// from the edge's own direction: lines of sight are given in the half turn from it
// (lines_of_sight.h), and each curve that bounds a cell turns one way only, so that the cell's
// least and greatest angles are at its ends. Angles become azimuths last, rounded outwards.
#include "core/pipeline/edge_measures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "core/base/parallel_for.h"
#include "core/geometry/interval_set.h"
#include "core/horizon/budgeted_work.h"
#include "core/horizon/lines_of_sight/skyline_drop.h"

namespace farhorizon {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

// Angles on the ground, counted from the direction of one edge.
class EdgeCompass {
 public:
  EdgeCompass(std::array<double, 2> along, const GroundStep& step)
      : step_(step), along_(along), ground_(step.ToGround(along[0], along[1])) {}

  [[nodiscard]] double length_m() const { return std::hypot(ground_[0], ground_[1]); }

  // True where azimuths rise as directions turn from columns to rows.
  [[nodiscard]] bool KeepsSense() const { return step_.SignedCellArea() < 0; }
  [[nodiscard]] double azimuth() const { return step_.ToAzimuth(along_[0], along_[1]); }

  // The angle from the edge's direction to `direction`, degrees, 0 to 180.
  [[nodiscard]] double Angle(const PlanVector& direction) const {
    const auto [dot, cross] = DotAndCross(direction);
    return HalfTurnAngle(dot, cross) * kDegrees;
  }

  [[nodiscard]] double Cosine(const PlanVector& direction) const {
    const auto [dot, cross] = DotAndCross(direction);
    return dot / std::hypot(dot, cross);
  }

 private:
  [[nodiscard]] std::array<double, 2> DotAndCross(const PlanVector& direction) const {
    const auto [x, y] = direction;
    const std::array<double, 2> ground = step_.ToGround(x, y);
    return {ground[0] * ground_[0] + ground[1] * ground_[1],
            std::abs(step_.SignedCellArea()) * (along_[0] * y - along_[1] * x)};
  }

  GroundStep step_;
  std::array<double, 2> along_;
  std::array<double, 2> ground_;
};

// To whole steps, outwards. Ends within a thousandth of a step of a whole one count as whole: the
// error of an angle is less, 2^-36 or 8.4e-10 degrees (lines_of_sight.h), and the step itself need
// not be spent on it.
Interval Outwards(const Interval& interval, double step) {
  constexpr double kSlack = 1e-3;
  const double from = std::floor(interval[0] / step + kSlack);
  const double to = std::max(std::ceil(interval[1] / step - kSlack), from + 1);
  return {from * step, to * step};
}

// Azimuths from angles, which are rising and disjoint. An interval that ends at 180 degrees and one
// that begins at 0 are one, because each line of sight stands for its opposite, too.
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
  // The last may reach the first, half a turn on.
  if (azimuths.size() > 1 && azimuths.back()[1] >= azimuths.front()[0] + 180) {
    azimuths.back()[1] = std::max(azimuths.back()[1], azimuths.front()[1] + 180);
    azimuths.erase(azimuths.begin());
  }
  if (azimuths.size() == 1 && azimuths[0][1] - azimuths[0][0] >= 180) return {{0, 180}};
  return azimuths;
}

// The integral of the sine of the angle over the cell: over t, of the difference of the cosines at
// both curves. By Gauss and Legendre's rule of eight nodes on each quarter of the range: exact for
// polynomials up to degree 15, and true to a millionth here (edge_measures_test.cpp).
double MeasureOf(const LineOfSightCell& cell, const EdgeCompass& compass) {
  if (!(cell.from < cell.to)) return 0;  // narrower than doubles tell
  constexpr std::array<double, 4> kNodes = {0.1834346424956498, 0.5255324099163290,
                                            0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> kWeights = {0.3626837833783620, 0.3137066458778873,
                                              0.2223810344533745, 0.1012285362903763};
  constexpr int kPieces = 4;
  const double half = (cell.to - cell.from) / (2 * kPieces);
  double sum = 0;
  for (int piece = 0; piece < kPieces; ++piece) {
    const double middle = cell.from + (2 * piece + 1) * half;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      for (const double t : {middle - half * kNodes[i], middle + half * kNodes[i]}) {
        sum += kWeights[i] * (compass.Cosine(cell.first.At(t)) - compass.Cosine(cell.last.At(t)));
      }
    }
  }
  return std::max(sum * half, 0.0);
}

}  // namespace

EdgeMeasures MeasuresOf(const LinesOfSight& sights, std::array<double, 2> along,
                        const GroundStep& step) {
  const EdgeCompass compass(along, step);
  EdgeMeasures measures;
  std::vector<Interval> angles;
  for (const LineOfSightCell& cell : sights) {
    const auto [first_from, first_to] = cell.first_ends;
    const auto [last_from, last_to] = cell.last_ends;
    angles.push_back({std::min(compass.Angle(first_from), compass.Angle(first_to)),
                      std::max(compass.Angle(last_from), compass.Angle(last_to))});
    measures.spans.push_back(Outwards({cell.from, cell.to}, kSpanStep));
    measures.line_measure_m += MeasureOf(cell, compass) * compass.length_m();
  }
  measures.spans = UnionOf(std::move(measures.spans));
  angles = UnionOf(std::move(angles));
  for (const Interval& angle : angles) measures.angular_share += (angle[1] - angle[0]) / 180;
  measures.azimuths = AzimuthsOf(angles, compass);
  return measures;
}

namespace {

// Sets the skyline drops of all edges, as far as the budget suffices.
Status WeighEdges(const Terrain& terrain, const Horizon& horizon, const MeasureOptions& options,
                  const RunControl& control, std::vector<EdgeMeasures>& measures) {
  const SkylineDrops drops(terrain, horizon, kSkylineDropStep / terrain.dem().quantum_m);
  const auto weigh = [&](std::span<const std::size_t> edges, std::int64_t limit) {
    BudgetedWork::Done done;
    for (const std::size_t i : edges) {
      const SkylineDrops::Drop drop = drops.Find(i, limit);
      done.spent += drop.spent;
      measures[i].drop = drop.quanta ? Known::kYes : Known::kNotAfforded;
      if (!drop.quanta) {
        done.open.push_back(i);
      } else {
        measures[i].skyline_drop_m = *drop.quanta * terrain.dem().quantum_m;
      }
    }
    return done;
  };
  const BudgetedWork work{.count = measures.size(),
                          .attempt = weigh,
                          .stage = Stage::kEdgeMeasures,
                          .what = "weighing " + std::to_string(measures.size()) + " horizon edges",
                          .restart = [&measures] {
                            for (EdgeMeasures& m : measures) m.drop = Known::kNotAfforded;
                          }};
  Result<std::vector<std::size_t>> open =
      WorkThrough(work, options.threads, options.budget, control);
  if (!open) return std::move(open.error());
  for (const std::size_t i : *open) measures[i].drop = Known::kNotAfforded;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    if (horizon.edges[i].undecided) measures[i].drop = Known::kNotAfforded;
  }
  return Ok{};
}

// Says what an approximate budget did not suffice for.
void WarnOfGaps(const Horizon& horizon, const std::vector<EdgeMeasures>& measures,
                const RunControl& control) {
  std::int64_t sights = 0;
  std::int64_t drops = 0;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    if (horizon.edges[i].undecided) continue;
    sights += measures[i].sights == Known::kNotAfforded ? 1 : 0;
    drops += measures[i].drop == Known::kNotAfforded ? 1 : 0;
  }
  if (sights + drops == 0) return;
  control.Warn("approximate: the work budget leaves " + std::to_string(sights) +
               " edges without their lines of sight and " + std::to_string(drops) +
               " without a skyline drop; these are null");
}

std::array<double, 2> MiddleOf(const Segment& edge) {
  return {(edge.a.x + edge.b.x) / 2.0, (edge.a.y + edge.b.y) / 2.0};
}

}  // namespace

Result<std::vector<EdgeMeasures>> MeasureEdges(const Terrain& terrain, const Horizon& horizon,
                                               const Georeference& georeference,
                                               const MeasureOptions& options,
                                               const RunControl& control) {
  if (options.weights == Weights::kNone) {
    control.Report(Stage::kLinesOfSight, 1);
    control.Report(Stage::kEdgeMeasures, 1);
    return std::vector<EdgeMeasures>(
        horizon.edges.size(), EdgeMeasures{.sights = Known::kNotAsked, .drop = Known::kNotAsked});
  }
  Result<std::vector<LinesOfSight>> sights =
      FindLinesOfSight(terrain, horizon, options.threads, options.budget, control);
  if (!sights) return std::move(sights.error());
  control.Report(Stage::kEdgeMeasures, 0);
  std::vector<Segment> edges;
  std::vector<std::array<double, 2>> middles;
  for (const HorizonEdge& e : horizon.edges) {
    edges.push_back({terrain.Point(e.edge.a), terrain.Point(e.edge.b)});
    middles.push_back(MiddleOf(edges.back()));
  }
  Result<std::vector<GroundStep>> steps = georeference.StepsAt(middles);
  if (!steps) return std::move(steps.error());
  std::vector<EdgeMeasures> measures(horizon.edges.size());
  const auto measure = [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [a, b] = edges[i];
      const std::array<double, 2> along = {static_cast<double>(b.x) - a.x,
                                           static_cast<double>(b.y) - a.y};
      measures[i] = MeasuresOf((*sights)[i], along, (*steps)[i]);
      if ((*sights)[i].empty()) measures[i].sights = Known::kNotAfforded;
      measures[i].drop = Known::kNotAsked;
      (*sights)[i] = {};
    }
  };
  constexpr double kSightsShare = 0.1;  // of the stage's time: what is found from lines of sight
  if (!ParallelForBatches(measures.size(), kBatch, options.threads, Stage::kEdgeMeasures,
                          control.Between(0, kSightsShare), measure)) {
    return Error{ErrorCode::kCancelled, "stopped while measuring horizon edges"};
  }
  if (options.weights == Weights::kFull) {
    Status weighed =
        WeighEdges(terrain, horizon, options, control.Between(kSightsShare, 1), measures);
    if (!weighed) return std::move(weighed.error());
  }
  WarnOfGaps(horizon, measures, control);
  control.Report(Stage::kEdgeMeasures, 1);
  return measures;
}

}  // namespace farhorizon
