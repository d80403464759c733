#include "service/url_query.h"

#include <algorithm>

namespace farhorizon {

namespace {

constexpr std::string_view kDigits = "0123456789ABCDEF";

bool IsUnreserved(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '.' || c == '_' || c == '~';
}

std::optional<unsigned> HexDigit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  return std::nullopt;
}

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

bool IsLetterOrDigit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || IsDigit(c);
}

// Whether the still encoded `code` has the form AUTHORITY:CODE.
bool IsCode(std::string_view code) {
  const std::size_t colon = std::min(code.find(':'), code.find("%3A"));
  if (colon == std::string_view::npos) return false;
  const std::string_view authority = code.substr(0, colon);
  const std::string_view rest = code.substr(colon + (code[colon] == ':' ? 1 : 3));
  return !authority.empty() && !rest.empty() &&
         std::all_of(authority.begin(), authority.end(), IsLetterOrDigit) &&
         std::all_of(rest.begin(), rest.end(), IsLetterOrDigit);
}

// Whether the + at `at` of a value that has neither %2B nor %20 stands for itself.
bool IsPlus(std::string_view value, std::size_t at) {
  if (at == 0 || IsCode(value.substr(0, at))) return true;
  const bool exponent = at >= 2 && (value[at - 1] == 'e' || value[at - 1] == 'E') &&
                        (IsDigit(value[at - 2]) || value[at - 2] == '.');
  return exponent && at + 1 < value.size() && IsDigit(value[at + 1]);
}

// The still encoded value with each + that means a space as %20.
std::string WithSpaces(std::string_view value) {
  const auto has = [&](const char* escape) { return value.find(escape) != value.npos; };
  const bool form = has("%2B") || has("%2b");
  const bool plain = !form && has("%20");
  std::string spaced;
  for (std::size_t at = 0; at < value.size(); ++at) {
    const bool space = value[at] == '+' && !plain && (form || !IsPlus(value, at));
    if (space) {
      spaced += "%20";
    } else {
      spaced += value[at];
    }
  }
  return spaced;
}

// Texts go on to functions that end at a NUL, and would mean less than they say.
bool HasNul(std::string_view text) { return text.find('\0') != std::string_view::npos; }

}  // namespace

std::string PercentEncode(std::string_view text) {
  std::string encoded;
  for (const char c : text) {
    if (IsUnreserved(c)) {
      encoded += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    encoded += '%';
    encoded += kDigits[byte >> 4U];
    encoded += kDigits[byte & 15U];
  }
  return encoded;
}

std::optional<std::string> PercentDecode(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    const auto high = HexDigit(text[i + 1]);
    const auto low = HexDigit(text[i + 2]);
    if (!high || !low) return std::nullopt;
    decoded += static_cast<char>(static_cast<unsigned char>(*high * 16 + *low));
    i += 2;
  }
  return decoded;
}

std::string EncodeQuery(const Parameters& parameters) {
  std::string query;
  for (const auto& [name, value] : parameters) {
    if (!query.empty()) query += '&';
    query += PercentEncode(name) + "=" + PercentEncode(value);
  }
  return query;
}

std::optional<Parameters> DecodeQuery(std::string_view query,
                                      const std::vector<std::string_view>& lists) {
  Parameters parameters;
  while (!query.empty()) {
    const std::size_t end = query.find('&');
    const std::string_view pair = query.substr(0, end);
    query = end == std::string_view::npos ? std::string_view{} : query.substr(end + 1);
    if (pair.empty()) continue;
    const std::size_t equals = pair.find('=');
    const auto name = PercentDecode(pair.substr(0, equals));
    const auto value = equals == std::string_view::npos
                           ? std::optional<std::string>("")
                           : PercentDecode(WithSpaces(pair.substr(equals + 1)));
    if (!name || !value || name->empty()) return std::nullopt;
    if (HasNul(*name) || HasNul(*value)) return std::nullopt;
    const auto [known, inserted] = parameters.emplace(*name, *value);
    if (inserted) continue;
    if (std::find(lists.begin(), lists.end(), *name) == lists.end()) return std::nullopt;
    known->second.append(",").append(*value);
  }
  return parameters;
}

}  // namespace farhorizon
