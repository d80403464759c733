#include "service/handlers/content_coding.h"

#include <optional>
#include <string>
#include <string_view>

namespace farhorizon {

namespace {

// The weight of a parameter "q=0.5" in thousandths; nullopt for what is none [RFC 9110, section
// 12.4.2].
std::optional<int> Weight(std::string_view parameter) {
  constexpr std::size_t kLongest = 5;  // of "0.123"
  if (LowerCase(parameter.substr(0, 2)) != "q=") return std::nullopt;
  const std::string_view digits = parameter.substr(2);
  if (digits.empty() || digits.size() > kLongest) return std::nullopt;
  if (digits.size() > 1 && digits[1] != '.') return std::nullopt;
  int thousandths = 0;
  int unit = 1000;
  for (std::size_t i = 0; i < digits.size(); i == 0 ? i = 2 : ++i) {
    if (digits[i] < '0' || digits[i] > '9') return std::nullopt;
    thousandths += (digits[i] - '0') * unit;
    unit /= 10;
  }
  if (thousandths > 1000) return std::nullopt;
  return thousandths;
}

}  // namespace

bool AcceptsGzip(const HttpRequest& request) {
  const std::string* field = request.Header("accept-encoding");
  if (field == nullptr) return false;
  std::optional<int> gzip;
  std::optional<int> identity;
  std::optional<int> all;
  for (std::string_view rest = *field; !rest.empty();) {
    const std::size_t comma = rest.find(',');
    const std::string_view item = rest.substr(0, comma);
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
    const std::size_t semicolon = item.find(';');
    const std::string coding = LowerCase(Trimmed(item.substr(0, semicolon)));
    std::optional<int> weight = 1000;
    if (semicolon != std::string_view::npos) weight = Weight(Trimmed(item.substr(semicolon + 1)));
    if (!weight) return false;
    if (coding == "gzip" || coding == "x-gzip") gzip = weight;
    if (coding == "identity") identity = weight;
    if (coding == "*") all = weight;
  }
  if (!gzip) gzip = all;
  return gzip.value_or(0) > 0 && *gzip >= identity.value_or(0);
}

}  // namespace farhorizon
