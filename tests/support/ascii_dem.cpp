#include "tests/support/ascii_dem.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {
namespace {

std::int32_t HeightOf(const std::string& word) {
  if (word == ".") return kNoHeight;
  std::size_t used = 0;
  const int height = std::stoi(word, &used);
  Check(used == word.size(), "a height of a drawn DEM is a whole number");
  return height;
}

std::vector<std::int32_t> RowOf(const std::string& line) {
  std::istringstream words(line);
  std::vector<std::string> posts;
  for (std::string word; words >> word;) posts.push_back(word);
  std::vector<std::int32_t> row;
  if (posts.size() == 1) {
    for (const char c : posts[0]) row.push_back(HeightOf(std::string(1, c)));
  } else {
    for (const std::string& post : posts) row.push_back(HeightOf(post));
  }
  return row;
}

}  // namespace

Dem AsciiDem(std::string_view drawing) {
  Dem dem;
  std::istringstream lines{std::string(drawing)};
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::int32_t> row = RowOf(line);
    if (row.empty()) continue;
    if (dem.rows == 0) dem.columns = static_cast<std::int32_t>(row.size());
    Check(static_cast<std::size_t>(dem.columns) == row.size(),
          "the rows of a drawn DEM are equally long");
    dem.heights.insert(dem.heights.end(), row.begin(), row.end());
    ++dem.rows;
  }
  Check(dem.columns >= 2 && dem.rows >= 2, "a drawn DEM has two rows and two columns or more");
  return dem;
}

std::string DrawAscii(const Dem& dem) {
  std::vector<std::string> words;
  std::size_t width = 1;
  for (const std::int32_t height : dem.heights) {
    words.push_back(height == kNoHeight ? "." : std::to_string(height));
    width = std::max(width, words.back().size());
  }
  std::ostringstream out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool last = (i + 1) % static_cast<std::size_t>(dem.columns) == 0;
    out << std::setw(static_cast<int>(width)) << words[i] << (last ? '\n' : ' ');
  }
  return out.str();
}

}  // namespace farhorizon
