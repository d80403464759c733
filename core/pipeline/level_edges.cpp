// The DEM's horizon edges that the level has are known; the mesh is asked for what else its skyline
// needs. Edges go by posts, which every vertex has one of: Draco may split a vertex between its
// fans of triangles, and all parts have one place.
#include "core/pipeline/level_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/measure/own_skyline.h"
#include "core/measure/welded_mesh.h"
#include "core/pipeline/level_artifact.h"

namespace farhorizon {

namespace {

// The first vertex of each post.
class FirstVertices {
 public:
  explicit FirstVertices(const LocalMesh& mesh) : by_post_(VerticesByPost(mesh)) {}

  [[nodiscard]] std::uint32_t Of(VertexId post) const {
    const auto number = static_cast<std::uint32_t>(post);
    const auto at =
        std::lower_bound(by_post_.begin(), by_post_.end(), std::pair(number, std::uint32_t{0}));
    Check(at != by_post_.end() && at->first == number, "the posts of a kept edge are in the mesh");
    return at->second;
  }

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_post_;
};

// The azimuths of the grid's directions that `directions` stands for (SkylineSide), whole bits of
// both, so that no azimuth of those that were seen is left out.
AzimuthMask MaskOfDirections(std::uint64_t directions, const GroundStep& step) {
  AzimuthMask mask = 0;
  const auto azimuth = [&step](int i) {
    const double t = std::numbers::pi * i / kAzimuthBins;
    return step.ToAzimuth(std::cos(t), std::sin(t));
  };
  for (int i = 0; i < kAzimuthBins; ++i) {
    if ((directions >> static_cast<unsigned>(i) & 1U) == 0) continue;
    const double from = azimuth(i);
    // A bin is far less than half a turn: the way from one end to the other is the short one.
    const double turn = std::remainder(azimuth(i + 1) - from, 360);
    mask |= MaskOfInterval(std::min(from, from + turn), std::max(from, from + turn));
  }
  return mask;
}

std::array<float, 3> NumbersOf(const Enu& position, const QuantizationLattice& lattice) {
  const std::array<double, 3> numbers = LatticeNumbers(position, lattice);
  return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]),
          static_cast<float>(numbers[2])};
}

}  // namespace

std::string HorizonGlbName(int level) { return "lod" + std::to_string(level) + "-horizon.glb"; }

Result<LevelEdges> FindLevelEdges(const LevelContext& context,
                                  const std::vector<std::int32_t>& kept, const DecodedLevel& level,
                                  int threads) {
  Result<PlacedMesh> welded = WeldedMesh(level.placed);
  if (!welded) return std::move(welded.error());
  const LocalMesh& decoded = level.decoded.mesh;
  const QuantizationLattice& lattice = level.decoded.lattice;
  const FirstVertices first(decoded);
  // Pairs of vertices, the lower one first.
  std::map<std::array<std::int32_t, 2>, std::int32_t> places;
  std::vector<std::array<std::int32_t, 2>> known;
  for (const std::int32_t i : kept) {
    const Edge edge = context.horizon.edges[static_cast<std::size_t>(i)].edge;
    const auto a = static_cast<std::int32_t>(first.Of(edge.a));
    const auto b = static_cast<std::int32_t>(first.Of(edge.b));
    known.push_back({std::min(a, b), std::max(a, b)});
    places.emplace(known.back(), i);
  }
  Result<OwnSkyline> skyline = FindOwnSkyline(welded->grid, known, threads, context.control);
  if (!skyline) return std::move(skyline.error());

  LevelEdges edges;
  edges.lattice = lattice;
  std::vector<std::array<double, 2>> middles;
  const Dem& dem = context.terrain.dem();
  for (const SkylineSide& side : skyline->sides) {
    auto a = static_cast<std::uint32_t>(side.a);
    auto b = static_cast<std::uint32_t>(side.b);
    if (decoded.posts[a] > decoded.posts[b]) std::swap(a, b);
    HorizonLine& line = edges.lines.emplace_back();
    line.ends = {NumbersOf(decoded.positions[a], lattice),
                 NumbersOf(decoded.positions[b], lattice)};
    edges.vertices.emplace_back(a, b);
    const auto place = places.find({side.a, side.b});
    edges.horizon_edges.push_back(place == places.end() ? -1 : place->second);
    const auto p = static_cast<VertexId>(decoded.posts[a]);
    const auto q = static_cast<VertexId>(decoded.posts[b]);
    middles.push_back({(dem.Column(p) + dem.Column(q)) / 2.0, (dem.Row(p) + dem.Row(q)) / 2.0});
    edges.report.carrying += side.lines > 0 ? 1 : 0;
  }
  Result<std::vector<GroundStep>> steps = context.georeference.StepsAt(middles);
  if (!steps) return std::move(steps.error());
  for (std::size_t i = 0; i < edges.lines.size(); ++i) {
    edges.lines[i].azimuths = MaskOfDirections(skyline->sides[i].directions, (*steps)[i]);
  }
  edges.report.edges = std::ssize(edges.lines);
  edges.report.share = 1 - RoundUp(skyline->missed_share);
  return edges;
}

void AddMeasures(const std::vector<HorizonFeature>& features, LevelEdges& edges) {
  for (std::size_t i = 0; i < edges.lines.size(); ++i) {
    if (edges.horizon_edges[i] < 0) continue;
    const HorizonFeature& feature = features[static_cast<std::size_t>(edges.horizon_edges[i])];
    if (feature.undecided) continue;
    const EdgeMeasures& measures = feature.measures;
    HorizonLine& line = edges.lines[i];
    if (measures.sights == Known::kYes) {
      line.azimuths |= MaskOf(measures.azimuths);
      line.line_measure_m = static_cast<float>(measures.line_measure_m);
    }
    if (measures.drop == Known::kYes) {
      line.skyline_drop_m = static_cast<float>(measures.skyline_drop_m);
    }
  }
}

}  // namespace farhorizon
