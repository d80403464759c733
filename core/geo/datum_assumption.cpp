// One sentence about the operation that was taken. Its parts are left out where they say nothing:
// an exact operation needs no word, missing grids are named at most a few at a time.
#include "core/geo/datum_assumption.h"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace farhorizon {

namespace {

constexpr std::size_t kMaxGrids = 3;  // in a sentence

// As a shell takes it for one word.
std::string Quoted(const std::string& text) {
  return text.find(' ') == std::string::npos ? text : "\"" + text + "\"";
}

bool IsBetter(const DatumOperation& one, const DatumOperation& than) {
  return one.accuracy_m && (!than.accuracy_m || *one.accuracy_m < *than.accuracy_m);
}

// Grids that are missing for operations more accurate than `taken`, each with the accuracy.
std::string BetterGrids(const DatumChoice& choice) {
  const DatumOperation& taken = choice.Taken();
  std::vector<std::string> names;
  std::string listed;
  for (const DatumOperation& one : choice.all) {
    if (choice.global && choice.shifts_plan && !one.area.IsWorld()) continue;
    const bool better = !one.ballpark && !one.ballpark_heights && !one.missing_grids.empty() &&
                        IsBetter(one, taken);
    if (!better || std::ranges::find(names, one.missing_grids.front()) != names.end()) continue;
    names.push_back(one.missing_grids.front());
    if (names.size() > kMaxGrids) continue;
    char accuracy[40];
    std::snprintf(accuracy, sizeof accuracy, " (%.3g m)", *one.accuracy_m);
    listed += (listed.empty() ? "" : ", ") + names.back() + accuracy;
  }
  if (names.size() > kMaxGrids) {
    listed += " and " + std::to_string(names.size() - kMaxGrids) + " more";
  }
  return listed;
}

// True where `--datum-operation` has something else to state.
bool Others(const DatumChoice& choice) {
  return std::ranges::any_of(choice.all, [&](const DatumOperation& one) {
    return &one != &choice.Taken() && one.missing_grids.empty() && !one.ballpark_heights &&
           !one.names.empty();
  });
}

// The most accurate operation that holds at `place`; null where none does.
const DatumOperation* BestAt(const DatumChoice& choice, const Geodetic& place) {
  const DatumOperation* best = nullptr;
  for (const DatumOperation& one : choice.all) {
    if (!one.missing_grids.empty() || one.ballpark || one.ballpark_heights) continue;
    if (!one.accuracy_m || !one.area.Contains(place.lon_deg, place.lat_deg)) continue;
    if (best == nullptr || *one.accuracy_m < *best->accuracy_m) best = &one;
  }
  return best;
}

}  // namespace

std::optional<Assumption> DatumAssumption(const DatumChoice& choice, const std::string& name,
                                          const std::optional<Geodetic>& middle, bool stated) {
  const DatumOperation& taken = choice.Taken();
  const bool outside =
      choice.shifts_plan && middle && !taken.area.Contains(middle->lon_deg, middle->lat_deg);
  const std::string grids = stated ? "" : BetterGrids(choice);
  if (!outside && (stated || (!choice.shifts_plan && grids.empty()))) return std::nullopt;
  std::string text = name + " is placed on the globe by the datum operation " + taken.Described();
  if (!stated) text += ", every tile alike";
  if (taken.ballpark) {
    text += choice.global
                ? ", which takes two global frames, metres apart at most, for one"
                : ", which leaves out a shift that PROJ does not know: up to some hundred "
                  "metres, where the datum is an old one";
  }
  if (outside) text += "; it is made for " + taken.area.ShortName() + ", the DEM lies elsewhere";
  const DatumOperation* best = middle && !choice.global ? BestAt(choice, *middle) : nullptr;
  const bool better =
      best != nullptr && best != &taken && (outside || (!stated && IsBetter(*best, taken)));
  if (better) {
    text += "; " + best->Described() + " is made for " + best->area.ShortName() +
            ": if the survey lies there, state it for all tiles with --datum-operation " +
            Quoted(best->Stated());
  }
  if (!grids.empty()) text += "; better ones need grids that are not installed: " + grids;
  if (!stated && !better && Others(choice)) text += "; --datum-operation states another";
  return Assumption{"datum-operation", text};
}

}  // namespace farhorizon
