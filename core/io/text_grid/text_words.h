#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/result.h"

namespace farhorizon {

/// What stands between white space in a text, and where it begins.
struct TextWord {
  std::string text;
  std::int64_t line = 0;    ///< from 1
  std::int64_t column = 0;  ///< of bytes, from 1
};

/// The words of a text file, one after the other. Lines end with LF, CR LF or CR; a byte order mark
/// of UTF-8 at the beginning and DOS's end-of-file character (0x1A) are white space.
/// Cost: a buffer of 64 KiB, whatever the file; words beyond kMaxWord bytes lose their ends.
class TextWords {
 public:
  /// A byte longer than the longest number: double's lowest value in full, with some decimals.
  static constexpr std::size_t kMaxWord = 400;

  /// Errors: kIo.
  static Result<TextWords> Open(const std::filesystem::path& path);

  /// Makes white space of `separator`, too.
  void SeparateAt(char separator) { separator_ = separator; }
  /// What of the file lies ahead in the buffer; before the first word: its beginning.
  [[nodiscard]] std::string_view Ahead() const {
    return std::string_view(buffer_.data(), filled_).substr(at_);
  }

  /// The next word; false at the end of the file. `word` is reused so that no word allocates.
  bool Next(TextWord& word);

 private:
  explicit TextWords(std::ifstream file) : file_(std::move(file)) {}
  [[nodiscard]] bool IsSpace(int byte) const;
  // The next byte, -1 at the end.
  int Take();
  bool Fill();

  std::ifstream file_;
  std::array<char, std::size_t{1} << 16U> buffer_{};
  std::size_t at_ = 0;
  std::size_t filled_ = 0;
  std::int64_t line_ = 1;
  std::int64_t column_ = 0;
  bool after_cr_ = false;
  char separator_ = ' ';
};

/// `word` in quotation marks for a message: printable ASCII, no more than 24 characters of it.
std::string QuotedWord(const std::string& word);

/// "line 7, column 12".
std::string PlaceOf(const TextWord& word);

}  // namespace farhorizon
