#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "service/config/config_keys.h"

namespace farhorizon {

// What the sections of the configuration are written with.

inline constexpr std::int64_t kDay = 86400;
inline constexpr std::int64_t kTebibyte = std::int64_t{1} << 40U;

/// A function from a Config to the field at the end of a path: a member of Config, a member of that
/// member, and so on.
template <typename... Members>
auto FieldAt(Members... members) {
  return [members...](auto& config) -> auto& { return (config.*....*members); };
}

/// A key of numbers. field: an integer or a duration in seconds.
template <typename Field>
ConfigKey NumberKey(std::string name, Field field, std::int64_t least, std::int64_t most,
                    std::string help) {
  const auto get = [field](const Config& config) -> ConfigValue {
    const auto value = field(config);
    if constexpr (std::is_integral_v<decltype(value)>) {
      return static_cast<std::int64_t>(value);
    } else {
      return static_cast<std::int64_t>(value.count());
    }
  };
  const auto set = [field](Config& config, const ConfigValue& value) {
    auto& target = field(config);
    target = static_cast<std::remove_reference_t<decltype(target)>>(std::get<std::int64_t>(value));
  };
  return {std::move(name), std::move(help), least, most, {}, get, set, false};
}

/// A key of texts. field: a string or a path.
template <typename Field>
ConfigKey TextKey(std::string name, Field field, std::string help) {
  const auto get = [field](const Config& config) -> ConfigValue {
    return std::string(field(config));
  };
  const auto set = [field](Config& config, const ConfigValue& value) {
    field(config) = std::get<std::string>(value);
  };
  return {std::move(name), std::move(help), 0, 0, {}, get, set, false};
}

/// A key of words. field: an enum whose enumerators have `names`, in this order.
template <typename Field, std::size_t kCount>
ConfigKey ChoiceKey(std::string name, Field field, const std::array<const char*, kCount>& names,
                    std::string help) {
  const std::vector<std::string> choices(names.begin(), names.end());
  const auto get = [field, choices](const Config& config) -> ConfigValue {
    return choices.at(static_cast<std::size_t>(field(config)));
  };
  const auto set = [field, choices](Config& config, const ConfigValue& value) {
    const auto found = std::find(choices.begin(), choices.end(), std::get<std::string>(value));
    auto& target = field(config);
    target = static_cast<std::remove_reference_t<decltype(target)>>(
        std::distance(choices.begin(), found));
  };
  return {std::move(name), std::move(help), 0, 0, choices, get, set, false};
}

}  // namespace farhorizon
