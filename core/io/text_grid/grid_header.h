#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/io/text_grid/text_number.h"
#include "core/io/text_grid/text_words.h"

namespace farhorizon {

/// A count of columns or rows at most this: far beyond any limit of this program, and the product
/// of two is exact.
inline constexpr std::int64_t kMaxGridSide = 1'000'000'000;

/// The header of a text grid: pairs of a key and a value on one line, before the first cell.
class GridHeader {
 public:
  /// Reads pairs from `words` until a word comes that is none of `keys` (lower case); that word is
  /// `body()`, the first cell or no header word at all.
  /// Errors: kUnsupportedData "not-a-raster" for a key without a value, or with two that differ.
  static Result<GridHeader> Read(TextWords& words, const std::vector<std::string_view>& keys);

  /// Reads a file that is all header: a key and a value on each line, whatever the keys, and
  /// whatever follows on a line. Lines of one word are passed over.
  static Result<GridHeader> ReadLines(TextWords& words);

  [[nodiscard]] const TextWord& body() const { return body_; }
  [[nodiscard]] bool Has(const std::string& key) const { return values_.contains(key); }
  /// The value of `key` as it is written, or nullptr.
  [[nodiscard]] const TextWord* Find(const std::string& key) const;
  /// Errors, of all below: kUnsupportedData "not-a-raster", which names the key, the word and the
  ///   line, or says that the key is missing.
  [[nodiscard]] Result<double> Number(const std::string& key) const;
  /// As Number, and infinities and NaN are numbers, too.
  [[nodiscard]] Result<double> NumberOrNan(const std::string& key) const;
  /// A whole number from 1 to kMaxGridSide.
  [[nodiscard]] Result<std::int64_t> Count(const std::string& key) const;

 private:
  Status Add(const std::string& key, const TextWord& value);

  std::map<std::string, TextWord> values_;
  TextWord body_;
};

/// The error of kind "not-a-raster" for a text grid; `what` says what is wrong with it.
Error BadGrid(const std::string& what);

}  // namespace farhorizon
