// A level from its files: the Draco stream out of the GLB or the .drc, decoded, measured by the
// code that the build measures with, and compared with the report and with the GLB's own numbers.
#include "core/pipeline/verify/verify_level.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "core/io/file.h"
#include "core/io/glb.h"

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

// The Draco stream of a level, from its GLB and its .drc, which must be one and the same.
struct Stream {
  std::vector<std::uint8_t> draco;
  std::optional<GlbContents> glb;
};

std::optional<Stream> LoadStream(const std::filesystem::path& directory, const std::string& name,
                                 const LevelReport& claimed, Claims& claims) {
  Stream stream;
  if (claimed.glb_bytes > 0) {
    const auto bytes = Load(directory / (name + ".glb"), claims);
    if (!bytes) return std::nullopt;
    claims.Same(name + ".glb bytes", claimed.glb_bytes, static_cast<std::int64_t>(bytes->size()));
    Result<GlbContents> glb = ReadGlb(*bytes);
    claims.Add(glb.has_value(), name + ".glb is a binary glTF with a Draco mesh" +
                                    (glb ? "" : ": " + glb.error().message));
    if (!glb) return std::nullopt;
    stream.draco = glb->draco;
    stream.glb = *std::move(glb);
  }
  if (claimed.drc_bytes > 0) {
    const auto bytes = Load(directory / (name + ".drc"), claims);
    if (!bytes) return std::nullopt;
    claims.Same(name + ".drc bytes", claimed.drc_bytes, static_cast<std::int64_t>(bytes->size()));
    if (stream.glb) claims.Add(*bytes == stream.draco, name + ".glb carries the bytes of the .drc");
    stream.draco = *bytes;
  }
  if (stream.draco.empty()) return std::nullopt;
  return stream;
}

void VerifyAccessors(const std::string& name, const GlbContents& glb, const DecodedMesh& decoded,
                     Claims& claims) {
  const LocalMesh& mesh = decoded.mesh;
  claims.Same(name + ".glb POSITION count", glb.vertex_count,
              static_cast<std::int64_t>(mesh.positions.size()));
  claims.Same(name + ".glb NORMAL count", glb.normal_count,
              static_cast<std::int64_t>(mesh.normals.size()));
  claims.Same(name + ".glb indices count", glb.index_count,
              static_cast<std::int64_t>(3 * mesh.triangles.size()));
  const LatticeBox box = LatticeBoxOf(mesh.positions, decoded.lattice);
  claims.Add(glb.min == box.least && glb.max == box.greatest,
             name + ".glb POSITION min and max are those of the decoded mesh");
  claims.Add(glb.matrix == GltfMatrix(decoded.lattice),
             name + ".glb has the lattice of its Draco stream in the node's matrix");
}

// The direction of `p` along which heights are counted, unscaled: the normal of the ellipsoid
// through p. From the surface up it is (x, y, z / (1 - e^2)); at 9 km it is off by less than 5e-6.
Enu Upwards(const Enu& p, const TangentFrame& frame) {
  constexpr double kOneLessE2 = 1 - 0.00669437999014;  // WGS 84
  const Ecef at = frame.ToEcef(p);
  const Enu ahead = frame.ToEnu({at.x + at.x, at.y + at.y, at.z + at.z / kOneLessE2});
  return {ahead.east - p.east, ahead.north - p.north, ahead.up - p.up};
}

// Whether every triangle runs counter-clockwise seen from above it. Above is not the frame's up
// where a DEM is large and steep, and not away from the earth's centre where it is steep.
bool AllTurnLeft(const LocalMesh& mesh, const TangentFrame& frame) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    const Enu& a = mesh.positions[t[0]];
    const Enu& b = mesh.positions[t[1]];
    const Enu& c = mesh.positions[t[2]];
    const Enu u = {b.east - a.east, b.north - a.north, b.up - a.up};
    const Enu v = {c.east - a.east, c.north - a.north, c.up - a.up};
    const Enu up = Upwards(a, frame);
    return (u.north * v.up - u.up * v.north) * up.east +
               (u.up * v.east - u.east * v.up) * up.north +
               (u.east * v.north - u.north * v.east) * up.up >
           0;
  });
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

}  // namespace

std::vector<Edge> VerifyLevel(const LevelContext& context, const std::filesystem::path& directory,
                              const LevelReport& claimed, Claims& claims) {
  const std::string name = "lod" + std::to_string(claimed.level);
  const std::optional<Stream> stream = LoadStream(directory, name, claimed, claims);
  if (!stream) {
    claims.Add(false, name + ": no mesh to measure");
    return {};
  }
  Result<DecodedMesh> decoded = DecodeDraco(stream->draco);
  claims.Add(decoded.has_value(),
             name + " decodes as Draco" + (decoded ? "" : ": " + decoded.error().message));
  if (!decoded) return {};
  if (stream->glb) VerifyAccessors(name, *stream->glb, *decoded, claims);
  const LocalMesh& mesh = decoded->mesh;
  claims.Same(name + " lattice's step, metres", claimed.quantization_step_m,
              decoded->lattice.step_m);
  claims.Add(AllTurnLeft(mesh, context.georeference.frame()),
             name + ": no triangle is flipped or without area");
  Result<LevelReport> found =
      MeasureLevel(context, mesh, claimed.level, claimed.quantization_step_m);
  claims.Add(found.has_value(),
             name + " covers the DEM without cracks" + (found ? "" : ": " + found.error().message));
  if (!found) return {};
  VerifyNormals(context, name, mesh, claims);
  claims.Same(name + " triangles", claimed.triangles, found->triangles);
  claims.Same(name + " vertices", claimed.vertices, found->vertices);
  claims.AtMost(name + " vertical error, max", claimed.vertical.max_m, found->vertical.max_m);
  claims.AtMost(name + " vertical error, rms", claimed.vertical.rms_m, found->vertical.rms_m);
  claims.AtMost(name + " silhouette error, max", claimed.silhouette.max_m, found->silhouette.max_m);
  claims.AtMost(name + " silhouette error, rms", claimed.silhouette.rms_m, found->silhouette.rms_m);
  claims.AtMost(name + " geometric error", claimed.geometric_error_m, found->geometric_error_m);
  return EdgesByPost(mesh);
}

}  // namespace farhorizon
