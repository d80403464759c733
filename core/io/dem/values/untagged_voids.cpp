// One pass finds the values that are customary for no data and those that are no heights; where
// there is none of them, as in most files, that is all.
#include "core/io/dem/values/untagged_voids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/io/dem/values/number_text.h"

namespace farhorizon {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// More than the highest cliff on Earth (Mount Thor, 1250 m): no two heights of ground between which
// there is no other lie further apart.
constexpr double kMoreThanACliff = 1300;
// Void values are few, the most in one file that is known of are four (voids, sea, outside, unset).
// Many values beyond any height are no voids but something else: bytes in the wrong order.
constexpr std::size_t kMaxFamilies = 16;
// Of the least void, 999: smaller values need no look.
constexpr double kLeastVoid = 999;

// Void values numbered on (-9999, -9998) or off by rounding (-9999.9, -32766) are within this.
constexpr double kNear = 10;

bool IsBeyondGround(double metres) {
  return !(metres >= kLowestGround && metres <= kHighestGround);
}

// The customary value that `value` is or is near.
std::optional<double> CustomaryVoid(double value, const SampleType& samples) {
  // 65504: the greatest of 16-bit floats.
  static constexpr auto kMagnitudes = std::to_array<double>(
      {9999, 32767, 65504, 65535, 99999, 999999, 9999999, 99999999, 999999999});
  const double magnitude = std::abs(value);
  if (magnitude == kLeastVoid || magnitude >= kMaxHeight) return value;
  if (value == samples.greatest || (value == samples.least && value < 0)) return value;
  for (const double customary : kMagnitudes) {
    if (std::abs(magnitude - customary) <= kNear) return std::copysign(customary, value);
  }
  return std::nullopt;
}

// Posts with values near one customary value.
struct Family {
  std::int64_t posts = 0;
  double least = 0;
  double greatest = 0;
  double apart_m = std::numeric_limits<double>::infinity();  // from the nearest other height
};

struct Suspects {
  std::map<double, Family> families;  // by their customary value
  std::int64_t others = 0;            // posts with other heights
  std::int64_t beyond = 0;            // those of them that are beyond ground
  std::size_t first_beyond = 0;
};

std::string Posts(std::int64_t count, const char* one = "", const char* many = "") {
  return std::to_string(count) + (count == 1 ? " post" : " posts") + (count == 1 ? one : many);
}

std::string CellName(std::size_t post, int columns) {
  const auto width = static_cast<std::size_t>(columns);
  return "the cell at column " + std::to_string(post % width) + ", row " +
         std::to_string(post / width);
}

Error Infinite(double value, std::size_t post, int columns) {
  return {ErrorCode::kUnsupportedData,
          CellName(post, columns) +
              " is infinite; if that means no data, name it with --nodata=" + NumberText(value),
          "infinite-height"};
}

Error BeyondGround(std::size_t post, std::int64_t posts, int columns, double value,
                   const ValueScale& scale) {
  const double metres = value * scale.scale + scale.offset;
  std::string message = CellName(post, columns) + " is " + NumberText(value);
  if (metres != value) message += ", " + NumberText(std::round(metres)) + " m";
  message += ", and " + Posts(posts, " is", " are") + " beyond the heights of ground on Earth (" +
             NumberText(kLowestGround) + " m to " + NumberText(kHighestGround) +
             " m); if that value means no data, name it with --nodata=" + NumberText(value) +
             "; if the heights are feet, state it with --height-unit; if they have a scale, such "
             "as centimetres, put it in with gdal_translate -a_scale 0.01 IN OUT";
  if (value >= 32768 && value < 65536) {
    message +=
        "; if the samples are signed, gdal_calc.py -A IN --outfile=OUT --type=Int16 "
        "--calc=\"A.astype('int16')\" makes them so";
  }
  return {ErrorCode::kUnsupportedData, message, "height-out-of-range"};
}

Error TooLarge(double value, std::size_t post, int columns) {
  return {ErrorCode::kUnsupportedData,
          CellName(post, columns) + " is stored as " + NumberText(value) +
              ", numbers below 2^30 are read; if it means no data, name it with --nodata=" +
              NumberText(value) +
              "; else put the scale into the heights with gdal_translate -unscale -ot Float64 IN "
              "OUT",
          "height-out-of-range"};
}

Result<Suspects> FindSuspects(const std::vector<double>& values, const ValueScale& scale,
                              const SampleType& samples, int columns) {
  Suspects found;
  for (std::size_t post = 0; post < values.size(); ++post) {
    const double value = values[post];
    if (std::isnan(value)) continue;
    if (std::isinf(value)) return Infinite(value, post, columns);
    const bool beyond = IsBeyondGround(value * scale.scale + scale.offset);
    if (!beyond && std::abs(value) >= kMaxHeight) return TooLarge(value, post, columns);
    const bool ordinary = !beyond && std::abs(value) < kLeastVoid && value != samples.greatest &&
                          value != samples.least;
    const std::optional<double> customary = ordinary ? std::nullopt : CustomaryVoid(value, samples);
    if (!customary) {
      ++found.others;
      if (beyond && found.beyond++ == 0) found.first_beyond = post;
      continue;
    }
    Family& family = found.families[*customary];
    if (family.posts++ == 0) family.least = family.greatest = value;
    family.least = std::min(family.least, value);
    family.greatest = std::max(family.greatest, value);
    if (found.families.size() > kMaxFamilies) {
      return BeyondGround(post, found.beyond + 1, columns, value, scale);
    }
  }
  return found;
}

// How far each family is from the heights that are of none.
void MeasureGaps(const std::vector<double>& values, const ValueScale& scale,
                 const SampleType& samples, Suspects& suspects) {
  for (const double value : values) {
    if (std::isnan(value) || CustomaryVoid(value, samples)) continue;
    for (auto& [customary, family] : suspects.families) {
      family.apart_m = std::min(family.apart_m, std::abs((value - customary) * scale.scale));
    }
  }
}

Assumption LeftOut(const Family& family, bool beyond) {
  const std::string least = NumberText(family.least);
  const std::string greatest = NumberText(family.greatest);
  const bool one = family.least == family.greatest;
  return {"untagged-void",
          Posts(family.posts) + " of " + (one ? least : least + " to " + greatest) +
              ", which no tag of the file names, " + (family.posts == 1 ? "was" : "were") +
              " left out as no data: no ground on Earth " +
              (beyond ? "has that height" : "stands so far apart from all others of the file") +
              "; state it with --nodata=" + least + (one ? "" : " --nodata=" + greatest)};
}

}  // namespace

