#pragma once

#include <vector>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "core/io/dem/values/sample_type.h"
#include "core/io/dem/values/value_scale.h"

namespace farhorizon {

/// The heights that ground on Earth can have, metres. Challenger Deep lies at -10935, the summit of
/// Mount Everest at 8849; the geoid is up to 110 m from the ellipsoid, above which heights may be
/// counted; and some 400 m are for masts, blunders of a survey and the overshoot of interpolation.
inline constexpr double kLowestGround = -11500;
inline constexpr double kHighestGround = 9500;

/// Makes NaN of values that no tag names and that writers of DEMs use for no data: -32768, -9999,
/// -3.4e38 and their like, the extremes of the type (IsCustomaryVoid), where they are no ground:
/// beyond what heights on Earth can be, or apart from every other height by more than any cliff.
/// Each is said, with `--nodata`, which states it. They cannot be kept as ground.
///
/// values: raw, NaN where there is no data, rows of `columns` posts; scale: makes metres of them.
/// Errors: kUnsupportedData, kind "infinite-height", or "height-out-of-range" where other values
///   are no heights on Earth, both with the first such cell and what states what was meant.
/// Cost: O(posts), one pass, a second one where there are such values.
Status LeaveOutUntaggedVoids(const SampleType& samples, const ValueScale& scale, int columns,
                             std::vector<double>& values, Assumptions& assumptions);

/// True for values that are customary for no data, whatever they mean in metres: 999 and more nines
/// (-9999, 99999, -9999.9); the extremes of 16-bit integers, in floats too; powers of ten from 1e4;
/// the extremes of the type of `samples`, except the 0 of unsigned ones; and everything from 2^30:
/// no unit of length, not the millimetre, makes ground of that.
bool IsCustomaryVoid(double value, const SampleType& samples);

}  // namespace farhorizon
