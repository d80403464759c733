// Splits a text file into words in pieces of the file, and counts its lines.
#include "core/io/text_grid/text_words.h"

namespace farhorizon {

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

}  // namespace

bool TextWords::IsSpace(int byte) const {
  return byte == ' ' || (byte >= '\t' && byte <= '\r') || byte == 0x1a || byte == separator_;
}

Result<TextWords> TextWords::Open(const std::filesystem::path& path) {
  TextWords words(std::ifstream(path, std::ios::binary));
  if (!words.file_) {
    return Error{ErrorCode::kIo, path.filename().string() + " cannot be opened", "io"};
  }
  words.Fill();
  if (std::string_view(words.buffer_.data(), words.filled_).starts_with(kByteOrderMark)) {
    words.at_ = kByteOrderMark.size();
  }
  return words;
}

bool TextWords::Fill() {
  file_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  filled_ = static_cast<std::size_t>(file_.gcount());
  at_ = 0;
  return filled_ > 0;
}

int TextWords::Take() {
  if (at_ == filled_ && !Fill()) return -1;
  const auto byte = static_cast<unsigned char>(buffer_[at_++]);
  // LF after CR belongs to the line that CR has ended.
  if (byte == '\r' || (byte == '\n' && !after_cr_)) {
    ++line_;
    column_ = 0;
  } else if (byte != '\n') {
    ++column_;
  }
  after_cr_ = byte == '\r';
  return byte;
}

bool TextWords::Next(TextWord& word) {
  word.text.clear();
  int byte = Take();
  while (byte != -1 && IsSpace(byte)) byte = Take();
  word.line = line_;
  word.column = column_;
  for (; byte != -1 && !IsSpace(byte); byte = Take()) {
    if (word.text.size() < kMaxWord) word.text += static_cast<char>(byte);
  }
  return !word.text.empty();
}

std::string QuotedWord(const std::string& word) {
  constexpr std::size_t kShown = 24;
  std::string quoted(1, '"');
  for (const char c : word.substr(0, kShown)) {
    quoted += c >= ' ' && c <= '~' && c != '"' ? c : c == '"' ? '\'' : '?';
  }
  return quoted + (word.size() > kShown ? "...\"" : "\"");
}

std::string PlaceOf(const TextWord& word) {
  return "line " + std::to_string(word.line) + ", column " + std::to_string(word.column);
}

}  // namespace farhorizon
