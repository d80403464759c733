#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace farhorizon {

/// Colours of directions of sight. A line of sight has no sense, so a colour stands for a direction
/// and its opposite: once round in 180 degrees.
///
/// The colours are five that people with any usual colour vision tell apart, and mixtures of those
/// beside each other. Who cannot tell two of them apart hides sectors.
using Colour = std::array<std::uint8_t, 3>;

Colour ColourOfAzimuth(double azimuth_deg);
/// "#0072b2".
std::string HexOf(const Colour& colour);

/// The half turn in four sectors of 45 degrees about north, north-east, east and south-east.
inline constexpr int kSectors = 4;
int SectorOfAzimuth(double azimuth_deg);
/// "N or S".
const char* SectorName(int sector);

/// The direction of sight that an edge's colour shows: the middle of its widest interval, the first
/// one of equal ones, in [0, 180).
/// azimuths: as EdgeMeasures has them. Requires: not empty.
double ShownAzimuth(const std::vector<std::array<double, 2>>& azimuths);

}  // namespace farhorizon
