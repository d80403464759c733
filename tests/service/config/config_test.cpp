#include "service/config/config.h"

#include <fstream>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

#include "service/config/config_keys.h"
#include "service/config/load_config.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

TEST(Config, TheDefaultFileIsComplete) {
  std::ifstream file(std::string(FARHORIZON_SOURCE_DIR) + "/config/default.json");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(text, WriteConfig(Config{}))
      << "run: farhorizon serve --print-config > config/default.json";
}

TEST(Config, EveryKeyHasItsOwnNameVariableAndHelp) {
  std::set<std::string> names;
  std::set<std::string> variables;
  for (const ConfigKey& key : ConfigKeys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_TRUE(variables.insert(key.Environment()).second) << key.name;
    EXPECT_FALSE(key.help.empty()) << key.name;
  }
  EXPECT_TRUE(variables.count("FARHORIZON_HTTP_MAX_BODY_BYTES"));
}

TEST(Config, EveryKeyHasItsOwnField) {
  for (const ConfigKey& key : ConfigKeys()) {
    Config config;
    ConfigValue value = std::string("other");
    if (!key.choices.empty()) value = key.choices.front();
    if (key.get(config) == value) value = key.choices.back();
    if (!key.IsText()) value = key.most;
    ASSERT_NE(key.get(config), value) << key.name;
    key.set(config, value);
    EXPECT_EQ(key.get(config), value) << key.name;
    for (const ConfigKey& other : ConfigKeys()) {
      if (other.name == key.name) continue;
      EXPECT_EQ(other.get(config), other.get(Config{})) << key.name << " and " << other.name;
    }
  }
}

TEST(Config, APasswordIsNotPrinted) {
  for (const char* url :
       {"postgresql://ada:s3cret@db:5432/jobs?sslmode=require", "host=db user=ada password=s3cret",
        "postgresql://db/jobs?user=ada&password=s3cret&connect_timeout=3",
        "host=db password='s3cret' user=ada"}) {
    Config config;
    config.jobs.store.jobs = url;
    const std::string text = WriteConfig(config);
    EXPECT_EQ(text.find("s3cret"), std::string::npos) << text;
    EXPECT_NE(text.find("ada"), std::string::npos) << text;
  }
}

TEST(Config, FlagsComeBeforeEnvironmentBeforeFileBeforeDefaults) {
  const TempDir folder;
  std::ofstream(folder.path() / "c.json")
      << R"({"workers": 2, "data": "f", "http": {"ioThreads": 3}})";
  const auto loaded =
      LoadConfig(folder.path() / "c.json", {{"FARHORIZON_DATA", "e"}, {"FARHORIZON_WORKERS", "4"}},
                 {{"workers", "5"}});
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->config.workers, 5);
  EXPECT_EQ(loaded->config.jobs.data, "e");
  EXPECT_EQ(loaded->config.http.io_threads, 3);
  EXPECT_EQ(loaded->config.listen, "127.0.0.1:8080");
  EXPECT_EQ(loaded->origins.at("workers"), "the command line");
  EXPECT_EQ(loaded->origins.at("data"), "FARHORIZON_DATA");
}

TEST(Config, RefusesWhatItDoesNotKnow) {
  const TempDir folder;
  const auto refuses = [&](const std::string& text) {
    std::ofstream(folder.path() / "c.json") << text;
    Result<LoadedConfig> loaded = LoadConfig(folder.path() / "c.json", {}, {});
    return !loaded && loaded.error().code == ErrorCode::kInvalidArgument;
  };
  EXPECT_TRUE(refuses(R"({"worker": {"threads": 0}})"));
  EXPECT_TRUE(refuses(R"({"workerz": 1})"));
  EXPECT_TRUE(refuses(R"({"http": {"port": 1}})"));
  EXPECT_TRUE(refuses(R"({"workers": "2"})"));
  EXPECT_TRUE(refuses(R"({"workers": 1.5})"));
  EXPECT_TRUE(refuses(R"({"log": {"level": "loud"}})"));
  EXPECT_TRUE(refuses("[]"));
  EXPECT_TRUE(refuses("{"));
  EXPECT_TRUE(refuses(R"({"workers": 1, "workers": 2})"));
  EXPECT_TRUE(refuses(R"({"data": "a\u0000b"})"));
  EXPECT_TRUE(refuses(std::string(100'000, '[')));
}

TEST(Config, LeavesVariablesThatNameNoKey) {
  const auto loaded =
      LoadConfig({}, {{"FARHORIZON_PORT", "tcp://10.0.0.1:8080"}, {"FARHORIZON_WORKERS", "3"}}, {});
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->ignored, std::vector<std::string>{"FARHORIZON_PORT"});
  EXPECT_EQ(loaded->config.workers, 3);
}

}  // namespace
}  // namespace farhorizon
