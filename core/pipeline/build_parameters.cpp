// Reads the options of a build from text. One list of parameters serves jobs and the command line,
// whose flags are turned into parameters; the messages name the flags.
#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <sstream>
#include <utility>

#include "core/pipeline/build_options.h"
#include "core/pipeline/given_parameter.h"
#include "core/pipeline/option_numbers.h"

namespace farhorizon {

namespace {

using Given = GivenParameter;

// Each of these is compared with every post of the DEM.
constexpr std::size_t kMostNodataValues = 16;

std::vector<std::string> SplitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

template <typename Whole>
Status ReadCount(const Given& given, const char* expected, Whole& count) {
  const std::optional<std::int64_t> number = WholeNumberIn(given.value);
  if (!number || !std::in_range<Whole>(*number)) return given.Expected(expected);
  count = static_cast<Whole>(*number);
  return Ok{};
}

Status ReadMetres(const Given& given, const char* expected, double& metres) {
  const std::optional<double> number = NumberIn(given.value);
  if (!number) return given.Expected(expected);
  metres = *number;
  return Ok{};
}

Status ReadFlag(const Given& given, bool& flag) {
  flag = given.value == "true";
  if (!flag && given.value != "false") return given.Expected("true or false");
  return Ok{};
}

// A text that an empty value or one with a NUL, where C's strings end, cannot be.
Status ReadText(const Given& given, const char* expected, std::optional<std::string>& text) {
  const bool usable = !given.value.empty() && given.value.find('\0') == std::string::npos;
  if (!usable) return given.Expected(expected);
  text = given.value;
  return Ok{};
}

Status ReadNodata(const Given& given, std::vector<double>& nodata) {
  std::optional<std::vector<double>> numbers = NumbersIn(given.value);
  if (!numbers) return given.Expected("a number, inf, -inf or nan, or several with commas between");
  if (numbers->size() > kMostNodataValues) {
    return given.Expected("at most " + std::to_string(kMostNodataValues) + " values");
  }
  nodata = *std::move(numbers);
  return Ok{};
}

// Levels in any order: the one of the most triangles is level 0.
Status ReadTriangles(const Given& given, std::vector<std::int64_t>& triangles) {
  std::optional<std::vector<std::int64_t>> numbers = WholeNumbersIn(given.value);
  if (!numbers) return given.Expected("a whole number, or several with commas between");
  std::ranges::sort(*numbers, std::greater<>());
  triangles = *std::move(numbers);
  return Ok{};
}

// The value that one of the words of `known` stands for.
template <typename Value, std::size_t count>
Status ReadWord(const Given& given, const std::pair<std::string_view, Value> (&known)[count],
                Value& value) {
  std::string words;
  for (const auto& [word, its_value] : known) {
    if (given.value == word) {
      value = its_value;
      return Ok{};
    }
    words.append(words.empty() ? "" : ", ").append(word);
  }
  return given.Expected("one of " + words);
}

constexpr std::pair<std::string_view, EdgeFiles> kEdgeFiles[] = {{"lines", EdgeFiles::kLines},
                                                                 {"inline", EdgeFiles::kInline},
                                                                 {"both", EdgeFiles::kBoth},
                                                                 {"none", EdgeFiles::kNone}};

constexpr std::pair<std::string_view, HorizonDetail> kHorizonDetails[] = {
    {"chains", HorizonDetail::kChains}, {"edges", HorizonDetail::kEdges}};

struct Parameter {
  std::string_view name;
  Status (*read)(const Given& given, BuildOptions& options);
};
using Options = BuildOptions;
constexpr std::array kParameters = {
    Parameter{"levels",
              [](const Given& given, Options& options) {
                return ReadCount(given, "a whole number from 1 to 12", options.levels);
              }},
    Parameter{"maxError",
              [](const Given& given, Options& options) {
                return ReadMetres(given, "a number of metres", options.max_error_m.emplace());
              }},
    Parameter{"silhouetteError",
              [](const Given& given, Options& options) {
                return ReadMetres(given, "a number of metres", options.silhouette_error_m);
              }},
    Parameter{"triangles",
              [](const Given& given, Options& options) {
                return ReadTriangles(given, options.triangles);
              }},
    Parameter{"formats",
              [](const Given& given, Options& options) -> Status {
                options.formats = SplitAtCommas(given.value);
                return Ok{};
              }},
    Parameter{"crs",
              [](const Given& given, Options& options) {
                return ReadText(given, "a code such as EPSG:4326, WKT or a PROJ string",
                                options.crs);
              }},
    Parameter{"verticalDatum",
              [](const Given& given, Options& options) {
                return ReadText(given, "a code such as EPSG:5773, WKT or \"ellipsoid\"",
                                options.vertical_datum);
              }},
    Parameter{"heightUnit",
              [](const Given& given, Options& options) {
                return ReadText(given, "m, ft or us-ft", options.height_unit);
              }},
    Parameter{"datumOperation",
              [](const Given& given, Options& options) {
                return ReadText(given,
                                "a code such as EPSG:1173, a name of PROJ's, or \"ballpark\"",
                                options.datum_operation);
              }},
    Parameter{"nodata", [](const Given& given,
                           Options& options) { return ReadNodata(given, options.nodata); }},
    Parameter{"workBudget",
              [](const Given& given, Options& options) {
                return ReadCount(given, "a whole number", options.work_budget.emplace());
              }},
    Parameter{"approximate", [](const Given& given,
                                Options& options) { return ReadFlag(given, options.approximate); }},
    Parameter{"horizonDetail",
              [](const Given& given, Options& options) {
                return ReadWord(given, kHorizonDetails, options.horizon_detail);
              }},
    Parameter{"edges", [](const Given& given,
                          Options& options) { return ReadWord(given, kEdgeFiles, options.edges); }},
    Parameter{"skirt",
              [](const Given& given, Options& options) -> Status {
                if (given.value == "auto") return Ok{};
                return ReadMetres(given, "auto, or a number of metres", options.skirt_m.emplace());
              }},
    Parameter{"frame",
              [](const Given& given, Options& options) -> Status {
                const std::optional<FrameChoice> frame = FrameFromText(given.value);
                if (!frame) {
                  return given.Expected(
                      "tile, globe, or longitude and latitude in degrees such as 7.5,46");
                }
                options.frame = *frame;
                return Ok{};
              }},
    Parameter{"apron",
              [](const Given& given, Options& options) {
                return ReadCount(given, "a whole number from 0 to 1000", options.apron);
              }},
    Parameter{"horizonContext",
              [](const Given& given, Options& options) {
                return ReadFlag(given, options.horizon_context);
              }},
    Parameter{"tileTriangles",
              [](const Given& given, Options& options) {
                return ReadCount(given, "0, or a whole number from 1000 on",
                                 options.tile_triangles);
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

// Levels are asked for by their triangles, or by what the others say.
Status CheckOneWayToAsk(const std::map<std::string, std::string>& parameters) {
  if (!parameters.contains("triangles")) return Ok{};
  for (const char* name : {"levels", "maxError", "silhouetteError"}) {
    if (!parameters.contains(name)) continue;
    return Error{ErrorCode::kInvalidArgument,
                 "--triangles and " + FlagOf(name) +
                     " are both given; --triangles takes the place of --levels, --max-error and "
                     "--silhouette-error: leave one out",
                 "invalid-parameter"};
  }
  return Ok{};
}

}  // namespace

std::vector<std::string_view> ParameterNames() {
  std::vector<std::string_view> names;
  names.reserve(kParameters.size());
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
    Status read = known->read({known->name, value}, options);
    if (!read) return std::move(read.error());
  }
  if (Status one = CheckOneWayToAsk(parameters); !one) return std::move(one.error());
  Status checked = CheckOptions(options);
  if (!checked) return std::move(checked.error());
  return options;
}

}  // namespace farhorizon
