// Keys of the real service: made, used and revoked while it runs.
#include <fstream>
#include <signal.h>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/service_fixture.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;
using testing::Not;

class KeysE2e : public ServiceE2e {
 protected:
  // Runs `farhorizon keys …` on the data folder; what it prints.
  std::string Keys(const std::string& words, int expected = 0) {
    const std::filesystem::path out = folder_ / "keys.out";
    const std::string command = std::string("exec '") + FARHORIZON_PROGRAM + "' keys " + words +
                                " --data '" + (folder_ / "data").string() + "' > '" + out.string() +
                                "'";
    EXPECT_EQ(Process({"/bin/sh", "-c", command}, {}, folder_ / "stderr").Wait(), expected)
        << SlurpFile(folder_ / "stderr");
    return SlurpFile(out);
  }
  std::string Add(const std::string& name) {
    const std::string text = Keys("add --name " + name);
    EXPECT_EQ(text.size(), 81U) << "the key and nothing else";
    return text.substr(0, text.size() - 1);
  }
  static std::string With(const std::string& key) {
    return "Authorization: Bearer " + key + "\r\n";
  }
};

TEST_F(KeysE2e, AreMadeUsedAndRevokedWhileTheServiceRuns) {
  // Where others reach it, it does not even begin to listen.
  std::vector<std::string> words = Command();
  words[3] = "0.0.0.0:0";
  EXPECT_EQ(Process(words, {}, folder_ / "stderr").Wait(), 2);
  EXPECT_THAT(SlurpFile(folder_ / "stderr"), HasSubstr("farhorizon keys add --name NAME --file"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "data"));
  StartStandIn();
  EXPECT_EQ(Ask(port_, "GET", "/jobs").status, 200);
  const std::string ada = Add("ada");
  const std::string bob = Add("bob");
  EXPECT_EQ(Ask(port_, "GET", "/jobs").status, 401);

  // A client that asks before it sends a large body is told at once, and not to send it.
  const RawAnswer early =
      Exchange(port_,
               "POST /jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: image/tiff\r\n"
               "Content-Length: 2000000000\r\nExpect: 100-continue\r\n\r\n");
  EXPECT_EQ(early.status, 401);
  EXPECT_THAT(early.head, HasSubstr("WWW-Authenticate: Bearer realm=\"farhorizon\"\r\n"));
  EXPECT_THAT(early.head, Not(HasSubstr("100 Continue")));
  EXPECT_EQ(LeftOver("spool"), 0U);
  EXPECT_EQ(Ask(port_, "GET", "/jobs", With(ada) + With(ada)).status, 400) << "which one counts?";

  // The program sends the key that a file has; another's job is no job.
  SpillFile(folder_ / "key", ada + "\n");
  const std::string dem = (folder_ / "dem.asc").string();
  std::ofstream(dem) << SmallGrid();
  const std::string url = "http://127.0.0.1:" + std::to_string(port_);
  std::vector<std::string> submit = {
      "submit", dem, "--url", url, "-o", (folder_ / "out").string(), "--crs", "EPSG:4326"};
  EXPECT_EQ(Run(submit), 2);
  EXPECT_THAT(SlurpFile(folder_ / "stderr"), HasSubstr("key-required"));
  submit.insert(submit.end(), {"--key-file", (folder_ / "key").string()});
  EXPECT_EQ(Run(submit), 0) << SlurpFile(folder_ / "stderr");
  const RawAnswer own = Ask(port_, "GET", "/jobs", With(ada));
  ASSERT_EQ(nlohmann::json::parse(own.body)["jobs"].size(), 1U) << own.body;
  const std::string job = "/jobs/" + nlohmann::json::parse(own.body)["jobs"][0].value("jobID", "");
  EXPECT_EQ(Ask(port_, "GET", job, With(ada)).status, 200);
  EXPECT_EQ(Ask(port_, "GET", job, With(bob)).status, 404);
  const RawAnswer listed = Ask(port_, "GET", "/jobs", With(bob));
  EXPECT_TRUE(nlohmann::json::parse(listed.body)["jobs"].empty());
  EXPECT_THAT(listed.head, HasSubstr("Vary: Authorization\r\n"));

  Keys("revoke " + bob.substr(3, 12));
  EXPECT_EQ(Ask(port_, "GET", "/jobs", With(bob)).status, 401);
  EXPECT_EQ(Ask(port_, "GET", "/jobs", With(ada)).status, 200);
  Keys("revoke 000000000000", 1);
  const std::string list = Keys("list");
  EXPECT_THAT(list, testing::AllOf(HasSubstr(ada.substr(3, 12) + "  good"),
                                   HasSubstr(bob.substr(3, 12) + "  revoked")));
  const std::string print = std::string("exec '") + FARHORIZON_PROGRAM +
                            "' serve --print-config > '" + (folder_ / "config").string() + "' 2>&1";
  EXPECT_EQ(Process({"/bin/sh", "-c", print}, {"FARHORIZON_KEY=" + ada}, folder_ / "stderr").Wait(),
            0);
  service_->Signal(SIGTERM);
  EXPECT_EQ(service_->Wait(), 0);
  // The log tells who was refused, and no secret.
  const std::string log = SlurpFile(folder_ / "log");
  EXPECT_THAT(log, HasSubstr("\"key_id\":\"" + bob.substr(3, 12) + "\",\"code\":\"invalid-key\""));
  for (const std::string& key : {ada, bob}) {
    EXPECT_THAT(
        log + list + SlurpFile(folder_ / "config") + SlurpFile(folder_ / "data" / "keys.json"),
        Not(HasSubstr(key.substr(16))));
  }
}

}  // namespace
}  // namespace farhorizon
