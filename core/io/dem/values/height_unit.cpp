// Names of units are brought to one spelling (lower case, without marks and trailing words) and
// looked up in one list. The rule that chooses among several sources is in the header; the first
// source that decides is kept, the others are compared with it.
#include "core/io/dem/values/height_unit.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/geo/height_system.h"
#include "core/geo/short_text.h"

namespace farhorizon {

namespace {

constexpr double kFoot = 0.3048;
constexpr double kSurveyFoot = 1200.0 / 3937;
constexpr const char* kRemedy = "; state the unit with --height-unit m, ft or us-ft";

struct Spelling {
  std::string_view text;  // as Plain leaves it
  std::string_view unit;
  double metres;
};

constexpr std::string_view kMetreName = "metre";
constexpr std::string_view kFootName = "foot";
constexpr std::string_view kSurveyFootName = "US survey foot";

constexpr auto kSpellings = std::to_array<Spelling>({
    {"m", kMetreName, 1},
    {"metre", kMetreName, 1},
    {"metres", kMetreName, 1},
    {"meter", kMetreName, 1},
    {"meters", kMetreName, 1},
    {"mtr", kMetreName, 1},
    {"ft", kFootName, kFoot},
    {"foot", kFootName, kFoot},
    {"feet", kFootName, kFoot},
    {"ft i", kFootName, kFoot},
    {"ift", kFootName, kFoot},
    {"int ft", kFootName, kFoot},
    {"ft int", kFootName, kFoot},
    {"intl foot", kFootName, kFoot},
    {"foot intl", kFootName, kFoot},
    {"international foot", kFootName, kFoot},
    {"international feet", kFootName, kFoot},
    {"foot international", kFootName, kFoot},
    {"us ft", kSurveyFootName, kSurveyFoot},
    {"usft", kSurveyFootName, kSurveyFoot},
    {"ft us", kSurveyFootName, kSurveyFoot},
    {"ftus", kSurveyFootName, kSurveyFoot},
    {"us foot", kSurveyFootName, kSurveyFoot},
    {"us feet", kSurveyFootName, kSurveyFoot},
    {"foot us", kSurveyFootName, kSurveyFoot},
    {"feet us", kSurveyFootName, kSurveyFoot},
    {"sft", kSurveyFootName, kSurveyFoot},
    {"sfoot", kSurveyFootName, kSurveyFoot},
    {"survey foot", kSurveyFootName, kSurveyFoot},
    {"survey feet", kSurveyFootName, kSurveyFoot},
    {"us survey foot", kSurveyFootName, kSurveyFoot},
    {"us survey feet", kSurveyFootName, kSurveyFoot},
    {"us survey ft", kSurveyFootName, kSurveyFoot},
    {"foot us survey", kSurveyFootName, kSurveyFoot},
    {"yd", "yard", 0.9144},
    {"yard", "yard", 0.9144},
    {"yards", "yard", 0.9144},
    {"fathom", "fathom", 1.8288},
    {"fathoms", "fathom", 1.8288},
    {"km", "kilometre", 1000},
    {"kilometre", "kilometre", 1000},
    {"kilometer", "kilometre", 1000},
    {"dm", "decimetre", 0.1},
    {"decimetre", "decimetre", 0.1},
    {"decimeter", "decimetre", 0.1},
    {"decimetres", "decimetre", 0.1},
    {"decimeters", "decimetre", 0.1},
    {"cm", "centimetre", 0.01},
    {"centimetre", "centimetre", 0.01},
    {"centimeter", "centimetre", 0.01},
    {"centimetres", "centimetre", 0.01},
    {"centimeters", "centimetre", 0.01},
    {"mm", "millimetre", 0.001},
    {"millimetre", "millimetre", 0.001},
    {"millimeter", "millimetre", 0.001},
    {"millimetres", "millimetre", 0.001},
    {"millimeters", "millimetre", 0.001},
});

// Words that begin what may follow a unit: the datum, which is not read from here.
constexpr auto kAfterUnit =
    std::to_array<std::string_view>({" above ", " over ", " asl", " amsl", " msl", " a s l"});

// Small letters and single blanks: "[ft_us]", "U.S. survey foot", "Meters (above sea level)".
std::string Plain(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '.' || c == '\'') continue;
    if (std::isalnum(byte) != 0 || byte >= 0x80 || c == '*' || c == '/') {
      plain += static_cast<char>(std::tolower(byte));
    } else if (!plain.empty() && plain.back() != ' ') {
      plain += ' ';
    }
  }
  plain += ' ';
  for (const std::string_view words : kAfterUnit) plain = plain.substr(0, plain.find(words));
  while (plain.ends_with(' ')) plain.pop_back();
  return plain;
}

