// A step is the difference of two posts that are neighbours in a row or a column. Steps of ground
// are distributed about exponentially: one in e^8 = 3000 is higher than 8 times their mean. A
// coast of sea cliffs has landings, a fill has none: a value is said where three in four steps at
// its rim are that high. On the 17 real rasters of the tests' collection the highest
// share at the rim of any sea, lake or lowest post is below 0.1.
#include "core/io/dem/values/fill_cliffs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "core/io/dem/values/number_text.h"
#include "core/io/dem/values/untagged_voids.h"

namespace farhorizon {

namespace {

constexpr double kCliffInMeanSteps = 8;
constexpr double kCliffShare = 0.75;
// Quays, locks and dikes, which are walls all along, are lower than this.
constexpr double kLeastCliffM = 10;
// Of a value that is not customary, fewer posts than a cell has are no fill but a blunder.
constexpr std::int64_t kLeastPosts = 4;

struct Suspect {
  double value = 0;
  bool customary = false;  // one post is enough
  std::int64_t posts = 0;
  std::int64_t rim = 0;     // steps to posts of other values
  std::int64_t cliffs = 0;  // those that are cliffs
};

std::vector<Suspect> ChooseSuspects(std::span<const double> values, std::size_t columns,
                                    const SampleType& samples) {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  std::vector<Suspect> suspects;
  const auto add = [&](double value, bool customary) {
    if (std::isnan(value) || std::isinf(value)) return;
    if (std::ranges::any_of(suspects, [&](const Suspect& s) { return s.value == value; })) return;
    suspects.push_back({.value = value, .customary = customary});
  };
  add(0, true);
  if (IsCustomaryVoid(greatest, samples)) add(greatest, true);
  add(least, IsCustomaryVoid(least, samples));
  const std::size_t last_row = values.size() - columns;
  for (const std::size_t corner : {std::size_t{0}, columns - 1, last_row, values.size() - 1}) {
    add(values[corner], false);
  }
  return suspects;
}

constexpr int kNone = -1;

int SuspectOf(double value, const std::vector<Suspect>& suspects) {
  for (std::size_t i = 0; i < suspects.size(); ++i) {
    if (value == suspects[i].value) return static_cast<int>(i);
  }
  return kNone;
}

// Calls `take(a, b, suspect of a, suspect of b)` for each two neighbours that have data.
template <typename Take>
void ForEachStep(std::span<const double> values, std::size_t columns,
                 const std::vector<Suspect>& suspects, Take take) {
  std::vector<int> above(columns, kNone);
  for (std::size_t start = 0; start < values.size(); start += columns) {
    int left = kNone;
    for (std::size_t column = 0; column < columns; ++column) {
      const double value = values[start + column];
      const int suspect = SuspectOf(value, suspects);
      if (!std::isnan(value)) {
        if (column > 0 && !std::isnan(values[start + column - 1])) {
          take(values[start + column - 1], value, left, suspect);
        }
        if (start > 0 && !std::isnan(values[start + column - columns])) {
          take(values[start + column - columns], value, above[column], suspect);
        }
      }
      left = suspect;
      above[column] = suspect;
    }
  }
}

}  // namespace

void SayFillsWithCliffs(const std::vector<double>& values, int columns, const SampleType& samples,
                        const ValueScale& scale, Assumptions& assumptions) {
  const auto width = static_cast<std::size_t>(columns);
  std::vector<Suspect> suspects = ChooseSuspects(values, width, samples);
  double sum = 0;
  std::int64_t steps = 0;
  ForEachStep(values, width, suspects, [&](double a, double b, int of_a, int of_b) {
    if (of_a != kNone || of_b != kNone) return;
    sum += std::abs(a - b);
    ++steps;
  });
  if (steps == 0) return;
  const double to_metres = std::abs(scale.scale);
  const double mean_m = sum / static_cast<double>(steps) * to_metres;
  const double cliff_m = std::max(kLeastCliffM, kCliffInMeanSteps * mean_m);
  ForEachStep(values, width, suspects, [&](double a, double b, int of_a, int of_b) {
    if (of_a == of_b) return;
    const bool cliff = std::abs(a - b) * to_metres > cliff_m;
    for (const int suspect : {of_a, of_b}) {
      if (suspect == kNone) continue;
      ++suspects[static_cast<std::size_t>(suspect)].rim;
      suspects[static_cast<std::size_t>(suspect)].cliffs += cliff ? 1 : 0;
    }
  });
  for (const double value : values) {
    const int suspect = SuspectOf(value, suspects);
    if (suspect != kNone) ++suspects[static_cast<std::size_t>(suspect)].posts;
  }
  for (const Suspect& suspect : suspects) {
    // Where there is less ground than rim, the steps of the ground say nothing.
    const bool judged = suspect.rim > 0 && steps >= suspect.rim;
    const bool cliffs =
        static_cast<double>(suspect.cliffs) >= kCliffShare * static_cast<double>(suspect.rim);
    if (!judged || !cliffs || (!suspect.customary && suspect.posts < kLeastPosts)) continue;
    const std::string text = NumberText(suspect.value);
    assumptions.push_back(
        {"cliffs-around-value",
         std::to_string(suspect.posts) + (suspect.posts == 1 ? " post is" : " posts are") +
             " exactly " + text + " and may be a fill: " + std::to_string(suspect.cliffs) +
             " of the " + std::to_string(suspect.rim) +
             " steps at the rim are cliffs of more than " + NumberText(std::round(cliff_m)) +
             " m; kept as ground; if that value means no data, state it with --nodata=" + text});
  }
}

}  // namespace farhorizon
