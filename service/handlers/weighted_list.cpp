#include "service/handlers/weighted_list.h"

#include "service/handlers/http_message.h"

namespace farhorizon {

namespace {

// The text before the first `mark`, which is taken off `rest` with it.
std::string_view TakeUntil(std::string_view& rest, char mark) {
  const std::size_t at = rest.find(mark);
  const std::string_view taken = Trimmed(rest.substr(0, at));
  rest = at == std::string_view::npos ? std::string_view{} : rest.substr(at + 1);
  return taken;
}

}  // namespace

std::optional<int> WeightOf(std::string_view parameter) {
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

std::vector<std::pair<std::string, int>> WeightedList(std::string_view field) {
  std::vector<std::pair<std::string, int>> items;
  while (!field.empty()) {
    std::string_view parameters = TakeUntil(field, ',');
    std::string name = LowerCase(TakeUntil(parameters, ';'));
    int weight = 1000;
    while (!parameters.empty()) {
      const std::string_view parameter = TakeUntil(parameters, ';');
      if (LowerCase(parameter.substr(0, 2)) == "q=") weight = WeightOf(parameter).value_or(0);
    }
    if (!name.empty()) items.emplace_back(std::move(name), weight);
  }
  return items;
}

}  // namespace farhorizon