bool IsMetre(const HeightUnit& unit) { return unit.metres == 1; }

// Feet differ from survey feet by two millionths, and files round both: by less than this.
bool Same(const HeightUnit& a, const HeightUnit& b) {
  return std::abs(a.metres - b.metres) <= 1e-7 * b.metres;
}

// Of systems and keys, in the order in which they count.
std::array<const std::optional<HeightUnit>*, 3> SystemsOf(const HeightUnitSources& sources) {
  return {&sources.call_system, &sources.file_key, &sources.file_system};
}

// The unit that counts by the rule of DecideHeightUnit; null where none is said.
const HeightUnit* FirstSaid(const HeightUnitSources& sources) {
  if (sources.band) return &*sources.band;
  for (const bool metre : {false, true}) {
    for (const std::optional<HeightUnit>* said : SystemsOf(sources)) {
      if (*said && IsMetre(**said) == metre) return &**said;
    }
  }
  return nullptr;
}

// "EPSG:5773 of the file says metre": every source that says another unit than `decided`.
std::string SaidOtherwise(const HeightUnitSources& sources, const HeightUnit& decided) {
  std::string otherwise;
  for (const std::optional<HeightUnit>* said : SystemsOf(sources)) {
    if (!*said || Same(**said, decided)) continue;
    otherwise += (otherwise.empty() ? "" : " and ") + (*said)->source + " says " + (*said)->name;
  }
  return otherwise;
}

}  // namespace

Result<HeightUnit> ReadHeightUnit(const std::string& name) {
  const std::string plain = Plain(name);
  for (const Spelling& spelling : kSpellings) {
    if (plain == spelling.text) {
      return HeightUnit{.name = std::string(spelling.unit), .metres = spelling.metres};
    }
  }
  if (const std::optional<LengthUnit> listed = ListedLengthUnit(name)) {
    return HeightUnit{.name = listed->name, .metres = listed->metres};
  }
  return Error{ErrorCode::kUnsupportedData,
               "the band's values are in \"" + ShortText(name, 40) +
                   "\", which is no unit of heights that is known" + kRemedy,
               "unknown-unit"};
}

HeightUnit DecideHeightUnit(const HeightUnitSources& sources, Assumptions& assumptions) {
  if (sources.stated) return *sources.stated;
  const HeightUnit* decided = FirstSaid(sources);
  // A datum that the call names in metres over a file that says nothing: is it the unit, too?
  const bool doubtful = decided != nullptr && sources.call_system &&
                        decided == &*sources.call_system && IsMetre(*decided) &&
                        !sources.map_unit.empty() && !sources.file_system;
  if (decided == nullptr || doubtful) {
    const std::string why =
        doubtful ? "as " + decided->source + " says" : "for nothing says their unit";
    const std::string map = sources.map_unit.empty()
                                ? ""
                                : ", though the map is in the unit \"" + sources.map_unit + "\"";
    assumptions.push_back({"height-unit", "heights are taken as metres, " + why + map + kRemedy});
    return HeightUnit{.name = std::string(kMetreName)};
  }
  const std::string otherwise = SaidOtherwise(sources, *decided);
  if (!otherwise.empty()) {
    assumptions.push_back({"height-unit", "the unit of the heights is taken as the " +
                                              decided->name + ", as " + decided->source +
                                              " says, though " + otherwise + kRemedy});
  }
  return *decided;
}

}  // namespace farhorizon
