// Files name others by address: buffers of a .gltf, content of a tileset. Nothing but what lies
// beside or below the naming file is opened, so that a file of a stranger reads nothing else.
#include "core/io/mesh_files/beside_file.h"

#include <algorithm>
#include <utility>

#include "core/io/mesh_files/file_mesh.h"

namespace farhorizon {

namespace {

int HexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string PercentDecoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? HexDigit(text[i + 1]) : -1;
    const int low = high >= 0 ? HexDigit(text[i + 2]) : -1;
    if (low < 0) {
      decoded += text[i];
      continue;
    }
    decoded += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return decoded;
}

int Base64Digit(char c) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t at = kDigits.find(c);
  return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

}  // namespace

Result<std::filesystem::path> PathBeside(const std::filesystem::path& folder,
                                         std::string_view uri) {
  const auto refuse = [&](const char* why) {
    return BadMeshFile("it names \"" + std::string(uri.substr(0, 60)) + "\", " + why +
                       "; only files beside it and below are read");
  };
  const std::string name = PercentDecoded(uri.substr(0, uri.find_first_of("?#")));
  const std::filesystem::path path(name);
  if (name.empty()) return refuse("which is no file");
  if (name.find(':') != std::string::npos) return refuse("which has a scheme");
  if (name.find('\\') != std::string::npos ||
      std::ranges::any_of(name, [](char c) { return static_cast<unsigned char>(c) < ' '; })) {
    return refuse("which has a character that no such name has");
  }
  if (path.is_absolute()) return refuse("which is absolute");
  if (std::ranges::find(path, std::filesystem::path("..")) != path.end()) {
    return refuse("which leads out of its folder");
  }
  return folder / path;
}

std::optional<std::vector<std::uint8_t>> BytesOfDataUri(std::string_view uri) {
  if (!uri.starts_with("data:")) return std::nullopt;
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
    return std::nullopt;
  }
  std::string_view digits = uri.substr(comma + 1);
  while (digits.ends_with('=')) digits.remove_suffix(1);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(digits.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  unsigned held = 0;
  for (const char c : digits) {
    const int digit = Base64Digit(c);
    if (digit < 0) return std::nullopt;
    bits = (bits << 6U) | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> held));
  }
  return bytes;
}

}  // namespace farhorizon
