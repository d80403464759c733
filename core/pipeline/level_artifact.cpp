// One level from posts to bytes and back: positions in the local frame, Draco, GLB; then the bytes
// are decoded again, and what they decode to is measured against the DEM, so that the report holds
// for what is stored, rounding included.
#include "core/pipeline/level_artifact.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/io/draco_mesh.h"
#include "core/io/edge_visibility.h"
#include "core/io/glb.h"
#include "core/measure/covers.h"
#include "core/pipeline/level_lattice.h"
#include "core/pipeline/skirt.h"

namespace farhorizon {

namespace {

Result<LocalMesh> ToLocal(const LevelContext& context, const PostMesh& mesh, int seam_reach) {
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
  local.normals = MeanNormals(context.terrain, context.georeference.frame(), context.normals, local,
                              seam_reach);
  return local;
}

// Gives the vertices of `decoded`, whose stream has no posts, those of the vertices of `mesh` at
// the same place. Where no triangle is flat, no two posts share a place.
void NamePosts(const LocalMesh& mesh, LocalMesh& decoded) {
  using Place = std::array<double, 3>;
  const auto place = [](const Enu& p) -> Place { return {p.east, p.north, p.up}; };
  std::vector<std::pair<Place, std::uint32_t>> posts;
  posts.reserve(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    posts.emplace_back(place(mesh.positions[i]), mesh.posts[i]);
  }
  std::sort(posts.begin(), posts.end());
  decoded.posts.reserve(decoded.positions.size());
  for (const Enu& p : decoded.positions) {
    const auto at =
        std::lower_bound(posts.begin(), posts.end(), std::pair(place(p), std::uint32_t{0}));
    Check(at != posts.end() && at->first == place(p),
          "Draco gives lattice positions back as they are");
    decoded.posts.push_back(at->second);
  }
}

// The streams of a level. decoded: what is in the files, with posts.
struct Encoded {
  std::vector<EncodedPart> parts;
  std::vector<std::uint8_t> drc;
  DecodedMesh decoded;
};

// Encodes the parts and puts what they decode to together again.
Status EncodeParts(const LocalMesh& mesh, const QuantizationLattice& lattice,
                   std::vector<MeshPart> parts, Encoded& encoded) {
  std::vector<LocalMesh> decoded;
  for (const MeshPart& part : parts) {
    Result<std::vector<std::uint8_t>> stream =
        EncodeDraco(part.mesh, lattice, DracoPosts::kLeftOut);
    if (!stream) return std::move(stream.error());
    Result<DecodedMesh> contents = DecodeDraco(*stream);
    if (!contents) return std::move(contents.error());
    NamePosts(mesh, contents->mesh);
    encoded.parts.push_back({part.place, *std::move(stream), contents->mesh.triangles.size()});
    decoded.push_back(std::move(contents->mesh));
  }
  encoded.decoded.mesh = decoded.size() == 1 ? std::move(decoded.front()) : JoinMeshes(decoded);
  encoded.decoded.lattice = lattice;
  return Ok{};
}

// Requires: mesh.positions lie on the lattice.
Result<Encoded> Encode(const LevelContext& context, const LocalMesh& mesh,
                       const QuantizationLattice& lattice, const LevelStorage& storage,
                       const PartDepth& depth) {
  Encoded encoded;
  if (storage.drc) {
    Result<std::vector<std::uint8_t>> drc = EncodeDraco(mesh, lattice, DracoPosts::kWritten);
    if (!drc) return std::move(drc.error());
    encoded.drc = *std::move(drc);
  }
  // Levels are measured even where no file of theirs is asked for.
  Status parts =
      EncodeParts(mesh, lattice, CutIntoParts(mesh, context.terrain.dem(), depth), encoded);
  if (!parts) return std::move(parts.error());
  return encoded;
}

Result<EncodedMesh> EncodeSkirt(const LevelContext& context, const DecodedMesh& surface,
                                double skirt_m) {
  const LocalMesh skirt =
      SkirtOf(surface.mesh, context.georeference.frame(), surface.lattice, skirt_m);
  Result<std::vector<std::uint8_t>> stream =
      EncodeDraco(skirt, surface.lattice, DracoPosts::kLeftOut);
  if (!stream) return std::move(stream.error());
  Result<DecodedMesh> decoded = DecodeDraco(*stream);
  if (!decoded) return std::move(decoded.error());
  return EncodedMesh{*std::move(stream), *std::move(decoded)};
}

}  // namespace

Result<PlacedMesh> PlaceLevel(const LevelContext& context, const LocalMesh& decoded) {
  const VertexId post_count = context.terrain.post_count();
  PlacedMesh mesh;
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
  mesh.grid.points = *std::move(points);
  mesh.straight.reserve(decoded.positions.size());
  for (const Enu& p : decoded.positions) mesh.straight.push_back({p.east, p.north, p.up});
  const bool keeps = context.georeference.KeepsOrientation();
  for (const auto& t : decoded.triangles) {
    mesh.grid.triangles.push_back({static_cast<std::int32_t>(t[0]),
                                   static_cast<std::int32_t>(t[keeps ? 1 : 2]),
                                   static_cast<std::int32_t>(t[keeps ? 2 : 1])});
  }
  Status covers = CheckCovers(context.terrain, mesh.grid, posts);
  if (!covers) return std::move(covers.error());
  return mesh;
}

void ReportErrors(const MeshError& error, LevelReport& report) {
  report.vertical = {RoundUp(error.vertical.max_m), RoundUp(error.vertical.rms_m)};
  report.silhouette = {RoundUp(error.silhouette.max_m), RoundUp(error.silhouette.rms_m)};
  report.rim_m = RoundUp(error.rim_m);
  report.facet_angle_deg = RoundUp(error.facet_angle_rms_deg);
  report.needle_share = RoundUp(error.needle_share);
  report.geometric_error_m = report.vertical.max_m;
}

Result<LevelArtifact> EncodeLevel(const LevelContext& context, const Lod& lod, int level,
                                  const LevelStorage& storage) {
  context.control.Report(Stage::kEncode, 0);
  const int seam_reach = SeamReach(context.normals.apron, storage.coarseness);
  Result<LocalMesh> local = ToLocal(context, lod.mesh, seam_reach);
  if (!local) return std::move(local.error());
  LatticeSteps steps =
      StepsOfLevel(storage.finest_side_m, context.georeference, lod, storage.coarseness);
  Result<QuantizationLattice> lattice = RoundToLattice(
      context.terrain.dem(), context.georeference.frame(), steps, *local, storage.skirt_room_m);
  if (!lattice) return std::move(lattice.error()).WithContext("level " + std::to_string(level));
  const PartDepth depth = storage.glb ? lod.parts : PartDepth{};
  Result<Encoded> encoded = Encode(context, *local, *lattice, storage, depth);
  if (!encoded) return std::move(encoded.error());
  LevelArtifact artifact;
  if (storage.glb) artifact.parts = std::move(encoded->parts);
  artifact.drc = std::move(encoded->drc);
  context.control.Report(Stage::kEncode, 1);
  const LocalMesh& mesh = encoded->decoded.mesh;
  artifact.report.level = level;
  artifact.report.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  artifact.report.vertices = static_cast<std::int64_t>(mesh.positions.size());
  artifact.report.quantization_step_m = lattice->step_m;
  artifact.report.exact = lod.exact;
  artifact.report.side_step_m = steps.sides_m;
  artifact.report.seam_reach = seam_reach;
  artifact.report.horizon_edges = static_cast<std::int64_t>(lod.kept.size());
  artifact.report.parts = depth;
  artifact.report.drc_bytes = static_cast<std::int64_t>(artifact.drc.size());
  artifact.decoded = std::move(encoded->decoded);
  return artifact;
}

Result<std::vector<PartGlb>> LevelGlbs(const LevelContext& context, double skirt_m,
                                       LevelArtifact& level) {
  std::vector<std::size_t> counts;
  for (const EncodedPart& part : level.parts) counts.push_back(part.triangles);
  const std::vector<EdgeVisibility> flags =
      SplitEdges(FlagEdges(level.decoded.mesh, level.flagged), counts);
  LevelReport& report = level.report;
  report.skirt_m = skirt_m;
  std::vector<PartGlb> glbs;
  for (std::size_t i = 0; i < level.parts.size(); ++i) {
    const EncodedPart& part = level.parts[i];
    Result<DecodedMesh> surface = DecodeDraco(part.draco);
    if (!surface) return std::move(surface.error());
    NamePosts(level.decoded.mesh, surface->mesh);
    surface->lattice = level.decoded.lattice;
    std::optional<EncodedMesh> walls;
    if (skirt_m > 0) {
      Result<EncodedMesh> encoded = EncodeSkirt(context, *surface, skirt_m);
      if (!encoded) return std::move(encoded.error());
      walls = *std::move(encoded);
    }
    PartGlb glb = {PartGlbName(report.level, report.parts, part.place),
                   WriteGlb(part.draco, *surface, flags[i], walls ? &*walls : nullptr),
                   std::move(surface->mesh),
                   {}};
    if (walls) glb.skirt = std::move(walls->decoded.mesh);
    report.glb_bytes += static_cast<std::int64_t>(glb.bytes.size());
    report.skirt_triangles += static_cast<std::int64_t>(glb.skirt.triangles.size());
    glbs.push_back(std::move(glb));
  }
  return glbs;
}

}  // namespace farhorizon
