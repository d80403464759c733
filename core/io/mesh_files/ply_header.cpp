// A PLY's header is text, line by line, whatever its data are. What it promises is checked here, so
// that readers of the data can rely on it.
#include "core/io/mesh_files/ply_header.h"

#include <algorithm>
#include <utility>

#include "core/io/mesh_files/file_mesh.h"
#include "core/io/mesh_files/line_reader.h"

namespace farhorizon {

namespace {

std::optional<ScalarType> TypeOf(std::string_view word) {
  struct TypeName {
    std::string_view name;
    ScalarType type;
  };
  constexpr TypeName kNames[] = {{"char", ScalarType::kInt8},     {"int8", ScalarType::kInt8},
                                 {"uchar", ScalarType::kUint8},   {"uint8", ScalarType::kUint8},
                                 {"short", ScalarType::kInt16},   {"int16", ScalarType::kInt16},
                                 {"ushort", ScalarType::kUint16}, {"uint16", ScalarType::kUint16},
                                 {"int", ScalarType::kInt32},     {"int32", ScalarType::kInt32},
                                 {"uint", ScalarType::kUint32},   {"uint32", ScalarType::kUint32},
                                 {"float", ScalarType::kFloat},   {"float32", ScalarType::kFloat},
                                 {"double", ScalarType::kDouble}, {"float64", ScalarType::kDouble}};
  const auto* found = std::ranges::find(kNames, word, &TypeName::name);
  if (found == std::end(kNames)) return std::nullopt;
  return found->type;
}

std::optional<PlyEncoding> EncodingOf(std::string_view word) {
  if (word == "ascii") return PlyEncoding::kText;
  if (word == "binary_little_endian") return PlyEncoding::kLittleEndian;
  if (word == "binary_big_endian") return PlyEncoding::kBigEndian;
  return std::nullopt;
}

// What follows the word "property"; nullopt where it is none.
std::optional<PlyProperty> PropertyOf(std::string_view rest) {
  PlyProperty property;
  std::string_view word = TakeWord(rest);
  if (word == "list") {
    property.count_type = TypeOf(TakeWord(rest));
    if (!property.count_type) return std::nullopt;
    word = TakeWord(rest);
  }
  const std::optional<ScalarType> type = TypeOf(word);
  property.name = TakeWord(rest);
  if (!type || property.name.empty()) return std::nullopt;
  property.type = *type;
  return property;
}

}  // namespace

Result<PlyHeader> ReadPlyHeader(std::string_view bytes) {
  PlyHeader header;
  LineReader lines(bytes);
  const auto bad = [&](const std::string& what) {
    return BadMeshFile("line " + std::to_string(lines.line()) + " of the PLY: " + what);
  };
  bool has_format = false;
  for (std::string_view line; lines.Next(line);) {
    const std::string_view keyword = TakeWord(line);
    if (keyword == "format") {
      const std::optional<PlyEncoding> encoding = EncodingOf(TakeWord(line));
      if (!encoding) return bad("the format is none of ascii and binary_(little|big)_endian");
      header.encoding = *encoding;
      has_format = true;
    } else if (keyword == "element") {
      PlyElement element;
      element.name = TakeWord(line);
      const std::optional<std::int64_t> count = WholeNumberOf(TakeWord(line));
      if (!count || *count < 0) return bad("an element has a name and a count");
      element.count = static_cast<std::uint64_t>(*count);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      std::optional<PlyProperty> property = PropertyOf(line);
      if (!property || header.elements.empty()) return bad("no property of an element");
      header.elements.back().properties.push_back(*std::move(property));
    } else if (keyword == "end_header") {
      if (!has_format) return bad("its header names no format");
      header.body = lines.at();
      return header;
    }
  }
  return BadMeshFile("the header of the PLY has no end");
}

}  // namespace farhorizon
