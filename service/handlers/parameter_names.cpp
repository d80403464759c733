#include "service/handlers/parameter_names.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/pipeline/build_options.h"

namespace farhorizon {

namespace {

bool IsFlagCharacter(char c) { return c == '-' || (c >= 'a' && c <= 'z'); }

// The parameter whose flag `word` is.
std::optional<std::string_view> ParameterOf(std::string_view word) {
  for (const std::string_view name : ParameterNames()) {
    if (FlagOf(name) == word) return name;
  }
  return std::nullopt;
}

// Whether `text`, what stands after a flag and a blank, begins with a value of it and not with the
// next word of the sentence: a number, a code, a name in capitals, or a value that is a small word.
bool BeginsWithValue(std::string_view text) {
  constexpr std::array<std::string_view, 6> kSmallWords = {"m",   "ft",  "us-ft",
                                                           "nan", "inf", "ellipsoid"};
  if (text.empty()) return false;
  const char first = text[0];
  if ((first >= '0' && first <= '9') || (first >= 'A' && first <= 'Z') || first == '-') return true;
  const std::string_view word = text.substr(0, text.find_first_of(" ,;.:)\"'"));
  const bool list = text.substr(word.size(), 1) == ",";  // "--height-unit m, ft or us-ft"
  return !list && std::find(kSmallWords.begin(), kSmallWords.end(), word) != kSmallWords.end();
}

}  // namespace

std::string WithParameterNames(std::string_view text) {
  std::string named;
  for (std::size_t at = 0; at < text.size();) {
    const bool begins = at == 0 || !IsFlagCharacter(text[at - 1]);
    if (!begins || text.substr(at, 2) != "--") {
      named += text[at++];
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && IsFlagCharacter(text[end])) ++end;
    const std::string_view word = text.substr(at, end - at);
    const std::optional<std::string_view> parameter = ParameterOf(word);
    named += parameter.value_or(word);
    at = end;
    if (parameter && text.substr(at, 1) == " " && BeginsWithValue(text.substr(at + 1))) {
      named += '=';
      ++at;
    }
  }
  return named;
}

}  // namespace farhorizon
