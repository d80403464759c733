#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace farhorizon {

/// The lines of a text in memory, one after the other; they end with LF, CR LF or CR.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : text_(text) {}

  /// The next line without its end; false after the last.
  bool Next(std::string_view& line);
  /// The number of the line that Next has returned, from 1.
  [[nodiscard]] std::int64_t line() const { return line_; }
  /// Where the next line begins.
  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  std::int64_t line_ = 0;
};

/// Takes the first word of `rest`, up to white space; empty where none is left.
std::string_view TakeWord(std::string_view& rest);

/// The number that `word` is, all of it; also infinite and NaN. nullopt for other words.
std::optional<double> NumberOf(std::string_view word);
/// The same for whole numbers.
std::optional<std::int64_t> WholeNumberOf(std::string_view word);

}  // namespace farhorizon
