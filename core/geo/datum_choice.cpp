// One datum operation for a system. PROJ by itself would choose for every point; the choice here
// depends on nothing but the system, PROJ's database and the grids that are installed.
#include "core/geo/datum_choice.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <utility>

#include "core/geo/crs_name.h"
#include "core/geo/crs_text.h"
#include "core/geo/parse_crs.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMaxListed = 8;      // operations in a message
constexpr std::size_t kMaxGrids = 3;       // in a sentence
constexpr std::size_t kMaxAreaBytes = 70;  // in a sentence

std::string Lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// The names by which `operation` may be stated, in lower case: its own, its code, and those of its
// transformations. PROJ joins the names of some with " + ".
std::vector<std::string> NamesOf(const DatumOperation& operation) {
  std::vector<std::string> names = operation.codes;
  names.push_back(operation.Stated());
  for (const std::string& joined : operation.names) {
    names.push_back(joined);
    for (std::size_t from = 0; from < joined.size();) {
      const std::size_t plus = std::min(joined.find(" + ", from), joined.size());
      names.push_back(joined.substr(from, plus - from));
      from = plus + 3;
    }
  }
  for (std::string& name : names) name = Lower(name);
  return names;
}

// What a user may mean by `stated`, in lower case: the text itself, without "Inverse of", and the
// name of the operation that has it as its code.
std::vector<std::string> Meanings(const ProjSession& session, const std::string& stated) {
  constexpr std::string_view kInverse = "inverse of ";
  std::vector<std::string> meanings = {Lower(stated)};
  if (meanings[0].starts_with(kInverse)) meanings[0].erase(0, kInverse.size());
  std::string name = OperationName(session, CompletedCrsText(stated));
  if (!name.empty()) meanings.push_back(Lower(std::move(name)));
  return meanings;
}

bool IsOnWgs84(const ProjSession& session, const PJconsts* crs) {
  const ProjObject plan = PlanOf(session, crs);
  return plan && HorizontalDatumName(session, plan.get()).starts_with("World Geodetic System 1984");
}

Result<DatumChoice> TakeStated(const ProjSession& session, DatumChoice choice,
                               const std::string& stated) {
  const std::vector<std::string> meanings = Meanings(session, stated);
  std::string known;
  std::size_t listed = 0;
  const DatumOperation* lacking = nullptr;
  for (std::size_t i = 0; i < choice.all.size(); ++i) {
    const DatumOperation& one = choice.all[i];
    if (one.ballpark_heights) continue;
    if (std::ranges::find_first_of(meanings, NamesOf(one)) != meanings.end()) {
      if (one.missing_grids.empty()) {
        choice.taken = i;
        return choice;
      }
      if (lacking == nullptr) lacking = &one;
    }
    if (!one.missing_grids.empty() || one.names.empty()) continue;
    if (++listed <= kMaxListed) known += (known.empty() ? "" : ", ") + one.Described();
  }
  if (lacking != nullptr) {
    return Error{ErrorCode::kUnsupportedData,
                 "the datum operation " + lacking->Described() + " needs the grid " +
                     lacking->missing_grids.front() +
                     ", which is not installed; install it where PROJ looks for grids, or give "
                     "another --datum-operation",
                 "no-geoid-grid"};
  }
  if (listed > kMaxListed) known += " and " + std::to_string(listed - kMaxListed) + " more";
  return Error{ErrorCode::kInvalidArgument,
               "there is no datum operation \"" + stated.substr(0, 60) +
                   "\" from this reference system to the globe; " +
                   (known.empty() ? "none is needed: leave --datum-operation out"
                                  : "--datum-operation takes one of " + known),
               "invalid-argument"};
}

// An area of use in few words: the first of its bytes, whole characters of UTF-8.
std::string Shortened(const std::string& area) {
  if (area.size() <= kMaxAreaBytes)
    return area.ends_with('.') ? area.substr(0, area.size() - 1) : area;
  std::size_t end = kMaxAreaBytes;
  while (end > 0 && (static_cast<unsigned char>(area[end]) & 0xC0) == 0x80) --end;
  return area.substr(0, end) + "...";
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
    if (choice.global && choice.shifts_plan && !one.HoldsEverywhere()) continue;
    const bool better = !one.ballpark && !one.ballpark_heights && !one.missing_grids.empty() &&
                        one.accuracy_m &&
                        (!taken.accuracy_m || *one.accuracy_m < *taken.accuracy_m);
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
    if (!one.accuracy_m || !one.HoldsAt(place.lon_deg, place.lat_deg)) continue;
    if (best == nullptr || *one.accuracy_m < *best->accuracy_m) best = &one;
  }
  return best;
}

}  // namespace

Result<DatumChoice> TakeDatumOperation(const ProjSession& session, const PJconsts* source,
                                       const PJconsts* globe, const std::string& stated) {
  DatumChoice choice{.all = ListDatumOperations(session, source, globe)};
  choice.global = IsOfTheWorld(session, source);
  choice.shifts_plan = !IsOnWgs84(session, source);
  if (!stated.empty()) return TakeStated(session, std::move(choice), stated);
  const auto usable = [](const DatumOperation& one) {
    return one.missing_grids.empty() && !one.ballpark_heights;
  };
  auto found = std::ranges::find_if(choice.all, [&](const DatumOperation& one) {
    return usable(one) && !one.ballpark &&
           (!choice.global || !choice.shifts_plan || one.HoldsEverywhere());
  });
  if (found == choice.all.end()) {
    found = std::ranges::find_if(
        choice.all, [&](const DatumOperation& one) { return usable(one) && one.ballpark; });
  }
  if (found == choice.all.end()) found = std::ranges::find_if(choice.all, usable);
  if (found == choice.all.end()) return DatumChoice();
  choice.taken = static_cast<std::size_t>(found - choice.all.begin());
  return choice;
}

std::optional<Assumption> DatumAssumption(const DatumChoice& choice, const std::string& name,
                                          const std::optional<Geodetic>& middle, bool stated) {
  const DatumOperation& taken = choice.Taken();
  const bool outside =
      choice.shifts_plan && middle && !taken.HoldsAt(middle->lon_deg, middle->lat_deg);
  const std::string grids = stated ? "" : BetterGrids(choice);
  if (!outside && (stated || (!choice.shifts_plan && grids.empty()))) return std::nullopt;
  std::string text = name + " is placed on the globe by the datum operation " + taken.Described();
  if (!stated) text += ", every tile alike";
  if (taken.ballpark) {
    text += choice.global ? ", which takes two global frames, metres apart at most, for one"
                          : ", which leaves a shift of up to some hundred metres undone";
  }
  if (outside) text += "; it is made for " + Shortened(taken.area) + ", the DEM lies elsewhere";
  const DatumOperation* best = middle && !choice.global ? BestAt(choice, *middle) : nullptr;
  const bool better =
      best != nullptr && best != &taken && (outside || (!stated && IsBetter(*best, taken)));
  if (better) {
    text += "; where this DEM lies, " + best->Described() + " for " + Shortened(best->area) +
            " is known, too: state it for all tiles of a survey with --datum-operation " +
            best->Stated();
  }
  if (!grids.empty()) text += "; better ones need grids that are not installed: " + grids;
  if (!stated && !better && Others(choice)) text += "; --datum-operation states another";
  return Assumption{"datum-operation", text};
}

}  // namespace farhorizon
