// One datum operation for a system. PROJ by itself would choose for every point; the choice here
// depends on nothing but the system, PROJ's database and the grids that are installed.
#include "core/geo/datum_choice.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/lower.h"
#include "core/geo/crs_name.h"
#include "core/geo/crs_text.h"
#include "core/geo/parse_crs.h"
#include "core/geo/reference_data.h"
#include "core/geo/short_text.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMaxListed = 8;  // operations in a message

// The names by which `operation` may be stated, in lower case: its own, and the codes and names of
// its transformations.
std::vector<std::string> NamesOf(const DatumOperation& operation) {
  std::vector<std::string> names = operation.names;
  names.insert(names.end(), operation.codes.begin(), operation.codes.end());
  names.push_back(operation.Stated());
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

bool IsOfTheWorld(const ProjSession& session, const PJconsts* crs) {
  const std::optional<AreaOfUse> area = AreaOfUseOf(session, crs);
  return area && area->IsWorld();
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
                     lacking->missing_grids.front() + ", which is not installed; " +
                     WhereGridsGo() + ", or give another --datum-operation",
                 "no-geoid-grid"};
  }
  if (listed > kMaxListed) known += " and " + std::to_string(listed - kMaxListed) + " more";
  return Error{ErrorCode::kInvalidArgument,
               "there is no datum operation \"" + ShortText(stated, 60) +
                   "\" from this reference system to the globe; " +
                   (known.empty() ? "none is needed: leave --datum-operation out"
                                  : "--datum-operation takes one of " + known),
               "invalid-argument"};
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
           (!choice.global || !choice.shifts_plan || one.area.IsWorld());
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

}  // namespace farhorizon
