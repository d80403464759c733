// Reads numbers with std::from_chars, which rounds as strtod does and knows no locale. What it does
// not know (a plus, Fortran's D, decimal commas, Microsoft's infinities) is rewritten for it.
#include "core/io/text_grid/text_number.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>

namespace farhorizon {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// Where from_chars reads the whole of `text`, its value.
std::optional<double> WholeText(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, value);
  if (stop != end || text.find('(') != std::string_view::npos) return std::nullopt;
  if (failure == std::errc::result_out_of_range) {
    const bool small = text.find("e-") != std::string_view::npos;
    value = small ? 0 : std::numeric_limits<double>::infinity();
    return text.front() == '-' ? -value : value;
  }
  return failure == std::errc() ? std::optional(value) : std::nullopt;
}

// "1.#IND" and its kin, without a sign; decimals may follow as noughts.
std::optional<double> MicrosoftSpecial(std::string_view text) {
  if (!text.starts_with("1.#")) return std::nullopt;
  text.remove_prefix(3);
  while (!text.empty() && text.back() == '0') text.remove_suffix(1);
  if (text == "INF") return std::numeric_limits<double>::infinity();
  if (text == "IND" || text == "QNAN" || text == "SNAN") return kNan;
  return std::nullopt;
}

// What the one comma of `text` can be; nullopt where it can be no decimal comma.
std::optional<CommaUse> UseOfComma(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (text.find_first_of(".,", comma + 1) != std::string_view::npos) return std::nullopt;
  if (text.substr(0, comma).find('.') != std::string_view::npos) return std::nullopt;
  const std::size_t first = text.front() == '-' ? 1 : 0;
  const std::string_view before = text.substr(first, comma - first);
  std::string_view after = text.substr(comma + 1);
  const std::size_t digits = static_cast<std::size_t>(
      std::find_if_not(after.begin(), after.end(), IsDigit) - after.begin());
  if (digits == 0) return std::nullopt;
  const bool thousands = !before.empty() && before.size() <= 3 && before.front() != '0' &&
                         digits == 3 && after.size() == 3;
  return thousands ? CommaUse::kEither : CommaUse::kDecimal;
}

// As ParseNumber, for what from_chars does not read as it stands.
std::optional<TextNumber> ParseRewritten(std::string_view word) {
  std::string text(word);
  const bool negative = text.front() == '-';
  if (const auto special = MicrosoftSpecial(std::string_view(text).substr(negative ? 1 : 0))) {
    return TextNumber{.value = negative ? -*special : *special};
  }
  TextNumber number;
  if (const std::size_t comma = text.find(','); comma != std::string::npos) {
    const std::optional<CommaUse> use = UseOfComma(text);
    if (!use) return std::nullopt;
    number.comma = *use;
    text[comma] = '.';
  }
  // "1.5D+02", but not the d of "inf" and "nan" misspelt.
  const std::size_t exponent = text.find_first_of("dD");
  if (exponent != std::string::npos && exponent > 0 &&
      (IsDigit(text[exponent - 1]) || text[exponent - 1] == '.')) {
    text[exponent] = 'e';
  }
  const std::optional<double> value = WholeText(text);
  if (!value) return std::nullopt;
  number.value = *value;
  number.point = word.find('.') != std::string_view::npos;
  return number;
}

}  // namespace

std::optional<TextNumber> ParseNumber(std::string_view word) {
  if (word.empty() || word.size() >= TextWords::kMaxWord) return std::nullopt;
  if (word.front() == '+') {
    word.remove_prefix(1);
    if (word.empty() || word.front() == '-' || word.front() == '+') return std::nullopt;
  }
  std::int64_t integer = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, failure] = std::from_chars(word.data(), end, integer);
  if (stop == end && failure == std::errc()) {
    return TextNumber{.value = static_cast<double>(integer), .whole = true};
  }
  if (word.find_first_of(",#dD") == std::string_view::npos) {
    const std::optional<double> value = WholeText(word);
    if (!value) return std::nullopt;
    return TextNumber{.value = *value, .point = word.find('.') != std::string_view::npos};
  }
  return ParseRewritten(word);
}

void CommaRule::TakeComma(const TextNumber& number, const TextWord& word) {
  if (number.comma == CommaUse::kDecimal) decimal_ = true;
  if (!first_) first_ = word;
}

Status CommaRule::Judge() const {
  if (!first_ || (decimal_ && !has_point_)) return Ok{};
  const std::string why =
      has_point_ ? " has a comma, and other numbers have a decimal point"
                 : " may be a number of thousands or one with a decimal comma, and no other number "
                   "of the file decides it";
  return Error{ErrorCode::kUnsupportedData,
               "the grid's " + QuotedWord(first_->text) + " in " + PlaceOf(*first_) + why +
                   "; take the commas out where they part thousands (sed 's/,//g' IN > OUT), "
                   "write points where they are decimal (sed 's/,/./g' IN > OUT)",
               "not-a-raster"};
}

}  // namespace farhorizon