bool IsCustomaryVoid(double value, const SampleType& samples) {
  return CustomaryVoid(value, samples).has_value();
}

Status LeaveOutUntaggedVoids(const SampleType& samples, const ValueScale& scale, int columns,
                             std::vector<double>& values, Assumptions& assumptions) {
  Result<Suspects> found = FindSuspects(values, scale, samples, columns);
  if (!found) return std::move(found.error());
  if (found->beyond > 0) {
    return BeyondGround(found->first_beyond, found->beyond, columns, values[found->first_beyond],
                        scale);
  }
  if (found->families.empty()) return Ok{};
  MeasureGaps(values, scale, samples, *found);
  const auto beyond = [&](double value) {
    return IsBeyondGround(value * scale.scale + scale.offset);
  };
  std::erase_if(found->families, [&](const auto& entry) {
    const bool apart = found->others > 0 && entry.second.apart_m > kMoreThanACliff;
    return !beyond(entry.first) && !apart;
  });
  if (found->families.empty()) return Ok{};
  for (double& value : values) {
    const std::optional<double> customary = CustomaryVoid(value, samples);
    if (customary && found->families.contains(*customary)) value = kNan;
  }
  for (const auto& [customary, family] : found->families) {
    assumptions.push_back(LeftOut(family, beyond(customary)));
  }
  return Ok{};
}

}  // namespace farhorizon
