#pragma once

#include <string>
#include <vector>

#include "core/pipeline/compare/compare.h"

namespace farhorizon {

/// The comparison as a table for people, with a line for everything that is not as usual.
std::string ComparisonText(const Comparison& comparison);

/// Two lines of figures for a picture.
std::vector<std::string> PictureLines(const MeshComparison& mesh);

}  // namespace farhorizon
