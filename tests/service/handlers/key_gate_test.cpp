// Who gets what where keys are asked for: rows 20 to 22 of the service's threats.
#include "service/handlers/key_gate.h"

#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/auth/key_file.h"
#include "service/handlers/route_scopes.h"
#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using Headers = std::vector<std::pair<std::string, std::string>>;

class KeyGateTest : public HandlersTest {
 protected:
  void SetUp() override {
    HandlersTest::SetUp();
    Ask({.required = AuthRequired::kAlways});
  }
  void Ask(const AuthOptions& options) {
    gate_ = *KeyGate::Open(options, folder_ / "data", true);
    router_ =
        std::make_unique<Router>(BuildRouter({*jobs_, "http://x", 1000, {}, {}, false, gate_}));
  }
  // The field of a new key.
  Headers KeyWith(Scopes scopes) {
    const NewKey made = MakeKey("a", scopes, 5);
    EXPECT_TRUE(
        ChangeKeys(folder_ / "data" / "keys.json", [&](std::vector<ApiKey>& keys) -> Status {
          keys.push_back(made.key);
          return Ok{};
        }));
    return {{"authorization", "Bearer " + made.text}};
  }
  std::string JobOf(const Headers& key) {
    const HttpResponse response = Post("/jobs", tiff_, "image/tiff", key);
    EXPECT_EQ(response.status, 201) << response.body;
    return json::parse(response.body).value("jobID", "");
  }
  static std::string ChallengeOf(const HttpResponse& response) {
    return FieldOf(response, "WWW-Authenticate");
  }
  const Scopes usual_ = {Scope::kSubmit, Scope::kRead, Scope::kDelete};
};

TEST_F(KeyGateTest, RefusesWhoHasNoKeyWithoutLookingAtTheRest) {
  KeyWith(usual_);
  for (const auto& [method, target] :
       std::vector<std::pair<std::string, std::string>>{{"POST", "/jobs"},
                                                        {"GET", "/jobs"},
                                                        {"GET", "/nothing"},
                                                        {"PUT", "/jobs"},
                                                        {"DELETE", "/jobs/x"},
                                                        {"GET", "/metrics"}}) {
    const HttpResponse response = Send(method, target, {}, "body");
    EXPECT_EQ(response.status, 401) << target;
    EXPECT_EQ(CodeOf(response), "key-required");
    EXPECT_EQ(ChallengeOf(response), "Bearer realm=\"farhorizon\"");
  }
  EXPECT_EQ(FilesLeft(), 2U) << "the keys and their lock: nothing was spooled";
}

TEST_F(KeyGateTest, TakesAKeyInItsFieldAlone) {
  const std::string bearer = KeyWith(usual_).at(0).second;
  const std::string text = bearer.substr(7);
  EXPECT_EQ(Send("GET", "/jobs", {{"authorization", bearer}}).status, 200);
  EXPECT_EQ(Send("GET", "/jobs", {{"authorization", "bEARER   " + text}}).status, 200);
  for (const char* name : {"access_token", "key", "token", "ticket"}) {
    EXPECT_EQ(Send("GET", "/jobs?" + std::string(name) + "=" + text).status, 401) << name;
  }
  for (const std::string& field : {text, "Basic " + text, std::string("Bearer"), "Bearer" + text,
                                   std::string("Bearer "), std::string()}) {
    EXPECT_EQ(CodeOf(Send("GET", "/jobs", {{"authorization", field}})),
              field == "Bearer " ? "invalid-key" : "key-required")
        << field;
  }
}

