#include "service/worker/message_reader.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

class MessageReaderTest : public testing::Test {
 protected:
  std::vector<double> steps_;
  std::vector<std::string> assumed_;
  RunControl control_{
      .progress = [this](Stage, double done) { steps_.push_back(done); },
      .on_assumption = [this](const Assumption& met) { assumed_.push_back(met.code); }};
  MessageReader reader_{control_};
};

TEST_F(MessageReaderTest, PutsTogetherWhatComesInPieces) {
  const std::string text = WriteMessage(WorkerBeat{}) +
                           WriteMessage(WorkerProgress{Stage::kRead, 0.5}) +
                           WriteMessage(Assumption{"a", "b"}) + WriteMessage(WorkerSize{12}) +
                           WriteMessage(WorkerDone{{}, 7});
  for (const char byte : text) {
    EXPECT_FALSE(reader_.final_message());
    ASSERT_TRUE(reader_.Add({&byte, 1}));
  }
  EXPECT_EQ(steps_, std::vector<double>{0.5});
  EXPECT_EQ(assumed_, std::vector<std::string>{"a"});
  EXPECT_EQ(reader_.posts(), 12);
  ASSERT_TRUE(reader_.final_message());
  EXPECT_EQ(std::get<WorkerDone>(*reader_.final_message()).peak_bytes, 7);
}

TEST_F(MessageReaderTest, TakesNothingAfterTheMessageThatEndsTheWork) {
  ASSERT_TRUE(reader_.Add(WriteMessage(Error{ErrorCode::kIo, "no", "storage"})));
  EXPECT_FALSE(reader_.Add(WriteMessage(WorkerDone{})));
  EXPECT_TRUE(std::holds_alternative<Error>(*reader_.final_message()));
}

TEST_F(MessageReaderTest, RefusesWhatAWorkerDoesNotSay) {
  EXPECT_FALSE(reader_.Add("{}\n"));
  MessageReader endless(control_);
  bool taken = true;
  int pieces = 0;
  while (taken && ++pieces < 1000) taken = endless.Add(std::string(1000, '{'));
  EXPECT_FALSE(taken) << "its memory is bounded";
  MessageReader full_of_doubt(control_);
  for (std::size_t i = 0; i < kMostAssumptions; ++i) {
    ASSERT_TRUE(full_of_doubt.Add(WriteMessage(Assumption{"a", "b"})));
  }
  EXPECT_FALSE(full_of_doubt.Add(WriteMessage(Assumption{"a", "b"})));
}

}  // namespace
}  // namespace farhorizon
