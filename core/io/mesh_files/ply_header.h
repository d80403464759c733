#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/io/mesh_files/stored_scalar.h"

namespace farhorizon {

/// A property of an element. count_type: of the list's length, where it is a list.
struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::kFloat;
  std::optional<ScalarType> count_type;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { kText, kLittleEndian, kBigEndian };

/// What a PLY says of itself before its data, which begin at `body`.
struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kText;
  std::vector<PlyElement> elements;
  std::size_t body = 0;
};

/// Errors: "bad-mesh-file" with the line.
Result<PlyHeader> ReadPlyHeader(std::string_view bytes);

}  // namespace farhorizon
