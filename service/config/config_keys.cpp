// The table of all keys. The name, the field, the limits and the help of each are here or in its
// section (config_sections.h), and nowhere else. The default of a key is that of its field.
#include "service/config/config_keys.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <nlohmann/json.hpp>

#include "service/config/config_sections.h"
#include "service/config/key_makers.h"
#include "service/jobs/database_url.h"

namespace farhorizon {

namespace {

// The limits of connections and the log; threads and what handlers were built with stay.
bool Reloads(const std::string& name) {
  constexpr std::array kStay = {"http.ioThreads", "http.handlerThreads", "http.uploadThreads",
                                "http.maxBodyBytes"};
  const bool stays = std::find(kStay.begin(), kStay.end(), name) != kStay.end();
  return !stays && (name.rfind("http.", 0) == 0 || name.rfind("log.", 0) == 0);
}

std::vector<ConfigKey> AllKeys() {
  std::vector<ConfigKey> keys = {
      TextKey("listen", FieldAt(&Config::listen),
              "HOST:PORT to listen on; port 0 takes any that is free"),
      TextKey("data", FieldAt(&Config::jobs, &JobServiceOptions::data),
              "the folder for jobs, uploads and artifacts"),
      TextKey("publicUrl", FieldAt(&Config::http, &ServerOptions::public_url),
              "the URL under which clients reach the service; empty: http:// and the address"),
      NumberKey("workers", FieldAt(&Config::workers), 0, 1024,
                "jobs at once; 0: as many as there are cores"),
  };
  for (std::vector<ConfigKey> section : {HttpKeys(), AuthKeys(), FetchKeys(), CallbackKeys(),
                                         StoreKeys(), JobKeys(), UploadKeys(), WorkerKeys()}) {
    std::move(section.begin(), section.end(), std::back_inserter(keys));
  }
  keys.push_back(ChoiceKey("log.level", FieldAt(&Config::log, &LogOptions::level), kLogLevelNames,
                           "the least that is logged"));
  keys.push_back(ChoiceKey("log.format", FieldAt(&Config::log, &LogOptions::format),
                           kLogFormatNames, "auto: text on a terminal, else JSON"));
  keys.push_back(TextKey("viewer.cesium", FieldAt(&Config::cesium),
                         "the folder of CesiumJS, as service/pages/install-cesium makes it; empty: "
                         "cesium beside the program, or share/farhorizon/cesium beside its bin"));
  keys.push_back(
      ChoiceKey("conformance.echo", FieldAt(&Config::echo), std::array{"off", "on"},
                "whether the process echo is offered, which the test suites of OGC API - "
                "Processes need"));
  for (ConfigKey& key : keys) key.reloads = Reloads(key.name);
  return keys;
}

}  // namespace

bool ConfigKey::IsText() const { return std::holds_alternative<std::string>(get(Config{})); }

std::string ConfigKey::Environment() const {
  std::string variable(kEnvironmentPrefix);
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') variable += '_';
    variable += c == '.' ? '_' : c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return variable;
}

const std::vector<ConfigKey>& ConfigKeys() {
  static const std::vector<ConfigKey> keys = AllKeys();
  return keys;
}

std::string WriteConfig(const Config& config) {
  using nlohmann::ordered_json;
  ordered_json document = ordered_json::object();
  for (const ConfigKey& key : ConfigKeys()) {
    const std::size_t dot = key.name.find('.');
    ordered_json& section = dot == std::string::npos ? document : document[key.name.substr(0, dot)];
    const std::string leaf = dot == std::string::npos ? key.name : key.name.substr(dot + 1);
    if (key.name == "store.jobs") {
      section[leaf] = WithoutPassword(config.jobs.store.jobs);
      continue;
    }
    std::visit([&](const auto& value) { section[leaf] = value; }, key.get(config));
  }
  return document.dump(2) + "\n";
}

}  // namespace farhorizon
