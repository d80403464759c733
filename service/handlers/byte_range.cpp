#include "service/handlers/byte_range.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace farhorizon {

namespace {

// Whether a list of entity tags has `etag`. weak: compares without the prefix W/ [RFC 9110,
// section 8.8.3.2].
bool HasTag(std::string_view list, std::string_view etag, bool weak) {
  if (Trimmed(list) == "*") return true;
  while (!list.empty()) {
    const std::size_t comma = list.find(',');
    std::string_view tag = Trimmed(list.substr(0, comma));
    list = comma == std::string_view::npos ? std::string_view{} : list.substr(comma + 1);
    if (weak && tag.substr(0, 2) == "W/") tag.remove_prefix(2);
    if (tag == etag) return true;
  }
  return false;
}

std::optional<std::int64_t> Number(std::string_view text) {
  constexpr std::size_t kMaxDigits = 18;  // fit an int64
  std::int64_t value = 0;
  if (text.empty() || text.size() > kMaxDigits) return std::nullopt;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

// Bytes `first` to `last`, cut at the end of the file.
Selection SelectFrom(std::int64_t first, std::int64_t last, std::int64_t size) {
  if (first >= size) return {416, 0, 0};
  return {206, first, std::min(last, size - 1) - first + 1};
}

// nullopt if the field is not one well-formed range of bytes.
std::optional<Selection> ReadRange(std::string_view field, std::int64_t size) {
  constexpr std::string_view kUnit = "bytes=";
  if (LowerCase(field.substr(0, kUnit.size())) != kUnit) return std::nullopt;
  const std::string_view range = Trimmed(field.substr(kUnit.size()));
  const std::size_t dash = range.find('-');
  if (dash == std::string_view::npos) return std::nullopt;
  const std::string_view from = range.substr(0, dash);
  const std::string_view to = range.substr(dash + 1);
  const auto first = Number(from);
  const auto last = Number(to);
  // "-N": the last N bytes.
  if (from.empty() && last) {
    if (*last == 0) return Selection{416, 0, 0};
    return SelectFrom(std::max<std::int64_t>(0, size - *last), size, size);
  }
  if (!first || (!to.empty() && !last) || (last && *last < *first)) return std::nullopt;
  return SelectFrom(*first, last.value_or(size), size);
}

}  // namespace

int StatusByConditions(const HttpRequest& request, const std::string& etag) {
  const std::string* if_match = request.Header("if-match");
  if (if_match != nullptr && !HasTag(*if_match, etag, false)) return 412;
  const std::string* if_none_match = request.Header("if-none-match");
  return if_none_match != nullptr && HasTag(*if_none_match, etag, true) ? 304 : 200;
}

Selection SelectBytes(const HttpRequest& request, const std::string& etag, std::int64_t size) {
  const Selection all{200, 0, size};
  const int status = StatusByConditions(request, etag);
  if (status != 200) return {status, 0, 0};
  const std::string* range = request.Header("range");
  if (range == nullptr || request.method != "GET") return all;
  const std::string* if_range = request.Header("if-range");
  if (if_range != nullptr && Trimmed(*if_range) != etag) return all;
  return ReadRange(*range, size).value_or(all);
}

}  // namespace farhorizon
