// Counts the numbers of an ASCII grid, word by word, in pieces of the file. A word is judged by its
// characters alone: which value it has is left to GDAL.
#include "core/io/dem/ascii_grid.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string>
#include <string_view>

namespace farhorizon {

namespace {

constexpr std::array<std::string_view, 10> kHeaderWords = {
    "ncols",     "nrows", "xllcorner", "xllcenter",    "yllcorner",
    "yllcenter", "dx",    "dy",        "nodata_value", "cellsize"};
// Longer than any number or header word.
constexpr std::size_t kMaxWord = 64;

bool IsNumber(std::string_view word) {
  return std::ranges::all_of(word, [](char c) {
    return std::string_view("0123456789+-.,eEdD").find(c) != std::string_view::npos;
  });
}

// "nan", "inf", "-1.#QNAN" and the like, which GDAL reads and dem_reader judges by value.
bool IsSpecial(std::string_view word) {
  return std::ranges::all_of(word, [](char c) {
    return std::string_view("+-.#1").find(c) != std::string_view::npos ||
           std::string_view("nainfityqNAINFITYQ").find(c) != std::string_view::npos;
  });
}

// Counts numbers; header words and the values after them are none.
class Counter {
 public:
  // Takes the next word; false where no such grid has it.
  bool Take(std::string word) {
    if (value_of_header_word_) {
      value_of_header_word_ = false;
      return true;
    }
    if (IsNumber(word) || IsSpecial(word)) {
      ++numbers_;
      return true;
    }
    std::ranges::transform(word, word.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    value_of_header_word_ =
        numbers_ == 0 && std::ranges::find(kHeaderWords, word) != kHeaderWords.end();
    return value_of_header_word_;
  }
  [[nodiscard]] std::int64_t numbers() const { return numbers_; }

 private:
  bool value_of_header_word_ = false;
  std::int64_t numbers_ = 0;
};

}  // namespace

Status CheckAsciiGrid(const std::filesystem::path& path, std::int64_t posts) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return Error{ErrorCode::kIo, "the grid cannot be opened"};
  Counter counter;
  std::string word;
  std::array<char, 1 << 16> piece{};
  const auto refuse = [&] {
    return Error{ErrorCode::kUnsupportedData,
                 "the grid has \"" + word.substr(0, 20) + "\" where a number is wanted, after " +
                     std::to_string(counter.numbers()) + " cells",
                 "not-a-raster"};
  };
  while (in.read(piece.data(), piece.size()) || in.gcount() > 0) {
    for (const char c : std::string_view(piece.data(), static_cast<std::size_t>(in.gcount()))) {
      if (std::isspace(static_cast<unsigned char>(c)) == 0) {
        word += c;
        if (word.size() > kMaxWord) return refuse();
      } else if (!word.empty()) {
        if (!counter.Take(word)) return refuse();
        word.clear();
      }
    }
  }
  if (!word.empty() && !counter.Take(word)) return refuse();
  if (counter.numbers() < posts) {
    return Error{ErrorCode::kUnsupportedData,
                 "the raster is not complete: the grid has " + std::to_string(counter.numbers()) +
                     " of its " + std::to_string(posts) + " cells; fetch or make the file again",
                 "truncated"};
  }
  return Ok{};
}

}  // namespace farhorizon
