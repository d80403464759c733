// Reads the options of a build from text and checks them. One list of parameters serves jobs and the
// command line, whose flags are turned into parameters; the messages name the flags.
#include "core/pipeline/build_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

namespace farhorizon {

namespace {

// Each of these is compared with every post of the DEM.
constexpr std::size_t kMostNodataValues = 16;
// Doubles are at least this fine up to here, so that a whole number written as one is what it says.
constexpr double kLargestWholeDouble = 9007199254740992;  // 2^53

Error Invalid(std::string_view name, const std::string& value, const std::string& expected) {
  return {ErrorCode::kInvalidArgument, FlagOf(name) + " is \"" + value + "\", expected " + expected,
          "invalid-parameter"};
}

// Takes a sign of both kinds, where std::from_chars takes a minus alone.
template <typename Number>
bool ReadNumber(std::string_view text, Number& number) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, number);
  return failure == std::errc() && stop == end;
}

// Programs whose numbers are all doubles write 3 as 3.0, and 1000000 as 1e6.
template <typename Whole>
bool ReadWhole(const std::string& text, Whole& number) {
  if (ReadNumber(text, number)) return true;
  double value = 0;
  if (!ReadNumber(text, value) || value != std::trunc(value)) return false;
  if (!(std::abs(value) <= kLargestWholeDouble) ||
      !std::in_range<Whole>(static_cast<std::int64_t>(value))) {
    return false;
  }
  number = static_cast<Whole>(value);
  return true;
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

Status ReadMetres(std::string_view name, const std::string& value, double& metres) {
  if (!ReadNumber(value, metres)) return Invalid(name, value, "a number of metres");
  return Ok{};
}

// A text that an empty value or one with a NUL, where C's strings end, cannot be.
Status ReadText(std::string_view name, const std::string& value, const char* expected,
                std::optional<std::string>& text) {
  if (value.empty() || value.find('\0') != std::string::npos) return Invalid(name, value, expected);
  text = value;
  return Ok{};
}

Status ReadNodata(std::string_view name, const std::string& value, std::vector<double>& nodata) {
  for (std::size_t start = 0; start <= value.size();) {
    const std::size_t end = std::min(value.find(',', start), value.size());
    std::string_view part = std::string_view(value).substr(start, end - start);
    while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
    while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
    if (!ReadNumber(part, nodata.emplace_back())) {
      return Invalid(name, value, "a number, inf, -inf or nan, or several with commas between");
    }
    start = end + 1;
  }
  if (nodata.size() <= kMostNodataValues) return Ok{};
  return Invalid(name, value, "at most " + std::to_string(kMostNodataValues) + " values");
}

using ReadParameter = Status (*)(std::string_view name, const std::string& value,
                                 BuildOptions& options);
struct Parameter {
  std::string_view name;
  ReadParameter read;
};

constexpr std::array kParameters = {
    Parameter{"levels",
              [](std::string_view name, const std::string& value, BuildOptions& options) -> Status {
                if (ReadWhole(value, options.levels)) return Ok{};
                return Invalid(name, value, "a whole number from 1 to 12");
              }},
    Parameter{"maxError",
              [](std::string_view name, const std::string& value, BuildOptions& options) {
                return ReadMetres(name, value, options.max_error_m.emplace());
              }},
    Parameter{"silhouetteError",
              [](std::string_view name, const std::string& value, BuildOptions& options) {
                return ReadMetres(name, value, options.silhouette_error_m);
              }},
    Parameter{"formats",
              [](std::string_view, const std::string& value, BuildOptions& options) -> Status {
                options.formats = SplitAtCommas(value);
                return Ok{};
              }},
    Parameter{"crs",
              [](std::string_view name, const std::string& value, BuildOptions& options) {
                return ReadText(name, value, "a code such as EPSG:4326, WKT or a PROJ string",
                                options.crs);
              }},
    Parameter{"verticalDatum",
              [](std::string_view name, const std::string& value, BuildOptions& options) {
                return ReadText(name, value, "a code such as EPSG:5773, WKT or \"ellipsoid\"",
                                options.vertical_datum);
              }},
    Parameter{"heightUnit",
              [](std::string_view name, const std::string& value, BuildOptions& options) {
                return ReadText(name, value, "m, ft or us-ft", options.height_unit);
              }},
    Parameter{"datumOperation",
              [](std::string_view name, const std::string& value, BuildOptions& options) {
                return ReadText(name, value, "a coordinate operation", options.datum_operation);
              }},
    Parameter{"nodata",
              [](std::string_view name, const std::string& value, BuildOptions& options) {
                return ReadNodata(name, value, options.nodata);
              }},
    Parameter{"workBudget",
              [](std::string_view name, const std::string& value, BuildOptions& options) -> Status {
                if (ReadWhole(value, options.work_budget.emplace())) return Ok{};
                return Invalid(name, value, "a whole number");
              }},
    Parameter{"approximate",
              [](std::string_view name, const std::string& value, BuildOptions& options) -> Status {
                options.approximate = value == "true";
                if (options.approximate || value == "false") return Ok{};
                return Invalid(name, value, "true or false");
              }},
};

Error NoSuchParameter(const std::string& name) {
  std::string known;
  for (const std::string_view one : ParameterNames()) {
    known.append(known.empty() ? "" : ", ").append(one);
  }
  return {ErrorCode::kInvalidArgument, "there is no parameter \"" + name + "\"; known are " + known,
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
  const std::string unit = options.height_unit.value_or("m");
  if (unit != "m" && unit != "ft" && unit != "us-ft") {
    return Invalid("heightUnit", unit, "m, ft or us-ft");
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

std::vector<std::string_view> ParameterNames() {
  std::vector<std::string_view> names;
  for (const Parameter& parameter : kParameters) names.push_back(parameter.name);
  return names;
}

std::string FlagOf(std::string_view parameter) {
  std::string flag = "--";
  for (const char c : parameter) {
    const bool upper = c >= 'A' && c <= 'Z';
    if (upper) flag += '-';
    flag += upper ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return flag;
}

Result<BuildOptions> ParseOptions(const std::map<std::string, std::string>& parameters) {
  BuildOptions options;
  for (const auto& [name, value] : parameters) {
    const auto* known = std::find_if(kParameters.begin(), kParameters.end(),
                                     [&](const Parameter& one) { return one.name == name; });
    if (known == kParameters.end()) return NoSuchParameter(name);
    Status read = known->read(name, value, options);
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