TEST_F(KeyGateTest, RefusesAWrongKeyHoweverItLooksAndRepeatsNothingOfIt) {
  const std::string bearer = KeyWith(usual_).at(0).second;
  std::string other = bearer;
  other.back() = other.back() == '0' ? '1' : '0';
  for (const std::string& field : {other, bearer + "0", bearer + " x", std::string("Bearer \"\\"),
                                   "Bearer " + std::string(15'000, 'f')}) {
    const HttpResponse response = Send("GET", "/jobs", {{"authorization", field}});
    EXPECT_EQ(response.status, 401);
    EXPECT_EQ(CodeOf(response), "invalid-key");
    EXPECT_THAT(ChallengeOf(response),
                StartsWith("Bearer realm=\"farhorizon\", error=\"invalid_token\""));
    EXPECT_THAT(response.body + ChallengeOf(response), Not(HasSubstr(field.substr(7))));
  }
}

TEST_F(KeyGateTest, HoldsAKeyToItsScopes) {
  const std::map<Scope, Headers> keys = {{Scope::kSubmit, KeyWith({Scope::kSubmit})},
                                         {Scope::kRead, KeyWith({Scope::kRead})},
                                         {Scope::kDelete, KeyWith({Scope::kDelete})},
                                         {Scope::kAdmin, KeyWith({Scope::kAdmin})}};
  for (const Route& route : router_->routes()) {
    const std::optional<Scope> needed = NeededScope(route.method, route.pattern);
    for (const auto& [scope, key] : keys) {
      HttpRequest request;
      request.method = route.method;
      request.headers = key;
      const std::optional<HttpResponse> refusal = gate_->Admit(request, &route);
      const bool may = !needed || scope == *needed || scope == Scope::kAdmin;
      EXPECT_EQ(!refusal, may) << route.pattern;
      if (!refusal) continue;
      EXPECT_EQ(refusal->status, 403);
      EXPECT_EQ(CodeOf(*refusal), "insufficient-scope");
      EXPECT_THAT(ChallengeOf(*refusal), HasSubstr("error=\"insufficient_scope\", scope=\""));
    }
  }
}

// Of another's job, every route that there is or will be knows nothing: 404, as of none.
TEST_F(KeyGateTest, ShowsEachOwnerItsOwnJobsAlone) {
  const Headers ada = KeyWith(usual_);
  const Headers bob = KeyWith(usual_);
  const std::string job = JobOf(ada);
  const std::string none = "0190f1e2-0000-7000-8000-000000000000";
  int count = 0;
  for (const Route& route : router_->routes()) {
    const std::size_t at = route.pattern.find("{id}");
    if (at == std::string::npos || !NeededScope(route.method, route.pattern)) continue;
    if (route.pattern.starts_with("/uploads/")) continue;  // another id
    const auto path = [&](const std::string& id) {
      std::string target = route.pattern;
      target.replace(at, 4, id);
      const std::size_t name = target.find("{name}");
      return name == std::string::npos ? target : target.replace(name, 6, "report.json");
    };
    const HttpResponse others = Send(route.method, path(job), bob);
    EXPECT_EQ(others.status, 404) << route.pattern;
    EXPECT_EQ(CodeOf(others), CodeOf(Send(route.method, path(none), bob))) << route.pattern;
    ++count;
  }
  EXPECT_GE(count, 5);
  EXPECT_EQ(Send("GET", "/jobs/" + job, ada).status, 200);
  EXPECT_TRUE(json::parse(Send("GET", "/jobs", bob).body)["jobs"].empty());
  EXPECT_EQ(json::parse(Send("GET", "/jobs", ada).body)["jobs"].size(), 1U);
  EXPECT_EQ(json::parse(Send("GET", "/jobs", KeyWith({Scope::kAdmin})).body)["jobs"].size(), 1U);
  EXPECT_EQ(Send("DELETE", "/jobs/" + job, KeyWith({Scope::kAdmin})).status, 200);
}

TEST_F(KeyGateTest, ShowsEachOwnerItsOwnUploadsAlone) {
  const auto with = [](Headers key, Headers more = {}) {
    key.emplace_back("tus-resumable", "1.0.0");
    key.insert(key.end(), more.begin(), more.end());
    return key;
  };
  const Headers piece = {{"upload-offset", "0"},
                         {"content-type", "application/offset+octet-stream"}};
  const Headers ada = KeyWith({Scope::kSubmit});
  const HttpResponse made = Send("POST", "/uploads", with(ada, {{"upload-length", "8"}}));
  ASSERT_EQ(made.status, 201) << made.body;
  const std::string path = "/uploads/" + made.upload_id;
  const std::string job = json{{"inputs", {{"dem", {{"href", path}}}}}}.dump();

  const Headers bob = KeyWith(usual_);
  EXPECT_EQ(Send("HEAD", path, with(bob)).status, 404);
  EXPECT_EQ(CodeOf(Send("GET", path, with(bob))), "no-such-upload");
  EXPECT_EQ(CodeOf(Send("PATCH", path, with(bob, piece), tiff_)), "no-such-upload");
  EXPECT_EQ(CodeOf(Send("DELETE", path, with(bob))), "no-such-upload");
  EXPECT_EQ(Send("PATCH", path, with(ada, piece), tiff_).status, 204);
  EXPECT_EQ(CodeOf(Post("/jobs", job, "application/json", bob)), "no-such-upload");

  const Headers reader = KeyWith({Scope::kRead, Scope::kDelete});
  for (const char* method : {"GET", "HEAD", "PATCH", "DELETE"}) {
    EXPECT_EQ(CodeOf(Send(method, path, with(reader))), "insufficient-scope") << method;
  }
  EXPECT_EQ(Send("POST", "/uploads", with({}, {{"upload-length", "8"}})).status, 401);
  EXPECT_EQ(Send("OPTIONS", "/uploads").status, 204) << "a browser's preflight has no key";
  EXPECT_EQ(Send("HEAD", path, with(KeyWith({Scope::kAdmin}))).status, 200);
  EXPECT_EQ(Post("/jobs", job, "application/json", ada).status, 201);
  EXPECT_EQ(Send("DELETE", path, with(ada)).status, 204);
}

TEST_F(KeyGateTest, AFloodOfOneKeyLeavesRoomForOthers) {
  const Headers ada = KeyWith(usual_);
  const Headers bob = KeyWith(usual_);
  JobServiceOptions options;
  options.data = folder_ / "other";
  options.workers = 0;
  options.max_waiting = 3;
  options.max_waiting_per_client = 1;
  options.min_free_bytes = 0;
  options.probe.max_bytes = -1;
  jobs_ = *JobService::Open(options);
  Ask({.required = AuthRequired::kAlways});
  JobOf(ada);
  const HttpResponse second = Post("/jobs", tiff_, "image/tiff", ada);
  EXPECT_EQ(second.status, 429);
  EXPECT_EQ(CodeOf(second), "too-many-jobs");
  JobOf(bob);
}

TEST_F(KeyGateTest, BoundsTheRequestsOfAKey) {
  Ask({.required = AuthRequired::kAlways, .bounds = {.requests_per_minute = 1}});
  const Headers ada = KeyWith(usual_);
  EXPECT_EQ(Send("GET", "/jobs", ada).status, 200);
  const HttpResponse second = Send("GET", "/jobs", ada);
  EXPECT_EQ(second.status, 429);
  EXPECT_EQ(CodeOf(second), "too-many-requests");
  EXPECT_GE(std::stoi(FieldOf(second, "Retry-After")), 58);
  EXPECT_EQ(Send("GET", "/jobs", KeyWith(usual_)).status, 200);
}

TEST_F(KeyGateTest, IdempotencyKeysOfOthersAreOthers) {
  Headers ada = KeyWith(usual_);
  Headers bob = KeyWith(usual_);
  for (Headers* one : {&ada, &bob}) one->emplace_back("idempotency-key", "\"k\"");
  const std::string job = JobOf(ada);
  EXPECT_EQ(JobOf(ada), job);
  EXPECT_NE(JobOf(bob), job);
}

TEST_F(KeyGateTest, ATicketOpensLinksToTheResultsOfItsJobAlone) {
  const Headers ada = KeyWith(usual_);
  const std::string job = JobOf(ada);
  const std::string other = JobOf(ada);
  const HttpResponse made = Send("POST", "/jobs/" + job + "/ticket", ada);
  ASSERT_EQ(made.status, 200) << made.body;
  const std::string query = "?ticket=" + json::parse(made.body).value("ticket", "");
  const std::string result = "/results/report.json";
  EXPECT_EQ(CodeOf(Send("GET", "/jobs/" + job + result + query)), "result-not-ready");
  EXPECT_EQ(CodeOf(Send("HEAD", "/jobs/" + job + result + query)), "result-not-ready");
  EXPECT_EQ(CodeOf(Send("GET", "/jobs/" + other + result + query)), "invalid-key");
  EXPECT_TRUE(Send("GET", "/jobs/" + job + "/events" + query).events);
  EXPECT_EQ(CodeOf(Send("GET", "/jobs/" + other + "/events" + query)), "invalid-key");
  EXPECT_EQ(CodeOf(Send("GET", "/jobs/" + job + query)), "key-required");
  EXPECT_EQ(CodeOf(Send("DELETE", "/jobs/" + job + query)), "key-required");
  EXPECT_EQ(CodeOf(Send("GET", "/jobs/" + job + result + "?ticket=x")), "invalid-key");
  ASSERT_TRUE(ChangeKeys(folder_ / "data" / "keys.json", [](std::vector<ApiKey>& keys) -> Status {
    keys.at(0).revoked_ms = 1;
    return Ok{};
  }));
  EXPECT_EQ(CodeOf(Send("GET", "/jobs/" + job + result + query)), "invalid-key");
}

TEST_F(KeyGateTest, AStreamOfEventsEndsWithItsKey) {
  const Headers ada = KeyWith(usual_);
  const std::string path = "/jobs/" + JobOf(ada) + "/events";
  EXPECT_EQ(CodeOf(Send("GET", path, KeyWith(usual_))), "no-such-job");
  const HttpResponse stream = Send("GET", path, ada);
  ASSERT_TRUE(stream.events);
  EXPECT_FALSE(stream.events->Next().last);
  ASSERT_TRUE(ChangeKeys(folder_ / "data" / "keys.json", [](std::vector<ApiKey>& keys) -> Status {
    keys.at(0).revoked_ms = 1;
    return Ok{};
  }));
  EXPECT_TRUE(stream.events->Next().last);
}

TEST_F(KeyGateTest, PagesAndHealthAreForEverybodyAndTellNothingOfJobs) {
  const std::string job = JobOf(KeyWith(usual_));
  for (const char* path : {"/healthz", "/readyz", "/"}) {
    EXPECT_EQ(Send("GET", path).status, 200) << path;
  }
  const HttpResponse page = Send("GET", "/viewer/" + job);
  const HttpResponse none = Send("GET", "/viewer/0190f1e2-0000-7000-8000-000000000000");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(none.status, 200) << "whether there is such a job is not to be told";
  EXPECT_EQ(page.body.size(), none.body.size());
  EXPECT_EQ(Send("GET", "/viewer/x").status, 404);
  EXPECT_EQ(Send("OPTIONS", "/jobs").status, 204) << "a preflight has no key";
  Ask({.required = AuthRequired::kAlways, .metrics = MetricsFor::kEveryone});
  EXPECT_EQ(Send("GET", "/metrics").status, 200);
}

TEST_F(KeyGateTest, AsksOnLoopbackFromTheFirstKeyOn) {
  Ask({});
  EXPECT_EQ(Send("GET", "/jobs").status, 200);
  KeyWith(usual_);
  EXPECT_EQ(Send("GET", "/jobs").status, 401);
  Ask({.required = AuthRequired::kNever});
  EXPECT_EQ(Send("GET", "/jobs").status, 200);
}

TEST_F(KeyGateTest, OpensWhereOthersReachItWithAGoodKeyOrWhenToldTo) {
  const auto opens = [&](const AuthOptions& options) {
    return KeyGate::Open(options, folder_ / "data", false);
  };
  const auto refused = opens({});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, "invalid-config");
  EXPECT_THAT(refused.error().message, HasSubstr("farhorizon keys add --name NAME --file " +
                                                 (folder_ / "data" / "keys.json").string()));
  EXPECT_TRUE(opens({.required = AuthRequired::kNever}));
  EXPECT_TRUE(opens({.required = AuthRequired::kAlways}));
  KeyWith(usual_);
  const auto opened = opens({});
  ASSERT_TRUE(opened);
  EXPECT_TRUE((*opened)->AsksForKeys());
  ASSERT_TRUE(ChangeKeys(folder_ / "data" / "keys.json", [](std::vector<ApiKey>& keys) -> Status {
    keys.at(0).revoked_ms = 1;
    return Ok{};
  }));
  EXPECT_FALSE(opens({})) << "a revoked key is none";
  EXPECT_TRUE((*opened)->AsksForKeys());
}

}  // namespace
}  // namespace farhorizon
