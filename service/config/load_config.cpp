#include "service/config/load_config.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <string_view>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "service/config/config_keys.h"
#include "service/strict_json.h"

namespace farhorizon {

namespace {

using nlohmann::ordered_json;

Error InvalidValue(const ConfigKey& key, const std::string& origin, const std::string& value,
                   const std::string& expected) {
  return {ErrorCode::kInvalidArgument,
          key.name + " is \"" + value + "\" (from " + origin + "), expected " + expected,
          "invalid-config"};
}

// Sets the value that `text` has for `key`.
Status Set(const ConfigKey& key, const std::string& text, const std::string& origin,
           LoadedConfig& loaded) {
  if (key.IsText()) {
    if (!key.choices.empty() &&
        std::find(key.choices.begin(), key.choices.end(), text) == key.choices.end()) {
      std::string expected = "one of";
      for (const std::string& choice : key.choices) expected += " " + choice;
      return InvalidValue(key, origin, text, expected);
    }
    key.set(loaded.config, text);
  } else {
    std::int64_t number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, number);
    if (failure != std::errc() || stop != end || number < key.least || number > key.most) {
      return InvalidValue(
          key, origin, text,
          "a number from " + std::to_string(key.least) + " to " + std::to_string(key.most));
    }
    key.set(loaded.config, number);
  }
  loaded.origins[key.name] = origin;
  return Ok{};
}

const ConfigKey* FindKey(const std::string& name) {
  for (const ConfigKey& key : ConfigKeys()) {
    if (key.name == name) return &key;
  }
  return nullptr;
}

Error UnknownKey(const std::string& what, const std::string& origin) {
  return {ErrorCode::kInvalidArgument,
          "there is no " + what + " (from " + origin + "); farhorizon serve --help lists all keys",
          "unknown-config"};
}

// Sets every key of a section of the file.
Status SetSection(const nlohmann::json& section, const std::string& prefix,
                  const std::string& origin, LoadedConfig& loaded) {
  for (const auto& [name, value] : section.items()) {
    const std::string full = prefix + name;
    if (value.is_object() && prefix.empty()) {
      Status set = SetSection(value, full + ".", origin, loaded);
      if (!set) return set;
      continue;
    }
    const ConfigKey* key = FindKey(full);
    if (key == nullptr) return UnknownKey("key " + full, origin);
    const bool wants_text = key->IsText();
    if (wants_text ? !value.is_string() : !value.is_number_integer()) {
      return InvalidValue(*key, origin, value.dump(), wants_text ? "a text" : "a whole number");
    }
    Status set = Set(*key, wants_text ? value.get<std::string>() : value.dump(), origin, loaded);
    if (!set) return set;
  }
  return Ok{};
}

Status LoadFile(const std::filesystem::path& path, LoadedConfig& loaded) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return Error{ErrorCode::kNotFound, "cannot read the configuration " + path.string(),
                 "no-config"};
  }
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const Result<nlohmann::json> document = ParseStrictJson(text);
  if (!document || !document->is_object()) {
    const std::string why = document ? "it is no object" : document.error().message;
    return Error{ErrorCode::kInvalidArgument, path.string() + " is no configuration: " + why,
                 "invalid-config"};
  }
  return SetSection(*document, "", path.string(), loaded);
}

}  // namespace

Result<LoadedConfig> LoadConfig(const std::optional<std::filesystem::path>& file,
                                const std::map<std::string, std::string>& environment,
                                const std::map<std::string, std::string>& flags) {
  LoadedConfig loaded;
  if (file) {
    Status read = LoadFile(*file, loaded);
    if (!read) return std::move(read.error());
  }
  for (const auto& [variable, value] : environment) {
    const auto& keys = ConfigKeys();
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const ConfigKey& candidate) {
      return candidate.Environment() == variable;
    });
    if (key == keys.end()) {
      loaded.ignored.push_back(variable);
      continue;
    }
    Status set = Set(*key, value, variable, loaded);
    if (!set) return std::move(set.error());
  }
  for (const auto& [name, value] : flags) {
    const ConfigKey* key = FindKey(name);
    Check(key != nullptr, "a flag names a key");
    Status set = Set(*key, value, "the command line", loaded);
    if (!set) return std::move(set.error());
  }
  return loaded;
}

std::map<std::string, std::string> ConfigEnvironment() {
  std::map<std::string, std::string> variables;
  constexpr std::string_view kPrefix = kEnvironmentPrefix;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (text.substr(0, kPrefix.size()) != kPrefix) continue;
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) continue;
    variables.emplace(text.substr(0, equals), text.substr(equals + 1));
  }
  return variables;
}

}  // namespace farhorizon
