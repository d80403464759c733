// A level from its files: the Draco streams of the GLB and of the .drc, decoded, compared with one
// another and with the GLB's own numbers; the mesh measured by the code that the build measures
// with, and compared with the report.
#include "core/pipeline/verify/verify_level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "core/io/file.h"
#include "core/io/glb.h"
#include "core/pipeline/mesh_orientation.h"
#include "core/pipeline/skirt.h"
#include "core/terrain/border.h"

namespace farhorizon {

namespace {

std::optional<std::vector<std::uint8_t>> Load(const std::filesystem::path& path, Claims& claims) {
  Result<std::string> text = ReadFile(path);
  if (!text) {
    claims.Add(false, path.filename().string() + ": " + text.error().message);
    return std::nullopt;
  }
  return std::vector<std::uint8_t>(text->begin(), text->end());
}

// A vertex that is not near any post of the DEM stands for none.
constexpr std::uint32_t kNoPost = std::numeric_limits<std::uint32_t>::max();

// Names the vertices of a mesh whose stream has no posts: each stands for the nearest one.
Status NamePosts(const LevelContext& context, LocalMesh& mesh) {
  const Dem& dem = context.terrain.dem();
  Result<std::vector<GridPoint>> points = context.georeference.ToGrid(mesh.positions);
  if (!points) return std::move(points.error());
  mesh.posts.clear();
  for (const GridPoint& p : *points) {
    const double column = std::nearbyint(p.column);
    const double row = std::nearbyint(p.row);
    const bool inside = column >= 0 && column < dem.columns && row >= 0 && row < dem.rows;
    mesh.posts.push_back(inside ? static_cast<std::uint32_t>(row * dem.columns + column) : kNoPost);
  }
  return Ok{};
}

std::optional<DecodedMesh> Decode(const std::string& name, const std::vector<std::uint8_t>& bytes,
                                  Claims& claims) {
  Result<DecodedMesh> decoded = DecodeDraco(bytes);
  claims.Add(decoded.has_value(),
             name + " decodes as Draco" + (decoded ? "" : ": " + decoded.error().message));
  if (!decoded) return std::nullopt;
  return *std::move(decoded);
}

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

void VerifyAccessors(const std::string& name, const GlbPrimitive& glb, const DecodedMesh& decoded,
                     Claims& claims) {
  const LocalMesh& mesh = decoded.mesh;
  claims.Same(name + " POSITION count", glb.vertex_count,
              static_cast<std::int64_t>(mesh.positions.size()));
  claims.Same(name + " NORMAL count", glb.normal_count,
              static_cast<std::int64_t>(mesh.normals.size()));
  claims.Same(name + " indices count", glb.index_count,
              static_cast<std::int64_t>(3 * mesh.triangles.size()));
  const LatticeBox box = LatticeBoxOf(mesh.positions, decoded.lattice);
  claims.Add(glb.min == box.least && glb.max == box.greatest,
             name + " POSITION min and max are those of the decoded mesh");
}

void VerifyMatrix(const std::string& name, const GlbContents& glb, const DecodedMesh& decoded,
                  Claims& claims) {
  claims.Add(glb.matrix == GltfMatrix(decoded.lattice),
             name + " has the lattice of its Draco stream in the node's matrix");
}

// Triangles by the places of their corners, each from its least one on, rising.
using Corner = std::array<double, 3>;
std::vector<std::array<Corner, 3>> CornersOf(const LocalMesh& mesh) {
  std::vector<std::array<Corner, 3>> result;
  result.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    std::array<Corner, 3>& corners = result.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Enu& p = mesh.positions[t[k]];
      corners[k] = {p.east, p.north, p.up};
    }
    std::ranges::rotate(corners, std::ranges::min_element(corners));
  }
  std::ranges::sort(result);
  return result;
}

// For each place its normal, rising.
std::vector<std::pair<Corner, UnitNormal>> NormalsByPlace(const LocalMesh& mesh) {
  std::vector<std::pair<Corner, UnitNormal>> result;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Enu& p = mesh.positions[i];
    result.push_back({{p.east, p.north, p.up}, mesh.normals[i]});
  }
  std::ranges::sort(result);
  const auto repeated = std::ranges::unique(result);
  result.erase(repeated.begin(), repeated.end());
  return result;
}

// A level's surface, as decoded, with posts.
struct LevelSurface {
  const LevelContext& context;
  const std::string& name;
  const LevelReport& claimed;
  const DecodedMesh& decoded;
};

