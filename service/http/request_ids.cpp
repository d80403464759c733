#include "service/http/request_ids.h"

#include <array>
#include <string_view>

#include "service/random.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMostIdBytes = 200;
constexpr std::string_view kDigits = "0123456789abcdef";

bool IsHex(std::string_view text) {
  return text.find_first_not_of(kDigits) == std::string_view::npos;
}

}  // namespace

std::string RequestIdOf(const HttpRequest& request) {
  const std::string* given = request.Header("x-request-id");
  if (given != nullptr && !given->empty() && given->size() <= kMostIdBytes) return *given;
  std::string id;
  for (const unsigned char byte : RandomBytes()) {
    id += kDigits[byte >> 4U];
    id += kDigits[byte & 15U];
  }
  return id;
}

std::string TraceIdOf(const HttpRequest& request) {
  const std::string* field = request.Header("traceparent");
  // "00-" trace "-" parent "-" flags; a later version may have more behind.
  if (field == nullptr || field->size() < 55) return {};
  const std::string_view text(*field);
  const std::string_view version = text.substr(0, 2);
  const std::string_view trace = text.substr(3, 32);
  const std::string_view parent = text.substr(36, 16);
  const bool sound = text[2] == '-' && text[35] == '-' && text[52] == '-' && IsHex(version) &&
                     version != "ff" && IsHex(trace) && IsHex(parent) &&
                     IsHex(text.substr(53, 2)) &&
                     (text.size() == 55 || (version != "00" && text[55] == '-'));
  const bool zero = trace.find_first_not_of('0') == std::string_view::npos ||
                    parent.find_first_not_of('0') == std::string_view::npos;
  return sound && !zero ? std::string(trace) : std::string();
}

}  // namespace farhorizon
