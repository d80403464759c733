// A word is a cell; how cells stand in lines is looked at beside (grid_lines.h). The place of a
// word is kept for its error, whose remedy is a command for just what stands there.
#include "core/io/text_grid/body_cells.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "core/io/text_grid/grid_header.h"
#include "core/io/text_grid/grid_lines.h"
#include "core/io/text_grid/text_number.h"

namespace farhorizon {

namespace {

// Reserved at once; a file with more cells grows as vectors do.
constexpr std::int64_t kReservedCells = std::int64_t{1} << 22U;

// A command that writes `with` where a cell is just `word`. Words that a shell could take for
// something else are left for the user to write.
std::string Replacement(const std::string& word, const std::string& with) {
  const bool plain =
      word.size() < 24 && std::ranges::all_of(word, [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view("+-.#*/_").find(static_cast<char>(c)) != std::string_view::npos;
      });
  return "awk '{sub(/\\r$/, \"\"); for (i = 1; i <= NF; ++i) if ($i == \"" +
         (plain ? word : "WORD") + "\") $i = \"" + with + "\"} 1' IN > OUT";
}

// Whether the commas of `word` part cells, and not thousands: a group has not three digits.
bool PartsCells(std::string_view word) {
  std::size_t comma = word.find(',');
  while (comma != std::string_view::npos) {
    word.remove_prefix(comma + 1);
    comma = word.find_first_of(",.");
    if (std::min(comma, word.size()) != 3) return true;
    comma = word.find(',');
  }
  return false;
}

std::string RemedyFor(const std::string& word, const BodyRules& rules) {
  if (word.find(';') != std::string::npos)
    return "part the cells with blanks (sed 's/;/ /g' IN > OUT)";
  if (word.find(',') != std::string::npos) {
    return PartsCells(word) ? "part the cells with blanks (sed 's/,/ /g' IN > OUT)"
                            : "commas that part thousands must go (sed 's/,//g' IN > OUT)";
  }
  if (!rules.null_word.empty()) {
    return "a cell without data is " + QuotedWord(rules.null_word) +
           " in this grid, as its header says";
  }
  if (!rules.nodata_number.empty()) {
    return "where it means no data, write the header's number for that: " +
           Replacement(word, rules.nodata_number);
  }
  return "where it means no data, write a number that is no height for it and name that with "
         "--nodata -9999: " +
         Replacement(word, "-9999");
}

Error NoNumber(const TextWord& word, bool after_the_last, const BodyRules& rules) {
  const std::string what = "the grid has " + QuotedWord(word.text) + " in " + PlaceOf(word);
  return after_the_last
             ? BadGrid(what + ", after its last cell; take out what is no cell")
             : BadGrid(what + ", where a number must stand; " + RemedyFor(word.text, rules));
}

}  // namespace

Status CheckGridSize(const TextGrid& grid, std::int64_t max_cells) {
  if (grid.columns * grid.rows <= max_cells) return Ok{};
  return Error{ErrorCode::kResourceExhausted,
               "the raster has " + std::to_string(grid.columns) + " x " +
                   std::to_string(grid.rows) + " cells, the limit is " + std::to_string(max_cells) +
                   "; cut it or make it coarser",
               "raster-too-large"};
}

Status ReadBody(TextWords& words, TextWord first, const BodyRules& rules, TextGrid& grid) {
  const std::int64_t wanted = grid.columns * grid.rows;
  if (wanted > rules.most_read) return Ok{};
  GridLines lines(grid.columns);
  CommaRule commas;
  grid.cells.Reserve(static_cast<std::size_t>(std::min(wanted, kReservedCells)));
  TextWord word = std::move(first);
  for (bool more = !word.text.empty(); more; more = words.Next(word)) {
    std::optional<TextNumber> number = ParseNumber(word.text);
    if (number) {
      commas.Take(*number, word);
    } else if (!rules.null_word.empty() && word.text == rules.null_word) {
      number = TextNumber{.value = std::numeric_limits<double>::quiet_NaN()};
    } else {
      return NoNumber(word, lines.cells() >= wanted, rules);
    }
    lines.Take(word.line);
    if (lines.cells() <= wanted) grid.cells.Add(number->value, number->whole);
  }
  if (Status judged = commas.Judge(); !judged) return judged;
  return lines.Judge(grid.rows);
}

}  // namespace farhorizon
