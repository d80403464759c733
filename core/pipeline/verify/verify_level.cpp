// A level from its files: the Draco streams of its GLBs (verify_glbs) and of the .drc, decoded and
// compared with one another; the mesh measured by the code that the build measures with, and
// compared with the report.
#include "core/pipeline/verify/verify_level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "core/geo/ellipsoid_normal.h"
#include "core/pipeline/mesh_orientation.h"
#include "core/pipeline/verify/stored_mesh.h"
#include "core/pipeline/verify/verify_glbs.h"
#include "core/terrain/border.h"

namespace farhorizon {

namespace {

// Triangles by post, each from its least one on, and the places of all posts: what two streams of
// one mesh share, whatever their order.
struct MeshContents {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::tuple<std::uint32_t, double, double, double>> places;
  friend bool operator==(const MeshContents&, const MeshContents&) = default;
};

MeshContents ContentsOf(const LocalMesh& mesh) {
  MeshContents contents;
  for (const auto& t : mesh.triangles) {
    auto& posts = contents.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) posts[k] = mesh.posts[t[k]];
    std::ranges::rotate(posts, std::ranges::min_element(posts));
  }
  for (std::size_t i = 0; i < mesh.posts.size(); ++i) {
    const Enu& p = mesh.positions[i];
    contents.places.emplace_back(mesh.posts[i], p.east, p.north, p.up);
  }
  std::ranges::sort(contents.triangles);
  std::ranges::sort(contents.places);
  const auto repeated = std::ranges::unique(contents.places);
  contents.places.erase(repeated.begin(), repeated.end());
  return contents;
}

// Every decoded normal is the mean of the DEM's, as nearly as Draco's bits tell.
void VerifyNormals(const LevelContext& context, const LevelReport& claimed, const LocalMesh& mesh,
                   Claims& claims) {
  const std::string name = "lod" + std::to_string(claimed.level);
  const int most = std::max(context.normals.apron - 1, 0);
  const bool within = claimed.seam_reach >= 0 && claimed.seam_reach <= most;
  claims.Add(within, name + " seam_reach is within the apron");
  if (!within) return;
  constexpr double kLeastCosine =
      0.99985;  // the cosine of a degree; rounding turns by half of that
  const std::vector<UnitNormal> normals = MeanNormals(context.terrain, context.georeference.frame(),
                                                      context.normals, mesh, claimed.seam_reach);
  std::int64_t turned = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const UnitNormal& n = normals[i];
    const UnitNormal& m = mesh.normals[i];
    const Enu up = EllipsoidNormal(mesh.positions[i], context.georeference.frame());
    const bool upwards = m[0] * up.east + m[1] * up.north + m[2] * up.up > 0;
    const bool near = upwards && n[0] * m[0] + n[1] * m[1] + n[2] * m[2] > kLeastCosine;
    turned += near ? 0 : 1;
  }
  claims.Same(name + " normals a degree or more off the DEM's", std::int64_t{0}, turned);
}

std::optional<DecodedMesh> LoadDrc(const std::filesystem::path& directory,
                                   const LevelReport& claimed, Claims& claims) {
  const std::string name = "lod" + std::to_string(claimed.level) + ".drc";
  const auto bytes = LoadBytes(directory / name, claims);
  if (!bytes) return std::nullopt;
  claims.Same(name + " bytes", claimed.drc_bytes, static_cast<std::int64_t>(bytes->size()));
  std::optional<DecodedMesh> decoded = DecodeStored(name, *bytes, claims);
  if (!decoded) return std::nullopt;
  const bool posts = !decoded->mesh.posts.empty();
  claims.Add(posts, name + " has its vertices' posts");
  return posts ? decoded : std::nullopt;
}

// The mesh of the level's files.
std::optional<StoredLevel> LoadMesh(const LevelContext& context,
                                    const std::filesystem::path& directory,
                                    const LevelReport& claimed, Claims& claims) {
  std::optional<StoredLevel> glb;
  std::optional<DecodedMesh> drc;
  if (claimed.glb_bytes > 0) glb = LoadGlbs(context, directory, claimed, claims);
  if (claimed.drc_bytes > 0) drc = LoadDrc(directory, claimed, claims);
  if (glb && drc) {
    claims.Add(ContentsOf(glb->decoded.mesh) == ContentsOf(drc->mesh),
               "lod" + std::to_string(claimed.level) + ".glb and .drc hold the same mesh");
  }
  if (!glb && drc) glb = StoredLevel{*std::move(drc), {}, {}, {}};
  return glb;
}