// The skirt is the one that hangs from the surface's rim as deep as claimed: its tops are the rim's
// vertices bit for bit, and it is lit as they are.
void VerifySkirt(const LevelSurface& surface, const GlbContents& glb, Claims& claims) {
  const LevelReport& claimed = surface.claimed;
  const std::string name = surface.name + " skirt";
  claims.Add(glb.skirt.has_value() == (claimed.skirt_m > 0),
             name + " is there where the report has one");
  if (!glb.skirt || !(claimed.skirt_m > 0)) return;
  const std::optional<DecodedMesh> skirt = Decode(name, glb.skirt->draco, claims);
  if (!skirt) return;
  VerifyAccessors(name, *glb.skirt, *skirt, claims);
  claims.Add(skirt->lattice.origin == surface.decoded.lattice.origin &&
                 skirt->lattice.step_m == surface.decoded.lattice.step_m,
             name + " has the surface's lattice");
  claims.Same(name + " triangles", claimed.skirt_triangles,
              static_cast<std::int64_t>(skirt->mesh.triangles.size()));
  const LocalMesh due = SkirtOf(surface.decoded.mesh, surface.context.georeference.frame(),
                                surface.decoded.lattice, claimed.skirt_m);
  claims.Add(CornersOf(due) == CornersOf(skirt->mesh),
             name + " hangs from every edge of the rim, bit for bit, as deep as claimed");
  claims.Add(NormalsByPlace(due) == NormalsByPlace(skirt->mesh), name + " is lit as the rim is");
}

// Every decoded normal is the mean of the DEM's, as nearly as Draco's bits tell.
void VerifyNormals(const LevelContext& context, const std::string& name, const LocalMesh& mesh,
                   Claims& claims) {
  constexpr double kLeastCosine =
      0.99985;  // the cosine of a degree; rounding turns by half of that
  const std::vector<UnitNormal> normals = MeanNormals(context.terrain, context.normals, mesh);
  std::int64_t turned = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const UnitNormal& n = normals[i];
    const UnitNormal& m = mesh.normals[i];
    const bool near = m[2] > 0 && n[0] * m[0] + n[1] * m[1] + n[2] * m[2] > kLeastCosine;
    turned += near ? 0 : 1;
  }
  claims.Same(name + " normals a degree or more off the DEM's", std::int64_t{0}, turned);
}

// The mesh of the GLB, with posts.
std::optional<StoredLevel> LoadGlb(const LevelContext& context,
                                   const std::filesystem::path& directory,
                                   const LevelReport& claimed, Claims& claims) {
  const std::string name = "lod" + std::to_string(claimed.level) + ".glb";
  const auto bytes = Load(directory / name, claims);
  if (!bytes) return std::nullopt;
  claims.Same(name + " bytes", claimed.glb_bytes, static_cast<std::int64_t>(bytes->size()));
  Result<GlbContents> glb = ReadGlb(*bytes);
  claims.Add(glb.has_value(), name + " is a binary glTF with a Draco mesh" +
                                  (glb ? "" : ": " + glb.error().message));
  if (!glb) return std::nullopt;
  std::optional<DecodedMesh> decoded = Decode(name, glb->surface.draco, claims);
  if (!decoded) return std::nullopt;
  VerifyAccessors(name, glb->surface, *decoded, claims);
  VerifyMatrix(name, *glb, *decoded, claims);
  Status named = NamePosts(context, decoded->mesh);
  if (!named) claims.Add(false, name + ": " + named.error().message);
  if (!named) return std::nullopt;
  VerifySkirt({context, name, claimed, *decoded}, *glb, claims);
  return StoredLevel{*std::move(decoded), {}, std::move(glb->edges)};
}

std::optional<DecodedMesh> LoadDrc(const std::filesystem::path& directory,
                                   const LevelReport& claimed, Claims& claims) {
  const std::string name = "lod" + std::to_string(claimed.level) + ".drc";
  const auto bytes = Load(directory / name, claims);
  if (!bytes) return std::nullopt;
  claims.Same(name + " bytes", claimed.drc_bytes, static_cast<std::int64_t>(bytes->size()));
  std::optional<DecodedMesh> decoded = Decode(name, *bytes, claims);
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
  if (claimed.glb_bytes > 0) glb = LoadGlb(context, directory, claimed, claims);
  if (claimed.drc_bytes > 0) drc = LoadDrc(directory, claimed, claims);
  if (glb && drc) {
    claims.Add(ContentsOf(glb->decoded.mesh) == ContentsOf(drc->mesh),
               "lod" + std::to_string(claimed.level) + ".glb and .drc hold the same mesh");
  }
  if (!glb && drc) glb = StoredLevel{*std::move(drc), {}, {}};
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
  VerifyNormals(context, name, mesh, claims);
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
