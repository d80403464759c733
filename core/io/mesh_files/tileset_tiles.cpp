// The tree of tiles from the root down, without recursion. Content that is a tileset is taken in
// its tile's place; each tileset is read once.
#include "core/io/mesh_files/tileset_tiles.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/io/file.h"
#include "core/io/mesh_files/beside_file.h"
#include "core/io/mesh_files/gltf_json.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMaxContents = 4096;
constexpr std::uintmax_t kMaxTilesetBytes = std::uintmax_t{64} << 20U;
constexpr PlacingMatrix kXUpToZUp = {0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1};

class TileReader {
 public:
  explicit TileReader(std::filesystem::path root) : root_(std::move(root)) {}

  Result<std::vector<TileContent>> Read() {
    open_tilesets_.push_back({root_, kIdentity, 0});
    while (!open_tilesets_.empty()) {
      const OpenTileset tileset = std::move(open_tilesets_.back());
      open_tilesets_.pop_back();
      if (Status read = ReadOne(tileset); !read) return std::move(read.error());
    }
    if (contents_.empty()) return BadMeshFile("no tile of the tileset has content");
    return std::move(contents_);
  }

 private:
  struct OpenTileset {
    std::filesystem::path file;
    PlacingMatrix above;
    int depth;
  };
  struct OpenTile {
    const MeshJson* tile;
    PlacingMatrix above;
    int depth;
  };

  Status ReadOne(const OpenTileset& tileset) {
    if (!read_.insert(tileset.file.lexically_normal()).second) {
      return BadMeshFile("the tileset " + tileset.file.filename().string() + " is named twice");
    }
    Result<std::string> text = ReadFile(tileset.file, kMaxTilesetBytes);
    if (!text) return std::move(text.error());
    Result<MeshJson> json = ParseMeshJson(*text);
    if (!json) return std::move(json.error());
    up_ = kYUpToZUp;
    if (const MeshJson* axis = Member(json->at("asset"), "gltfUpAxis")) {
      if (*axis == "Z") up_ = kIdentity;
      if (*axis == "X") up_ = kXUpToZUp;
    }
    std::vector<OpenTile> open = {{&json->at("root"), tileset.above, tileset.depth}};
    while (!open.empty()) {
      const OpenTile tile = open.back();
      open.pop_back();
      Result<OpenTile> below = TakeTile(tile, tileset.file.parent_path());
      if (!below) return std::move(below.error());
      const MeshJson* children = Member(*tile.tile, "children");
      if (children == nullptr) continue;
      for (auto child = children->rbegin(); child != children->rend(); ++child) {
        open.push_back({&*child, below->above, below->depth});
      }
    }
    return Ok{};
  }

  // Takes the tile's content; what its children begin with.
  Result<OpenTile> TakeTile(const OpenTile& open, const std::filesystem::path& folder) {
    const MeshJson& tile = *open.tile;
    if (tile.contains("implicitTiling")) {
      return BadMeshFile("the tileset has implicit tiling, which is not read");
    }
    OpenTile below = open;
    if (const MeshJson* transform = Member(tile, "transform")) {
      below.above = Multiply(open.above, transform->get<PlacingMatrix>());
    }
    std::vector<const MeshJson*> contents;
    if (const MeshJson* content = Member(tile, "content")) contents.push_back(content);
    if (const MeshJson* several = Member(tile, "contents")) {
      for (const MeshJson& content : *several) contents.push_back(&content);
    }
    bool drawn = false;
    for (const MeshJson* content : contents) {
      const MeshJson* uri = Member(*content, "uri");
      if (uri == nullptr) uri = &content->at("url");  // before version 1.0
      Result<std::filesystem::path> file = PathBeside(folder, uri->get_ref<const std::string&>());
      if (!file) return std::move(file.error());
      if (contents_.size() + open_tilesets_.size() >= kMaxContents) {
        return Error{ErrorCode::kResourceExhausted, "the tileset has more than 4096 contents",
                     "mesh-too-large"};
      }
      if (file->extension() == ".json") {
        open_tilesets_.push_back({*file, below.above, open.depth});
        continue;
      }
      drawn = true;
      contents_.push_back({Printable(uri->get<std::string>()), *file, Multiply(below.above, up_),
                           open.depth, tile.value("geometricError", 0.0)});
    }
    if (drawn) ++below.depth;
    return below;
  }

  std::filesystem::path root_;
  PlacingMatrix up_ = kYUpToZUp;
  std::set<std::filesystem::path> read_;
  std::vector<OpenTileset> open_tilesets_;
  std::vector<TileContent> contents_;
};

}  // namespace

Result<std::vector<TileContent>> ReadTiles(const std::filesystem::path& tileset) {
  try {
    return TileReader(tileset).Read();
  } catch (const nlohmann::json::exception& failure) {
    return BadMeshFile(std::string("the tileset is not as 3D Tiles has it: ") + failure.what());
  }
}

}  // namespace farhorizon
