#include "core/geo/frame_choice.h"

#include <array>
#include <charconv>
#include <cmath>

namespace farhorizon {

namespace {

std::string Shortest(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

// The number that is all of `text`, blanks around it and a plus aside.
std::optional<double> Degrees(std::string_view text, double most) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return std::abs(value) <= most ? std::optional(value) : std::nullopt;  // NaN is none
}

}  // namespace

std::string FrameText(const FrameChoice& frame) {
  switch (frame.axes) {
    case FrameAxes::kTile:
      return "tile";
    case FrameAxes::kGlobe:
      return "globe";
    case FrameAxes::kPlace:
      break;
  }
  return Shortest(frame.lon_deg) + "," + Shortest(frame.lat_deg);
}

std::optional<FrameChoice> FrameFromText(std::string_view text) {
  if (text == "tile") return FrameChoice{};
  if (text == "globe") return FrameChoice{.axes = FrameAxes::kGlobe};
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::optional<double> lon = Degrees(text.substr(0, comma), 180);
  const std::optional<double> lat = Degrees(text.substr(comma + 1), 90);
  if (!lon || !lat) return std::nullopt;
  return FrameChoice{FrameAxes::kPlace, *lon, *lat};
}

}  // namespace farhorizon
