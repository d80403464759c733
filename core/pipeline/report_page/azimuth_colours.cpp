#include "core/pipeline/report_page/azimuth_colours.h"

#include <cmath>
#include <cstddef>

#include "core/base/hex.h"

namespace farhorizon {

namespace {

// Blue, bluish green, yellow, vermilion and purple, after [OkabeIto08], the yellow darker, so that
// it shows on a bright relief; 36 degrees apart.
constexpr std::array<Colour, 5> kColours = {
    {{0, 114, 178}, {0, 158, 115}, {222, 170, 0}, {213, 94, 0}, {176, 82, 154}}};

// In [0, 180).
double HalfTurn(double azimuth_deg) {
  const double turned = std::fmod(azimuth_deg, 180.0);
  return turned < 0 ? turned + 180 : turned;
}

}  // namespace

Colour ColourOfAzimuth(double azimuth_deg) {
  const double place = HalfTurn(azimuth_deg) / 180 * kColours.size();
  const auto before = static_cast<std::size_t>(place) % kColours.size();
  const double share = place - std::floor(place);
  const Colour& from = kColours[before];
  const Colour& to = kColours[(before + 1) % kColours.size()];
  Colour mixed{};
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    // Squares are about proportional to light.
    const double light = (1 - share) * from[i] * from[i] + share * to[i] * to[i];
    mixed[i] = static_cast<std::uint8_t>(std::lround(std::sqrt(light)));
  }
  return mixed;
}

std::string HexOf(const Colour& colour) { return "#" + ToHex(colour); }

int SectorOfAzimuth(double azimuth_deg) {
  return static_cast<int>(HalfTurn(azimuth_deg + 22.5) / 45) % kSectors;
}

const char* SectorName(int sector) {
  constexpr std::array<const char*, kSectors> kNames = {"N or S", "NE or SW", "E or W", "SE or NW"};
  return kNames[static_cast<std::size_t>(sector)];
}

double ShownAzimuth(const std::vector<std::array<double, 2>>& azimuths) {
  std::array<double, 2> widest = azimuths.front();
  for (const std::array<double, 2>& interval : azimuths) {
    if (interval[1] - interval[0] > widest[1] - widest[0]) widest = interval;
  }
  return HalfTurn((widest[0] + widest[1]) / 2);
}

}  // namespace farhorizon
