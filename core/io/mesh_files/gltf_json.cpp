#include "core/io/mesh_files/gltf_json.h"

#include <string>

#include "core/io/mesh_files/file_mesh.h"

namespace farhorizon {

namespace {

constexpr int kMaxDepth = 64;
constexpr std::size_t kMaxText = std::size_t{64} << 20U;

}  // namespace

Result<MeshJson> ParseMeshJson(std::string_view text) {
  if (text.size() > kMaxText) return BadMeshFile("its JSON has more than 64 MiB");
  bool too_deep = false;
  const auto visit = [&](int depth, MeshJson::parse_event_t /*event*/, MeshJson& /*value*/) {
    too_deep = too_deep || depth > kMaxDepth;
    return !too_deep;
  };
  MeshJson document = MeshJson::parse(text, visit, false);
  if (too_deep) return BadMeshFile("its JSON is more than 64 deep");
  if (document.is_discarded()) return BadMeshFile("its JSON cannot be parsed");
  if (!document.is_object()) return BadMeshFile("its JSON is no object");
  return document;
}

std::uint64_t CountIn(const MeshJson& value) {
  constexpr double kMost = 9007199254740992;  // 2^53
  const double number = value.get<double>();
  const auto whole = number >= 0 && number <= kMost ? static_cast<std::uint64_t>(number) : 0;
  if (static_cast<double>(whole) != number) {
    throw MeshJson::other_error::create(501, "no count: " + value.dump(), &value);
  }
  return whole;
}

std::uint64_t CountOr(const MeshJson& object, const char* name, std::uint64_t otherwise) {
  const MeshJson* member = Member(object, name);
  return member == nullptr ? otherwise : CountIn(*member);
}

const MeshJson* Member(const MeshJson& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() ? nullptr : &*found;
}

}  // namespace farhorizon
