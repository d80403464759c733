#include "service/handlers/preferences.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <string_view>

namespace farhorizon {

namespace {

// The number of `text`, which may be in quotes.
std::optional<std::int64_t> SecondsIn(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  std::int64_t seconds = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, seconds);
  // As good as any: nobody waits for so long.
  if (failure == std::errc::result_out_of_range && stop == end && text.front() != '-') {
    return std::numeric_limits<std::int64_t>::max();
  }
  if (failure != std::errc() || stop != end || seconds < 0) return std::nullopt;
  return seconds;
}

void Read(std::string_view preference, Preferences& read) {
  preference = preference.substr(0, preference.find(';'));  // its parameters
  const std::size_t equals = std::min(preference.find('='), preference.size());
  const std::string name = LowerCase(Trimmed(preference.substr(0, equals)));
  const std::string_view value =
      Trimmed(preference.substr(std::min(equals + 1, preference.size())));
  if (name == "respond-async") read.respond_async = true;
  if (name == "wait" && !read.wait_seconds) read.wait_seconds = SecondsIn(value);
}

}  // namespace

Preferences PreferencesOf(const HttpRequest& request) {
  Preferences read;
  for (const auto& [name, field] : request.headers) {
    if (name != "prefer") continue;
    for (std::string_view rest = field; !rest.empty();) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      Read(rest.substr(0, comma), read);
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
  }
  return read;
}

}  // namespace farhorizon
