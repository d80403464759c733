#include "core/io/mesh_files/line_reader.h"

#include <algorithm>
#include <charconv>

namespace farhorizon {

namespace {

constexpr std::string_view kSpace = " \t\v\f\r\n";

template <typename Number>
std::optional<Number> Parse(std::string_view word) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  Number value{};
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failure != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

bool LineReader::Next(std::string_view& line) {
  if (at_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
  line = text_.substr(at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  if (end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n') ++at_;
  ++line_;
  return true;
}

std::string_view TakeWord(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(kSpace), rest.size()));
  const std::string_view word = rest.substr(0, rest.find_first_of(kSpace));
  rest.remove_prefix(word.size());
  return word;
}

std::optional<double> NumberOf(std::string_view word) { return Parse<double>(word); }

std::optional<std::int64_t> WholeNumberOf(std::string_view word) {
  return Parse<std::int64_t>(word);
}

}  // namespace farhorizon
