// A level's GLBs: their numbers against their Draco streams, skirts against rims; and surfaces put
// together again.
#include "core/pipeline/verify/verify_glbs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/io/glb.h"
#include "core/pipeline/skirt.h"
#include "core/pipeline/verify/stored_mesh.h"

namespace farhorizon {

namespace {

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

// The surface of a GLB, as decoded, with posts.
struct PartSurface {
  const LevelContext& context;
  const std::string& name;
  const LevelReport& claimed;
  const DecodedMesh& decoded;
};

// The skirt is the one that hangs from the surface's rim as deep as claimed: its tops are the rim's
// vertices bit for bit, and it is lit as they are. Returns it.
LocalMesh VerifySkirt(const PartSurface& surface, const GlbContents& glb, Claims& claims) {
  const LevelReport& claimed = surface.claimed;
  const std::string name = surface.name + " skirt";
  claims.Add(glb.skirt.has_value() == (claimed.skirt_m > 0),
             name + " is there where the report has one");
  if (!glb.skirt || !(claimed.skirt_m > 0)) return {};
  std::optional<DecodedMesh> skirt = DecodeStored(name, glb.skirt->draco, claims);
  if (!skirt) return {};
  VerifyAccessors(name, *glb.skirt, *skirt, claims);
  claims.Add(skirt->lattice.origin == surface.decoded.lattice.origin &&
                 skirt->lattice.step_m == surface.decoded.lattice.step_m,
             name + " has the surface's lattice");
  const LocalMesh due = SkirtOf(surface.decoded.mesh, surface.context.georeference.frame(),
                                surface.decoded.lattice, claimed.skirt_m);
  claims.Add(CornersOf(due) == CornersOf(skirt->mesh),
             name + " hangs from every edge of the rim, bit for bit, as deep as claimed");
  claims.Add(NormalsByPlace(due) == NormalsByPlace(skirt->mesh), name + " is lit as the rim is");
  return std::move(skirt->mesh);
}

// What the GLBs hold together.
struct Contents {
  std::vector<TileContentRegion> regions;
  std::vector<LocalMesh> surfaces;
  std::vector<EdgeVisibility> edges;
  std::vector<std::size_t> triangles;
  QuantizationLattice lattice;
  std::int64_t bytes = 0;
  std::int64_t skirt_triangles = 0;
};

// Adds the GLB of a part; false where its mesh cannot be had.
bool Add(const LevelContext& context, const std::filesystem::path& file, const PartPlace& place,
         const LevelReport& claimed, Contents& contents, Claims& claims) {
  const std::string name = file.filename().string();
  const auto bytes = LoadBytes(file, claims);
  if (!bytes) return false;
  Result<GlbContents> glb = ReadGlb(*bytes);
  claims.Add(glb.has_value(), name + " is a binary glTF with a Draco mesh" +
                                  (glb ? "" : ": " + glb.error().message));
  if (!glb) return false;
  std::optional<DecodedMesh> decoded = DecodeStored(name, glb->surface.draco, claims);
  if (!decoded) return false;
  VerifyAccessors(name, glb->surface, *decoded, claims);
  VerifyMatrix(name, *glb, *decoded, claims);
  Status named = NamePosts(context, decoded->mesh);
  if (!named) claims.Add(false, name + ": " + named.error().message);
  if (!named) return false;
  const LocalMesh skirt = VerifySkirt({context, name, claimed, *decoded}, *glb, claims);
  MeshRegion region(context.georeference);
  const bool placed = region.Add(decoded->mesh).has_value() && region.Add(skirt).has_value();
  claims.Add(placed, name + " lies where the DEM's system has places");
  if (!placed) return false;
  contents.regions.push_back({place, name, region});
  contents.skirt_triangles += std::ssize(skirt.triangles);
  const QuantizationLattice& first =
      contents.surfaces.empty() ? decoded->lattice : contents.lattice;
  claims.Add(decoded->lattice.origin == first.origin && decoded->lattice.step_m == first.step_m,
             name + " has the level's lattice");
  const int bits = std::max(first.bits, decoded->lattice.bits);  // as few as hold one part's
  contents.lattice = first;
  contents.lattice.bits = bits;
  contents.bytes += std::ssize(*bytes);
  contents.triangles.push_back(decoded->mesh.triangles.size());
  contents.surfaces.push_back(std::move(decoded->mesh));
  contents.edges.push_back(std::move(glb->edges));
  return true;
}

}  // namespace

std::optional<StoredLevel> LoadGlbs(const LevelContext& context,
                                    const std::filesystem::path& directory,
                                    const LevelReport& claimed, Claims& claims) {
  const std::string name = "lod" + std::to_string(claimed.level);
  const bool is_cut = claimed.parts != PartDepth{};
  Contents contents;
  for (std::int32_t row = 0; row < 1 << claimed.parts.rows; ++row) {
    for (std::int32_t column = 0; column < 1 << claimed.parts.columns; ++column) {
      const PartPlace place = {column, row};
      const auto file = directory / PartGlbName(claimed.level, claimed.parts, place);
      std::error_code failure;
      // A part without ground has no file. One that lacks a file leaves the DEM uncovered.
      if (is_cut && !std::filesystem::exists(file, failure)) continue;
      if (!Add(context, file, place, claimed, contents, claims)) return std::nullopt;
    }
  }
  claims.Same(name + ".glb bytes", claimed.glb_bytes, contents.bytes);
  claims.Same(name + ".glb skirt triangles", claimed.skirt_triangles, contents.skirt_triangles);
  if (contents.surfaces.empty()) return std::nullopt;
  std::optional<EdgeVisibility> edges = JoinEdges(contents.edges, contents.triangles);
  claims.Add(edges.has_value(), name + ".glb flags edges of its triangles");
  if (!edges) return std::nullopt;
  StoredLevel level;
  if (edges->edge_count > 0) level.inlined = *std::move(edges);
  level.contents = std::move(contents.regions);
  level.decoded.lattice = contents.lattice;
  level.decoded.mesh =
      is_cut ? JoinMeshes(contents.surfaces) : std::move(contents.surfaces.front());
  return level;
}

}  // namespace farhorizon
