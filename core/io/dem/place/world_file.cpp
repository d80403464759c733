// The six numbers, in this order: the step of x along a row, of y along a row, of x down a column,
// of y down a column, and x and y of the first cell's centre.
#include "core/io/dem/place/world_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>
#include <vector>

#include "core/io/file.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMostWorldFileBytes = 1024;  // ten times what six numbers of full length take

// "-30.0", "+30", and "30,5" as programs of some countries write it.
std::optional<double> NumberOf(std::string word) {
  std::ranges::replace(word, ',', '.');
  const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* last = word.data() + word.size();
  double value = 0;
  const auto [end, fault] = std::from_chars(first, last, value);
  return fault == std::errc() && end == last ? std::optional(value) : std::nullopt;
}

std::optional<std::array<double, 6>> GeoTransformOf(const std::string& text) {
  std::istringstream words(text);
  std::vector<double> n;
  for (std::string word; words >> word;) {
    const std::optional<double> number = NumberOf(word);
    if (!number) return std::nullopt;
    n.push_back(*number);
  }
  if (n.size() != 6) return std::nullopt;
  return std::array<double, 6>{n[4] - 0.5 * (n[0] + n[2]), n[0], n[2],
                               n[5] - 0.5 * (n[1] + n[3]), n[1], n[3]};
}

}  // namespace

std::optional<std::filesystem::path> FindBeside(const std::filesystem::path& path,
                                                const std::string& ending) {
  std::string capitals = ending;
  std::ranges::transform(capitals, capitals.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::error_code failure;
  for (const std::string& tried : {ending, capitals}) {
    std::filesystem::path beside = path;
    beside.replace_extension(tried);
    if (beside != path && std::filesystem::is_regular_file(beside, failure)) return beside;
  }
  return std::nullopt;
}

std::optional<WorldFile> FindWorldFile(const std::filesystem::path& path) {
  std::string ending = path.extension().string();  // with its dot
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::vector<std::string> endings;
  if (ending.size() > 2) endings.push_back({'.', ending[1], ending.back(), 'w'});
  if (!ending.empty()) endings.push_back(ending + "w");
  endings.emplace_back(".wld");
  for (const std::string& tried : endings) {
    const std::optional<std::filesystem::path> beside = FindBeside(path, tried);
    if (!beside) continue;
    WorldFile file = {beside->filename().string()};
    if (Result<std::string> text = ReadFile(*beside, kMostWorldFileBytes); text) {
      file.geotransform = GeoTransformOf(*text);
    }
    return file;
  }
  return std::nullopt;
}

}  // namespace farhorizon