// Vertices on the tile's sides lie where a neighbour's do.
void VerifySides(const LevelContext& context, const std::string& name, const LocalMesh& mesh,
                 double step_m, Claims& claims) {
  std::int64_t off = 0;
  for (std::size_t i = 0; i < mesh.posts.size(); ++i) {
    const auto post = static_cast<VertexId>(mesh.posts[i]);
    if (mesh.posts[i] == kNoPost || !OnSide(context.terrain.dem(), post)) continue;
    const Enu& p = mesh.positions[i];
    for (const double x : {p.east, p.north, p.up}) off += std::fmod(x, step_m) == 0 ? 0 : 1;
  }
  claims.Same(name + " coordinates on sides that are no multiple of side_step_m", std::int64_t{0},
              off);
}

// What is counted and measured of a decoded mesh, which is placed for that.
Result<LevelReport> MeasureLevel(const LevelContext& context, StoredLevel& level) {
  const LocalMesh& mesh = level.decoded.mesh;
  Result<PlacedMesh> placed = PlaceLevel(context, mesh);
  if (!placed) return std::move(placed.error());
  level.placed = *std::move(placed);
  Result<MeshError> error = context.measurer.Measure(level.placed, context.control);
  if (!error) return std::move(error.error());
  LevelReport found;
  found.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  found.vertices = static_cast<std::int64_t>(mesh.positions.size());
  ReportErrors(*error, found);
  return found;
}

}  // namespace

std::vector<Edge> EdgesByPost(const LocalMesh& mesh) {
  std::vector<Edge> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.push_back(MakeEdge(static_cast<VertexId>(mesh.posts[t[k]]),
                               static_cast<VertexId>(mesh.posts[t[(k + 1) % 3]])));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::optional<StoredLevel> VerifyLevel(const LevelContext& context,
                                       const std::filesystem::path& directory,
                                       const LevelReport& claimed, Claims& claims) {
  const std::string name = "lod" + std::to_string(claimed.level);
  std::optional<StoredLevel> level = LoadMesh(context, directory, claimed, claims);
  if (!level) {
    claims.Add(false, name + ": no mesh to measure");
    return std::nullopt;
  }
  const LocalMesh& mesh = level->decoded.mesh;
  claims.Same(name + " lattice's step, metres", claimed.quantization_step_m,
              level->decoded.lattice.step_m);
  VerifySides(context, name, mesh, claimed.side_step_m, claims);
  claims.Add(AllTurnLeft(mesh, context.georeference.frame()),
             name + ": no triangle is flipped or without area");
  Result<LevelReport> found = MeasureLevel(context, *level);
  claims.Add(found.has_value(),
             name + " covers the DEM without cracks" + (found ? "" : ": " + found.error().message));
  if (!found) return std::nullopt;
  VerifyNormals(context, claimed, mesh, claims);
  claims.Same(name + " triangles", claimed.triangles, found->triangles);
  claims.Same(name + " vertices", claimed.vertices, found->vertices);
  claims.AtMost(name + " vertical error, max", claimed.vertical.max_m, found->vertical.max_m);
  claims.AtMost(name + " vertical error, rms", claimed.vertical.rms_m, found->vertical.rms_m);
  claims.AtMost(name + " silhouette error, max", claimed.silhouette.max_m, found->silhouette.max_m);
  claims.AtMost(name + " silhouette error, rms", claimed.silhouette.rms_m, found->silhouette.rms_m);
  claims.AtMost(name + " silhouette error, rim", claimed.rim_m, found->rim_m);
  claims.AtMost(name + " angle of facets, rms", claimed.facet_angle_deg, found->facet_angle_deg,
                "degrees");
  claims.AtMost(name + " needles", claimed.needle_share, found->needle_share, "of the triangles");
  claims.AtMost(name + " geometric error", claimed.geometric_error_m, found->geometric_error_m);
  return level;
}

}  // namespace farhorizon
