#include "core/io/geojson_text.h"

#include <array>
#include <charconv>
#include <string_view>

#include "core/base/result.h"
#include "core/io/antimeridian.h"

namespace farhorizon {

std::string Rounded(double value, int decimals) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, decimals);
  Check(end.ec == std::errc(), "a coordinate too long to print");
  std::string_view shown(text.data(), static_cast<std::size_t>(end.ptr - text.data()));
  while (decimals > 0 && shown.ends_with('0')) shown.remove_suffix(1);
  if (shown.ends_with('.')) shown.remove_suffix(1);
  return shown == "-0" ? "0" : std::string(shown);
}

std::string Exact(double value) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

// Joined by appending: GCC 12 sees an overlap in "[" + std::string (its bug 105651).
std::string Bracketed(std::initializer_list<std::string> parts) {
  std::string text(1, '[');
  for (const std::string& part : parts) {
    if (text.size() > 1) text += ',';
    text += part;
  }
  return text += ']';
}

std::string Coordinates(const Geodetic& g) {
  return Bracketed({Rounded(g.lon_deg, kDegreeDecimals), Rounded(g.lat_deg, kDegreeDecimals),
                    Rounded(g.height_m, kMetreDecimals)});
}

std::string LineGeometry(const Geodetic& from, const Geodetic& to) {
  std::string lines;
  const auto parts = CutAtAntimeridian(from, to);
  for (const auto& [a, b] : parts) {
    if (!lines.empty()) lines += ',';
    lines += Bracketed({Coordinates(a), Coordinates(b)});
  }
  if (parts.size() == 1) return R"({"type":"LineString","coordinates":)" + lines + "}";
  return R"({"type":"MultiLineString","coordinates":[)" + lines + "]}";
}

std::string Pair(std::int64_t first, std::int64_t second) {
  return Bracketed({std::to_string(first), std::to_string(second)});
}

}  // namespace farhorizon
