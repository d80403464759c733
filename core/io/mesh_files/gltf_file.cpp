// A glTF's nodes from the scene's roots down, without recursion; each node is visited once, so that
// a circle of nodes ends in an error.
#include "core/io/mesh_files/gltf_file.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/io/glb_container.h"
#include "core/io/mesh_files/gltf_buffers.h"
#include "core/io/mesh_files/gltf_json.h"
#include "core/io/mesh_files/gltf_primitive.h"
#include "core/io/mesh_files/placing_matrix.h"

namespace farhorizon {

namespace {

// Extensions that move no point, or are handled here.
bool IsKnown(std::string_view extension) {
  constexpr std::string_view kHandled[] = {kGltfDraco, "EXT_meshopt_compression",
                                           "KHR_mesh_quantization",
                                           "EXT_mesh_primitive_edge_visibility"};
  constexpr std::string_view kOfLooks[] = {"KHR_materials_",
                                           "KHR_texture_",
                                           "EXT_texture_",
                                           "KHR_lights_",
                                           "EXT_lights_",
                                           "EXT_mesh_features",
                                           "EXT_structural_metadata",
                                           "MSFT_texture_"};
  return std::ranges::find(kHandled, extension) != std::end(kHandled) ||
         std::ranges::any_of(kOfLooks, [&](auto begin) { return extension.starts_with(begin); });
}

Status CheckExtensions(const MeshJson& json) {
  const MeshJson* required = Member(json, "extensionsRequired");
  if (required == nullptr) return Ok{};
  for (const MeshJson& name : *required) {
    if (IsKnown(name.get_ref<const std::string&>())) continue;
    return BadMeshFile("it requires the extension " + name.get<std::string>().substr(0, 60) +
                       ", which is not known here");
  }
  return Ok{};
}

PlacingMatrix MatrixOfNode(const MeshJson& node) {
  if (const MeshJson* matrix = Member(node, "matrix")) return matrix->get<PlacingMatrix>();
  return MatrixOf(node.value("translation", FilePoint{0, 0, 0}),
                  node.value("rotation", std::array<double, 4>{0, 0, 0, 1}),
                  node.value("scale", FilePoint{1, 1, 1}));
}

class SceneReader {
 public:
  SceneReader(const MeshJson& json, GltfBuffers& buffers, const MeshLimits& limits)
      : json_(json), buffers_(buffers), limits_(limits) {}

  Result<FileMesh> Read() {
    if (Status visited = VisitNodes(); !visited) return std::move(visited.error());
    if (mesh_.triangles.empty()) {
      return BadMeshFile(others_ > 0 ? "it has points and lines alone, no triangle"
                                     : "its scene has no triangle");
    }
    mesh_.frame = FileFrame::kYUp;
    return std::move(mesh_);
  }

 private:
  struct Visit {
    std::uint64_t node;
    PlacingMatrix above;
  };

  // The nodes that the scene begins with; without scenes all that are no node's child.
  std::vector<std::uint64_t> Roots() const {
    std::vector<std::uint64_t> roots;
    if (const MeshJson* scenes = Member(json_, "scenes")) {
      const MeshJson* nodes = Member(scenes->at(CountOr(json_, "scene", 0)), "nodes");
      if (nodes == nullptr) return roots;
      for (const MeshJson& node : *nodes) roots.push_back(CountIn(node));
      return roots;
    }
    const MeshJson& nodes = json_.at("nodes");
    std::vector<bool> is_child(nodes.size(), false);
    for (const MeshJson& node : nodes) {
      if (const MeshJson* children = Member(node, "children")) {
        for (const MeshJson& child : *children) {
          const std::uint64_t index = CountIn(child);
          if (index < is_child.size()) is_child[index] = true;
        }
      }
    }
    for (std::uint64_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) roots.push_back(i);
    }
    return roots;
  }

  Status VisitNodes() {
    if (Member(json_, "nodes") == nullptr) return Ok{};
    const MeshJson& nodes = json_.at("nodes");
    std::vector<bool> visited(nodes.size(), false);
    std::vector<Visit> open;
    for (const std::uint64_t root : Roots()) open.push_back({root, kIdentity});
    std::ranges::reverse(open);
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      const MeshJson& node = nodes.at(visit.node);
      if (visited[visit.node]) {
        return BadMeshFile("node " + std::to_string(visit.node) +
                           " is reached twice; nodes are trees in glTF");
      }
      visited[visit.node] = true;
      const PlacingMatrix placing = Multiply(visit.above, MatrixOfNode(node));
      if (const MeshJson* mesh = Member(node, "mesh")) {
        for (const MeshJson& primitive : json_.at("meshes").at(CountIn(*mesh)).at("primitives")) {
          if (Status read = AddPrimitive(primitive, placing); !read) return read;
        }
      }
      if (const MeshJson* children = Member(node, "children")) {
        for (const MeshJson& child : *children) open.push_back({CountIn(child), placing});
      }
    }
    return Ok{};
  }

  // Whether the primitive is marked as the skirt of the mesh's surface, as ours are.
  static bool IsSkirt(const MeshJson& primitive) {
    const MeshJson* extras = Member(primitive, "extras");
    const MeshJson* skirt = extras == nullptr ? nullptr : Member(*extras, "skirt");
    return skirt != nullptr && skirt->is_boolean() && skirt->get<bool>();
  }

  Status AddPrimitive(const MeshJson& primitive, const PlacingMatrix& placing) {
    if (IsSkirt(primitive)) return Ok{};
    if (!HasTriangles(primitive)) {
      ++others_;
      return Ok{};
    }
    Result<FileMesh> part = ReadPrimitive(primitive, buffers_, limits_);
    if (!part) return std::move(part.error());
    if (Status few = CheckCounts(mesh_.points.size() + part->points.size(),
                                 mesh_.triangles.size() + part->triangles.size(), limits_);
        !few) {
      return few;
    }
    Place(placing, *part);
    const auto first = static_cast<std::uint32_t>(mesh_.points.size());
    const auto count = static_cast<std::uint32_t>(part->points.size());
    mesh_.points.insert(mesh_.points.end(), part->points.begin(), part->points.end());
    for (const auto& t : part->triangles) {
      // An index beyond this primitive's points must not reach the next one's.
      if (std::max({t[0], t[1], t[2]}) >= count) {
        return BadMeshFile("an index is beyond the " + std::to_string(count) +
                           " points of its primitive");
      }
      mesh_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return Ok{};
  }

  const MeshJson& json_;
  GltfBuffers& buffers_;
  MeshLimits limits_;
  FileMesh mesh_;
  std::int64_t others_ = 0;  // primitives of points and lines
};

}  // namespace

Result<FileMesh> ReadGltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& folder,
                          const MeshLimits& limits) {
  GlbChunks chunks{bytes, {}};
  if (IsGlb(bytes)) {
    Result<GlbChunks> split = SplitGlb(bytes);
    if (!split) return std::move(split.error());
    chunks = *split;
  }
  Result<MeshJson> json =
      ParseMeshJson({reinterpret_cast<const char*>(chunks.json.data()), chunks.json.size()});
  if (!json) return std::move(json.error());
  try {
    if (Status known = CheckExtensions(*json); !known) return std::move(known.error());
    GltfBuffers buffers(*json, chunks.bin, folder, limits);
    return SceneReader(*json, buffers, limits).Read();
  } catch (const nlohmann::json::exception& failure) {
    return BadMeshFile(std::string("it is not as glTF 2.0 has it: ") + failure.what());
  }
}

}  // namespace farhorizon
