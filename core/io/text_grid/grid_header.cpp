// Keys are compared in lower case, and kept with the place of their value, which errors name. A key
// that stands twice is harmless where both say the same.
#include "core/io/text_grid/grid_header.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/lower.h"

namespace farhorizon {

namespace {

// The same number, or the same word.
bool SameValue(const std::string& a, const std::string& b) {
  const std::optional<TextNumber> x = ParseNumber(a);
  const std::optional<TextNumber> y = ParseNumber(b);
  return x && y ? x->value == y->value : a == b;
}

Error NoNumber(const std::string& key, const TextWord& word) {
  return BadGrid("the grid's header has " + QuotedWord(word.text) + " for " + key + " in line " +
                 std::to_string(word.line) +
                 ", which is no number; write it with digits and a decimal point alone, such as "
                 "420000.00");
}

}  // namespace

Error BadGrid(const std::string& what) {
  return {ErrorCode::kUnsupportedData, what, "not-a-raster"};
}

Status GridHeader::Add(const std::string& key, const TextWord& value) {
  const auto [known, fresh] = values_.emplace(key, value);
  if (fresh || SameValue(known->second.text, value.text)) return Ok{};
  return BadGrid("the grid's header says " + key + " twice: " + QuotedWord(known->second.text) +
                 " in line " + std::to_string(known->second.line) + " and " +
                 QuotedWord(value.text) + " in line " + std::to_string(value.line) +
                 "; leave the true one");
}

Result<GridHeader> GridHeader::ReadLines(TextWords& words) {
  GridHeader header;
  TextWord word;
  TextWord key;
  int in_line = 0;
  while (words.Next(word)) {
    in_line = word.line == key.line ? in_line + 1 : 0;
    if (in_line == 0) key = word;
    if (in_line != 1) continue;
    if (Status added = header.Add(Lower(key.text), word); !added) return std::move(added.error());
  }
  return header;
}

Result<GridHeader> GridHeader::Read(TextWords& words, const std::vector<std::string_view>& keys) {
  GridHeader header;
  TextWord word;
  while (words.Next(word)) {
    const std::string key = Lower(word.text);
    if (std::ranges::find(keys, key) == keys.end()) {
      header.body_ = std::move(word);
      return header;
    }
    TextWord value;
    if (!words.Next(value) || value.line != word.line) {
      return BadGrid("the grid's header has no value for " + key + " in line " +
                     std::to_string(word.line) + "; write it there, or make the file again");
    }
    if (Status added = header.Add(key, value); !added) return std::move(added.error());
  }
  return header;
}

const TextWord* GridHeader::Find(const std::string& key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? nullptr : &found->second;
}

Result<double> GridHeader::NumberOrNan(const std::string& key) const {
  const TextWord* word = Find(key);
  if (word == nullptr) {
    return BadGrid("the grid's header has no " + key + "; it is missing, or misspelt");
  }
  const std::optional<TextNumber> number = ParseNumber(word->text);
  if (!number || number->comma == CommaUse::kEither) return NoNumber(key, *word);
  return number->value;
}

Result<double> GridHeader::Number(const std::string& key) const {
  Result<double> number = NumberOrNan(key);
  if (number && !std::isfinite(*number)) return NoNumber(key, *Find(key));
  return number;
}

Result<std::int64_t> GridHeader::Count(const std::string& key) const {
  Result<double> number = Number(key);
  if (!number) return std::move(number.error());
  if (*number < 1 || *number > static_cast<double>(kMaxGridSide) ||
      *number != std::floor(*number)) {
    const TextWord& word = *Find(key);
    return BadGrid("the grid's header has " + QuotedWord(word.text) + " for " + key + " in line " +
                   std::to_string(word.line) + ", which must be a whole number from 1");
  }
  return static_cast<std::int64_t>(*number);
}

}  // namespace farhorizon
