// Calls to a receiver that answers well and badly, from the outbox of a real store.
#include "service/handlers/callback_sender.h"

#include <fstream>
#include <sys/socket.h>

#include <gmock/gmock.h>

#include "core/io/base64.h"
#include "service/clock.h"
#include "tests/support/handlers_fixture.h"
#include "tests/support/http_stub.h"

namespace farhorizon {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Ge;
using testing::HasSubstr;
using testing::SizeIs;

class CallbackSenderTest : public HandlersTest {
 protected:
  void SetUp() override {
    HandlersTest::SetUp();
    const std::string secret(32, 's');
    const auto* const bytes = reinterpret_cast<const unsigned char*>(secret.data());
    std::ofstream(folder_ / "secret") << "whsec_" << ToBase64({bytes, secret.size()}) << "\n";
    options_ = {receiver_.url(), "127.0.0.1", (folder_ / "secret").string(), seconds(3600), 2};
    auto rules = CallbackRules::Make(options_);
    ASSERT_TRUE(rules) << rules.error().message;
    rules_ = *std::move(rules);
    router_ = std::make_unique<Router>(BuildRouter(Context()));
  }
  [[nodiscard]] HandlerContext Context() const {
    HandlerContext context{*jobs_, "http://x", 1000};
    context.callbacks = rules_;
    return context;
  }
  // A job that was dismissed, of which its subscriber is to be told.
  std::string Ended() {
    const HttpResponse response = Post(
        "/processes/terrain-lod/execution",
        nlohmann::json{{"inputs", {{"dem", "SUkqAC4uLi4="}}},
                       {"subscriber",
                        {{"successUri", receiver_.url("/s")}, {"failedUri", receiver_.url("/f")}}}}
            .dump(),
        "application/json");
    EXPECT_EQ(response.status, 201) << response.body;
    const std::string id = nlohmann::json::parse(response.body).value("jobID", "");
    EXPECT_TRUE(jobs_->Dismiss(id));
    return id;
  }
  std::vector<std::string> Requests(std::size_t count) {
    for (int i = 0; i < 3000 && receiver_.requests().size() < count; ++i)
      Pause(milliseconds(10), {});
    return receiver_.requests();
  }

  HttpStub receiver_;
  CallbackOptions options_;
  std::shared_ptr<const CallbackRules> rules_;
};

TEST_F(CallbackSenderTest, TellsOfAnEndOnce) {
  receiver_.Answer(HttpStub::Response(200, std::string(100'000, 'x')));
  const std::string id = Ended();
  CallbackSender sender(Context(), options_);
  ASSERT_THAT(Requests(1), SizeIs(1));
  Pause(milliseconds(1200), {});
  sender.Stop();
  ASSERT_THAT(receiver_.requests(), SizeIs(1));
  const std::string request = receiver_.requests()[0];
  EXPECT_THAT(request, testing::StartsWith("POST /f HTTP/1.1"));
  EXPECT_THAT(request, HasSubstr("webhook-id: " + id + "-failure\r\n"));
  EXPECT_THAT(request, HasSubstr("\"status\":\"dismissed\""));
}

TEST_F(CallbackSenderTest, TriesAgainUntilItIsTaken) {
  receiver_.AnswerEach({HttpStub::Response(500), HttpStub::Response(302, "", "Location: /\r\n"), "",
                        HttpStub::Response(204)});
  Ended();
  CallbackSender sender(Context(), options_);
  EXPECT_THAT(Requests(4), SizeIs(4));
  Pause(milliseconds(1200), {});
  sender.Stop();
  EXPECT_THAT(receiver_.requests(), SizeIs(4));
}

TEST_F(CallbackSenderTest, StopsAtOnceWhereItIsToldTo) {
  receiver_.Answer(HttpStub::Response(410));
  Ended();
  CallbackSender sender(Context(), options_);
  EXPECT_THAT(Requests(1), SizeIs(1));
  Pause(milliseconds(1500), {});
  EXPECT_THAT(receiver_.requests(), SizeIs(1));
}

TEST_F(CallbackSenderTest, GivesUpAfterItsTime) {
  receiver_.Answer(HttpStub::Response(500));
  options_.retry_time = seconds(1);
  Ended();
  CallbackSender sender(Context(), options_);
  Pause(milliseconds(3500), {});
  const std::size_t tries = receiver_.requests().size();
  EXPECT_THAT(tries, Ge(2U));
  Pause(milliseconds(1500), {});
  EXPECT_EQ(receiver_.requests().size(), tries);
}

TEST_F(CallbackSenderTest, LeavesWhatItWasAboutToSayWhereItStops) {
  receiver_.Before([](int client) {
    // Never reads, never answers, until the sender is gone.
    char byte = 0;
    while (::recv(client, &byte, 1, 0) > 0) {
    }
    return true;
  });
  Ended();
  {
    CallbackSender sender(Context(), options_);
    ASSERT_THAT(Requests(1), SizeIs(1));
    const auto start = std::chrono::steady_clock::now();
    sender.Stop();
    EXPECT_LT(std::chrono::steady_clock::now() - start, seconds(3));
  }
  receiver_.Before(nullptr);
  receiver_.Answer(HttpStub::Response(204));
  CallbackSender next(Context(), options_);
  const std::vector<std::string> requests = Requests(2);
  ASSERT_THAT(requests, SizeIs(2));
  const auto id_of = [](const std::string& request) {
    return request.substr(request.find("webhook-id"), 60);
  };
  EXPECT_EQ(id_of(requests[0]), id_of(requests[1]));
}

}  // namespace
}  // namespace farhorizon
