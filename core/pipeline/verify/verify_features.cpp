// Features are checked from the DEM's heights alone: a witness by the ground along its line, the
// set by the terrain's own skyline on random lines. What needs the horizon found again is in
// verify_edges.cpp.
#include "core/pipeline/verify/verify_features.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <random>
#include <string>

#include "core/horizon/lines/highest_over_line.h"
#include "core/horizon/occluded_edges.h"
#include "core/horizon/witness.h"
#include "core/pipeline/verify/random_line.h"

namespace farhorizon {

namespace {

// The number of random lines over which the terrain is higher than the set of edges. Zero, where
// the set makes the terrain's skyline.
int LinesAboveTheSet(const Terrain& terrain, const std::vector<Segment>& set) {
  std::mt19937_64 random(20051);
  int above = 0;
  for (int i = 0; i < kRandomLines; ++i) {
    const PlanLine line = RandomLine(terrain.dem(), random);
    const std::optional<ExactHeight> ground = HighestOver(terrain, line);
    const std::optional<ExactHeight> found = HighestOver(set, line);
    above += (ground && (!found || Compare(*ground, *found) != 0)) ? 1 : 0;
  }
  return above;
}

}  // namespace

PublishedEdges VerifyFeatures(const TerrainInput& input,
                              const std::vector<HorizonFeature>& features,
                              const std::string& source, Claims& claims) {
  const Dem& dem = input.dem();
  PublishedEdges published;
  std::vector<VertexId> ends;
  std::int64_t misplaced = 0;
  std::int64_t unwitnessed = 0;
  std::vector<Edge> without_witness;
  std::vector<Segment> set;
  for (const HorizonFeature& f : features) {
    const auto inside = [&dem](const std::array<std::int32_t, 2>& p) {
      return p[0] >= 0 && p[0] < dem.columns && p[1] >= 0 && p[1] < dem.rows;
    };
    if (!inside(f.a) || !inside(f.b)) {
      ++misplaced;
      continue;
    }
    const Edge edge{f.a[1] * dem.columns + f.a[0], f.b[1] * dem.columns + f.b[0]};
    const bool has_witness = !f.undecided && f.witness.exact;
    const bool holds =
        edge.a < edge.b && (!has_witness || WitnessHolds(input.terrain(), edge, f.witness));
    unwitnessed += holds ? 0 : 1;
    if (!f.undecided && !f.witness.exact) without_witness.push_back(edge);
    published.undecided += f.undecided ? 1 : 0;
    published.edges.push_back(edge);
    published.level_kept.push_back(f.level_kept.value_or(-1));
    ends.push_back(edge.a);
    ends.push_back(edge.b);
    set.push_back({input.terrain().Point(edge.a), input.terrain().Point(edge.b)});
  }
  Result<std::vector<Geodetic>> points = input.georeference().ToGeodetic(ends);
  for (std::size_t i = 0; points && i < published.edges.size() && misplaced == 0; ++i) {
    // Some ten times what the decimals of the file round: 1e-9 degrees, 1e-4 metres.
    const auto near = [](const Geodetic& a, const Geodetic& b) {
      return std::abs(std::remainder(a.lon_deg - b.lon_deg, 360)) < 1e-8 &&
             std::abs(a.lat_deg - b.lat_deg) < 1e-8 && std::abs(a.height_m - b.height_m) < 1e-3;
    };
    const bool there =
        near((*points)[2 * i], features[i].from) && near((*points)[2 * i + 1], features[i].to);
    misplaced += there ? 0 : 1;
  }
  claims.Same(source + " edges that are not where their posts are", std::int64_t{0}, misplaced);
  claims.Same(source + " witnesses that meet higher ground", std::int64_t{0}, unwitnessed);
  claims.Same(source + " edges without a witness that no line of sight touches", std::int64_t{0},
              CountOccluded(input.terrain(), without_witness));
  claims.Same(
      std::to_string(kRandomLines) + " random lines of sight with ground above every horizon edge",
      0, LinesAboveTheSet(input.terrain(), set));
  return published;
}

void VerifySet(const std::vector<Edge>& claimed, const Horizon& horizon, Claims& claims) {
  std::vector<Edge> found;
  found.reserve(horizon.edges.size());
  for (const HorizonEdge& e : horizon.edges) found.push_back(e.edge);
  std::vector<Edge> sorted = claimed;
  std::sort(sorted.begin(), sorted.end());
  std::vector<Edge> missing;
  std::set_difference(found.begin(), found.end(), sorted.begin(), sorted.end(),
                      std::back_inserter(missing));
  std::vector<Edge> extra;
  std::set_difference(sorted.begin(), sorted.end(), found.begin(), found.end(),
                      std::back_inserter(extra));
  claims.Same("horizon edges missing from horizon.geojson", std::size_t{0}, missing.size());
  claims.Same("edges in horizon.geojson that are not on the horizon", std::size_t{0}, extra.size());
}

}  // namespace farhorizon
