// Reads the options of a build from text and checks them. One list of names serves jobs and the
// command line, whose flags are turned into parameters; the messages name parameters.
#include "core/pipeline/build_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

namespace farhorizon {

namespace {

Error Invalid(const std::string& name, const std::string& value, const std::string& expected) {
  return {ErrorCode::kInvalidArgument, name + " is \"" + value + "\", expected " + expected,
          "invalid-parameter"};
}

template <typename Number>
bool ReadNumber(const std::string& text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, number);
  return failure == std::errc() && stop == end;
}

std::string Text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::vector<std::string> SplitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

Status Read(const std::string& name, const std::string& value, BuildOptions& options) {
  const auto read_metres = [&](double& metres) -> Status {
    if (!ReadNumber(value, metres)) return Invalid(name, value, "a number of metres");
    return Ok{};
  };
  if (name == "levels") {
    if (!ReadNumber(value, options.levels)) return Invalid(name, value, "a number from 1 to 12");
    return Ok{};
  }
  if (name == "maxError") return read_metres(options.max_error_m.emplace());
  if (name == "silhouetteError") return read_metres(options.silhouette_error_m);
  if (name == "formats") {
    options.formats = SplitAtCommas(value);
    return Ok{};
  }
  if (name == "crs") {
    options.crs = value;
    return Ok{};
  }
  if (name == "verticalDatum") {
    options.vertical_datum = value;
    return Ok{};
  }
  if (name == "nodata") {
    if (!ReadNumber(value, options.nodata.emplace_back())) return Invalid(name, value, "a number");
    return Ok{};
  }
  if (name == "workBudget") {
    if (!ReadNumber(value, options.work_budget.emplace())) {
      return Invalid(name, value, "a whole number");
    }
    return Ok{};
  }
  if (name == "approximate") {
    if (value != "true" && value != "false") return Invalid(name, value, "true or false");
    options.approximate = value == "true";
    return Ok{};
  }
  return Error{ErrorCode::kInvalidArgument,
               "there is no parameter \"" + name +
                   "\"; known are levels, maxError, silhouetteError, formats, crs, "
                   "verticalDatum, nodata, workBudget and approximate",
               "unknown-parameter"};
}

}  // namespace

Status CheckOptions(const BuildOptions& options) {
  if (options.levels < 1 || options.levels > 12) {
    return Invalid("levels", std::to_string(options.levels), "1 to 12");
  }
  if (options.max_error_m && !(*options.max_error_m > 0 && *options.max_error_m <= 1e5)) {
    return Invalid("maxError", Text(*options.max_error_m), "more than 0, at most 100000 metres");
  }
  if (!(options.silhouette_error_m >= 0 && options.silhouette_error_m <= 1e5)) {
    return Invalid("silhouetteError", Text(options.silhouette_error_m), "0 to 100000 metres");
  }
  if (options.work_budget && *options.work_budget < 1) {
    return Invalid("workBudget", std::to_string(*options.work_budget), "1 or more");
  }
  if (options.formats.empty()) return Invalid("formats", "", "at least one format");
  constexpr std::array kKnown = {"3dtiles", "drc", "geojson", "flatgeobuf"};
  for (const std::string& format : options.formats) {
    if (std::find(kKnown.begin(), kKnown.end(), format) == kKnown.end()) {
      return Invalid("formats", format, "of 3dtiles, drc, geojson and flatgeobuf");
    }
  }
  if (options.threads < 1 || options.threads > 1024) {
    return Invalid("threads", std::to_string(options.threads), "1 to 1024");
  }
  return Ok{};
}

Result<BuildOptions> ParseOptions(const std::map<std::string, std::string>& parameters) {
  BuildOptions options;
  for (const auto& [name, value] : parameters) {
    Status read = Read(name, value, options);
    if (!read) return std::move(read.error());
  }
  Status checked = CheckOptions(options);
  if (!checked) return std::move(checked.error());
  return options;
}

HorizonOptions HorizonOptionsOf(const BuildOptions& options) {
  return {.threads = options.threads,
          .work_budget = options.work_budget,
          .approximate = options.approximate};
}

}  // namespace farhorizon
