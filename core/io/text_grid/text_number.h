#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/io/text_grid/text_words.h"

namespace farhorizon {

/// What a comma in a number can be.
enum class CommaUse {
  kNone,
  kDecimal,  ///< "200,50", "0,125", "1234,500": no thousands are written so
  kEither,   ///< "1,234": 1.234 or 1234
};

/// A number as people and programs write it.
struct TextNumber {
  double value = 0;
  bool whole = false;  ///< digits and a sign alone
  bool point = false;  ///< it has a decimal point
  CommaUse comma = CommaUse::kNone;
};

/// Reads `word` as a number: "12", "+1.5e3", Fortran's "1.5D+02", "200,50", "nan", "-inf", and what
/// Microsoft's C prints for those ("-1.#IND", "1.#QNAN", "1.#INF00"). nullopt where any of its
/// characters is left over: "1,234.50", "1e5e", "0x1F", "-", "NA".
/// Values beyond double's are infinite, as strtod has them.
std::optional<TextNumber> ParseNumber(std::string_view word);

/// Whether the commas of a text are decimal commas. "1,234" alone does not say it; "0,5" anywhere
/// in the text does, and a point in another number denies it.
class CommaRule {
 public:
  /// Takes a number of the text that stands at `word`.
  void Take(const TextNumber& number, const TextWord& word) {
    if (number.point) has_point_ = true;
    if (number.comma != CommaUse::kNone) TakeComma(number, word);
  }
  /// Errors: kUnsupportedData "not-a-raster" where the commas may be, or are, those of thousands.
  [[nodiscard]] Status Judge() const;

 private:
  void TakeComma(const TextNumber& number, const TextWord& word);

  bool has_point_ = false;
  bool decimal_ = false;
  std::optional<TextWord> first_;
};

}  // namespace farhorizon
