// PROJ's list of operations between two systems, each taken apart into its steps: conversions are
// exact, transformations are between datums and have a name, an accuracy and an area.
#include "core/geo/datum_operation.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>

#include <proj.h>

#include "core/geo/crs_name.h"

namespace farhorizon {

namespace {

using ListPtr = std::unique_ptr<PJ_OBJ_LIST, void (*)(PJ_OBJ_LIST*)>;

// The names and codes of inverses are those of the operations themselves:
// "Inverse of WGS 84 to EGM96 height (1)", "INVERSE(DERIVED_FROM(EPSG)):1149".
std::string Forward(std::string name) {
  constexpr std::string_view kInverse = "Inverse of ";
  for (std::size_t at = name.find(kInverse); at != std::string::npos; at = name.find(kInverse)) {
    name.erase(at, kInverse.size());
  }
  return name;
}

std::string PlainCode(const PJ* step) {
  std::string code = CodeOf(step);
  const std::size_t open = code.rfind('(');
  const std::size_t close = code.find(')');
  const std::size_t colon = code.find(':');
  if (open != std::string::npos && close != std::string::npos && colon != std::string::npos) {
    code = code.substr(open + 1, close - open - 1) + code.substr(colon);
  }
  return code;
}

std::string Joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : " + ") + part;
  return all;
}

// Exact are conversions, and what PROJ puts between two forms of one datum.
bool IsExact(const std::string& name) {
  constexpr std::array<std::string_view, 4> kExact = {"Null geographic offset", "axis order change",
                                                      "Conversion from ", "WGS 84 to WGS 84"};
  return std::ranges::any_of(kExact, [&](std::string_view e) { return name.starts_with(e); });
}

// PROJ joins several transformations to one where they go by one pipeline, and their names.
void AddStep(const PJ* step, DatumOperation& operation) {
  if (proj_get_type(step) == PJ_TYPE_CONVERSION) return;
  constexpr std::string_view kJoint = " + ";
  const char* text = proj_get_name(step);
  const std::string joined = Forward(text != nullptr ? text : "");
  const std::string code = joined.find(kJoint) == std::string::npos ? PlainCode(step) : "";
  for (std::size_t from = 0; from < joined.size();) {
    const std::size_t end = std::min(joined.find(kJoint, from), joined.size());
    const std::string name = joined.substr(from, end - from);
    from = end + kJoint.size();
    if (IsExact(name)) continue;
    if (name.find("ballpark vertical") != std::string::npos) operation.ballpark_heights = true;
    operation.names.push_back(name);
    operation.codes.push_back(code);
  }
}

// The steps of `way`, in their order: an inverse of a concatenated operation is a step of its own.
std::vector<ProjObject> StepsOf(const ProjSession& session, const PJ* way) {
  std::vector<ProjObject> steps;
  steps.emplace_back(proj_clone(session.get(), way));
  for (std::size_t i = 0; i < steps.size();) {
    const PJ* whole = steps[i].get();
    if (whole == nullptr || proj_get_type(whole) != PJ_TYPE_CONCATENATED_OPERATION) {
      ++i;
      continue;
    }
    std::vector<ProjObject> parts;
    const int count = proj_concatoperation_get_step_count(session.get(), whole);
    for (int k = 0; k < count; ++k) {
      parts.emplace_back(proj_concatoperation_get_step(session.get(), whole, k));
    }
    steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(i));
    steps.insert(steps.begin() + static_cast<std::ptrdiff_t>(i),
                 std::make_move_iterator(parts.begin()), std::make_move_iterator(parts.end()));
  }
  return steps;
}

void AddGrids(const ProjSession& session, DatumOperation& operation) {
  const PJ* way = operation.way.get();
  const int grids = proj_coordoperation_get_grid_used_count(session.get(), way);
  for (int i = 0; i < grids; ++i) {
    const char* name = nullptr;
    int available = 1;
    if (proj_coordoperation_get_grid_used(session.get(), way, i, &name, nullptr, nullptr, nullptr,
                                          nullptr, nullptr, &available) != 0 &&
        available == 0 && name != nullptr) {
      operation.missing_grids.emplace_back(name);
    }
  }
}

DatumOperation Read(const ProjSession& session, ProjObject way) {
  DatumOperation operation;
  operation.way = std::move(way);
  const PJ* whole = operation.way.get();
  for (const ProjObject& step : StepsOf(session, whole)) {
    if (step) AddStep(step.get(), operation);
  }
  operation.ballpark = proj_coordoperation_has_ballpark_transformation(session.get(), whole) != 0;
  const double accuracy = proj_coordoperation_get_accuracy(session.get(), whole);
  if (accuracy >= 0) operation.accuracy_m = accuracy;
  AddGrids(session, operation);
  operation.area = AreaOfUseOf(session, whole).value_or(AreaOfUse());
  return operation;
}

}  // namespace

std::string DatumOperation::Described() const {
  char accuracy[40] = "accuracy unknown";
  if (accuracy_m) std::snprintf(accuracy, sizeof accuracy, "accuracy %.3g m", *accuracy_m);
  const std::string stated = Stated();
  const std::string name = "\"" + Joined(names) + "\"";
  return name + " (" + ("\"" + stated + "\"" == name ? "" : stated + ", ") + accuracy + ")";
}

std::string DatumOperation::Stated() const {
  if (ballpark) return "ballpark";
  const bool coded = std::ranges::none_of(codes, [](const std::string& c) { return c.empty(); });
  return Joined(coded ? codes : names);
}

std::vector<DatumOperation> ListDatumOperations(const ProjSession& session, const PJ* source,
                                                const PJ* globe) {
  const std::unique_ptr<PJ_OPERATION_FACTORY_CONTEXT, void (*)(PJ_OPERATION_FACTORY_CONTEXT*)>
      factory(proj_create_operation_factory_context(session.get(), nullptr),
              proj_operation_factory_context_destroy);
  proj_operation_factory_context_set_spatial_criterion(session.get(), factory.get(),
                                                       PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
  proj_operation_factory_context_set_grid_availability_use(session.get(), factory.get(),
                                                           PROJ_GRID_AVAILABILITY_USED_FOR_SORTING);
  // PROJ does not know the area of a system that came without its code.
  if (const std::optional<AreaOfUse> area = AreaOfUseOf(session, source)) {
    proj_operation_factory_context_set_area_of_interest(session.get(), factory.get(), area->west,
                                                        area->south, area->east, area->north);
  }
  const ListPtr ways(proj_create_operations(session.get(), source, globe, factory.get()),
                     proj_list_destroy);
  std::vector<DatumOperation> all;
  const int count = ways ? proj_list_get_count(ways.get()) : 0;
  for (int i = 0; i < count; ++i) {
    all.push_back(Read(session, ProjObject(proj_list_get(session.get(), ways.get(), i))));
  }
  return all;
}

std::string OperationName(const ProjSession& session, const std::string& code) {
  const std::size_t colon = code.find(':');
  if (colon == std::string::npos) return "";
  const ProjObject found(proj_create_from_database(session.get(), code.substr(0, colon).c_str(),
                                                   code.substr(colon + 1).c_str(),
                                                   PJ_CATEGORY_COORDINATE_OPERATION, 0, nullptr));
  const char* name = found ? proj_get_name(found.get()) : nullptr;
  return name != nullptr ? name : "";
}

}  // namespace farhorizon
