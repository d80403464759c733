#pragma once

#include <string>

#include "core/pipeline/compare/compare.h"

namespace farhorizon {

/// The comparison as JSON (proto/schemas/compare.schema.json).
std::string ComparisonJson(const Comparison& comparison);

}  // namespace farhorizon
