// One level from posts to bytes and back: positions in the local frame, Draco, GLB; then the bytes
// are decoded again and measured against the DEM, so that the report holds for what is stored,
// rounding included.
#include "core/pipeline/level_artifact.h"

#include <algorithm>
#include <utility>

#include "core/io/draco_mesh.h"
#include "core/io/glb.h"
#include "core/pipeline/geometric_error.h"

namespace farhorizon {

namespace {

Result<LocalMesh> ToLocal(const LevelContext& context, const PostMesh& mesh) {
  const std::vector<VertexId>& posts = mesh.posts;
  std::vector<GridPoint> points;
  points.reserve(posts.size());
  for (std::size_t i = 0; i < posts.size(); ++i) {
    const Dem& dem = context.terrain.dem();
    points.push_back({static_cast<double>(dem.Column(posts[i])),
                      static_cast<double>(dem.Row(posts[i])), mesh.heights_m[i]});
  }
  Result<std::vector<Geodetic>> geodetic = context.georeference.ToGeodetic(points);
  if (!geodetic) return std::move(geodetic.error());
  Result<std::vector<Enu>> positions = context.georeference.ToEnu(*geodetic);
  if (!positions) return std::move(positions.error());
  LocalMesh local;
  local.positions = *std::move(positions);
  local.posts.assign(posts.begin(), posts.end());
  const auto index = [&posts](VertexId v) {
    return static_cast<std::uint32_t>(std::lower_bound(posts.begin(), posts.end(), v) -
                                      posts.begin());
  };
  const bool keeps = context.georeference.KeepsOrientation();
  local.triangles.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    local.triangles.push_back({index(t[0]), index(t[keeps ? 1 : 2]), index(t[keeps ? 2 : 1])});
  }
  local.normals = MeanNormals(context.terrain, context.normals, local);
  return local;
}

// The level's kept horizon edges as pairs of vertices of the decoded mesh; of a post with several
// vertices the first.
std::vector<std::pair<std::uint32_t, std::uint32_t>> KeptInDecoded(const Horizon& horizon,
                                                                   const Lod& lod,
                                                                   const LocalMesh& decoded) {
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> by_post = VerticesByPost(decoded);
  const auto find = [&by_post](VertexId v) {
    const auto at = std::lower_bound(by_post.begin(), by_post.end(),
                                     std::pair(static_cast<std::uint32_t>(v), std::uint32_t{0}));
    Check(at != by_post.end() && at->first == static_cast<std::uint32_t>(v),
          "the posts of a kept edge are in the mesh");
    return at->second;
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const std::int32_t i : lod.kept) {
    const Edge edge = horizon.edges[static_cast<std::size_t>(i)].edge;
    pairs.emplace_back(find(edge.a), find(edge.b));
  }
  return pairs;
}

}  // namespace

// The share of Stage::kMeasure that MeasureMeshError takes; the rest is MeasureGeometricError's.
constexpr double kMeshErrorShare = 0.95;

Result<LevelReport> MeasureLevel(const LevelContext& context, const LocalMesh& decoded, int level,
                                 double step_m) {
  const VertexId post_count = context.terrain.post_count();
  GridMesh grid;
  std::vector<VertexId> posts;
  for (const std::uint32_t post : decoded.posts) {
    if (post >= static_cast<std::uint32_t>(post_count) ||
        !context.terrain.dem().HasData(static_cast<VertexId>(post))) {
      return Error{ErrorCode::kUnsupportedData,
                   "a vertex names post " + std::to_string(post) + ", which the DEM does not have",
                   "bad-mesh"};
    }
    posts.push_back(static_cast<VertexId>(post));
  }
  Result<std::vector<GridPoint>> points = context.georeference.ToGrid(decoded.positions);
  if (!points) return std::move(points.error());
  grid.points = *std::move(points);
  const bool keeps = context.georeference.KeepsOrientation();
  for (const auto& t : decoded.triangles) {
    grid.triangles.push_back({static_cast<std::int32_t>(t[0]),
                              static_cast<std::int32_t>(t[keeps ? 1 : 2]),
                              static_cast<std::int32_t>(t[keeps ? 2 : 1])});
  }
  Result<MeshError> error = MeasureMeshError(context.terrain, context.horizon, grid, posts, step_m,
                                             context.control.Between(0, kMeshErrorShare));
  if (!error) return std::move(error.error());
  Result<double> geometric = MeasureGeometricError(context.terrain, context.georeference, decoded);
  if (!geometric) return std::move(geometric.error());
  context.control.Report(Stage::kMeasure, 1);
  LevelReport report;
  report.level = level;
  report.triangles = static_cast<std::int64_t>(decoded.triangles.size());
  report.vertices = static_cast<std::int64_t>(decoded.positions.size());
  report.vertical = {RoundUp(error->vertical.max_m), RoundUp(error->vertical.rms_m)};
  report.silhouette = {RoundUp(error->silhouette.max_m), RoundUp(error->silhouette.rms_m)};
  report.geometric_error_m = RoundUp(*geometric);
  report.quantization_step_m = step_m;
  return report;
}

Result<LevelArtifact> EncodeLevel(const LevelContext& context, const Lod& lod, int level,
                                  double step_m) {
  context.control.Report(Stage::kEncode, 0);
  Result<LocalMesh> local = ToLocal(context, lod.mesh);
  if (!local) return std::move(local.error());
  const QuantizationLattice lattice = ChooseLattice(local->positions, step_m);
  LevelArtifact artifact;
  Result<std::vector<std::uint8_t>> drc = EncodeDraco(*local, lattice);
  if (!drc) return std::move(drc.error());
  artifact.drc = *std::move(drc);
  Result<DecodedMesh> decoded = DecodeDraco(artifact.drc);
  if (!decoded) return std::move(decoded.error());
  artifact.glb =
      WriteGlb(artifact.drc, *decoded, KeptInDecoded(context.horizon, lod, decoded->mesh));
  context.control.Report(Stage::kEncode, 1);
  Result<LevelReport> report = MeasureLevel(context, decoded->mesh, level, lattice.step_m);
  if (!report) {
    return std::move(report.error()).WithContext("level " + std::to_string(level));
  }
  artifact.report = *std::move(report);
  artifact.report.exact = lod.exact;
  artifact.report.horizon_edges = static_cast<std::int64_t>(lod.kept.size());
  artifact.report.glb_bytes = static_cast<std::int64_t>(artifact.glb.size());
  artifact.report.drc_bytes = static_cast<std::int64_t>(artifact.drc.size());
  artifact.mesh = std::move(decoded->mesh);
  return artifact;
}

}  // namespace farhorizon
