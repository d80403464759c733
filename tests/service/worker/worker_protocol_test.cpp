#include "service/worker/worker_protocol.h"

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

std::string Repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

// The message that a line of WriteMessage reads back as.
template <typename Message>
Message ReadBack(const WorkerMessage& message) {
  const std::string line = WriteMessage(message);
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  const std::optional<WorkerMessage> read = ReadMessage(line.substr(0, line.size() - 1));
  EXPECT_TRUE(read && std::holds_alternative<Message>(*read)) << line;
  return std::get<Message>(*read);
}

TEST(WorkerProtocol, ReadsBackEveryMessage) {
  const auto progress = ReadBack<WorkerProgress>(WorkerProgress{Stage::kSweep, 0.5});
  EXPECT_EQ(progress.stage, Stage::kSweep);
  EXPECT_EQ(progress.done, 0.5);
  const auto assumption = ReadBack<Assumption>(Assumption{"height-unit", "taken for metres"});
  EXPECT_EQ(assumption.code, "height-unit");
  EXPECT_EQ(assumption.text, "taken for metres");
  const auto done = ReadBack<WorkerDone>(WorkerDone{{{"sweep", 1.25}}, 7});
  EXPECT_EQ(done.peak_bytes, 7);
  EXPECT_EQ(ReadBack<WorkerSize>(WorkerSize{12}).posts, 12);
  EXPECT_EQ(done.timings, (std::map<std::string, double>{{"sweep", 1.25}}));
  const auto error = ReadBack<Error>(Error{ErrorCode::kUnsupportedData, "no\nCRS \xff", "no-crs"});
  EXPECT_EQ(error.code, ErrorCode::kUnsupportedData);
  EXPECT_EQ(error.kind, "no-crs");
  EXPECT_EQ(error.message, "no\nCRS \xEF\xBF\xBD");
}

TEST(WorkerProtocol, RefusesWhatNoWorkerWrites) {
  for (const char* line :
       {"",
        "x",
        "[]",
        "{}",
        "{\"stage\": \"sweep\"}",
        "{\"done\": \"1\"}",
        "{\"done\": 1.5}",
        "{\"stage\": \"dance\", \"done\": 0.5}",
        "{\"done\": -0.1}",
        "{\"done\": [[[[[[]]]]]]}",
        "{\"assumption\": \"a\"}",
        "{\"assumption\": {\"code\": \"a\"}}",
        "{\"assumption\": {\"code\": \"A b\", \"text\": \"c\"}}",
        "{\"assumption\": {\"code\": \"\", \"text\": \"c\"}}",
        "{\"timings\": []}",
        "{\"timings\": {\"a\": \"b\"}}",
        "{\"timings\": {}, \"peakBytes\": -1}",
        "{\"posts\": 0}",
        "{\"posts\": 1.5}",
        "{\"posts\": 1e30}",
        "{\"error\": 1}",
        "{\"error\": {\"code\": \"none\", \"kind\": \"a\", \"message\": \"b\"}}",
        "{\"error\": {\"code\": \"io\", \"kind\": \"A b\", \"message\": \"c\"}}"}) {
    EXPECT_FALSE(ReadMessage(line)) << line;
  }
  std::string many;
  for (int i = 0; i < 101; ++i) many += (i ? ", \"" : "\"") + std::to_string(i) + "\": 1";
  EXPECT_FALSE(ReadMessage("{\"timings\": {" + many + "}}"));
}

TEST(WorkerProtocol, ShortensTexts) {
  const auto error = ReadBack<Error>(Error{ErrorCode::kIo, std::string(5000, 'a'), "no-crs"});
  EXPECT_EQ(error.message.size(), 2000U);
  const auto assumption = ReadBack<Assumption>(Assumption{"a", std::string(5000, 'a')});
  EXPECT_EQ(assumption.text.size(), 2000U);
  const std::string long_text(5000, 'b');
  const auto read = ReadMessage(R"({"assumption": {"code": "a", "text": ")" + long_text + R"("}})");
  ASSERT_TRUE(read);
  EXPECT_EQ(std::get<Assumption>(*read).text.size(), 2000U);
}

TEST(WorkerProtocol, ShortensTextsBetweenCharacters) {
  const auto error = ReadBack<Error>(Error{ErrorCode::kIo, "a" + Repeated("\xC3\xA9", 2000), ""});
  EXPECT_EQ(error.message, "a" + Repeated("\xC3\xA9", 999));
}

TEST(WorkerProtocol, ReadsBackATask) {
  const TempDir folder;
  const WorkerTask task{"in/a.tif", "out", {{"levels", "2"}}, 1000, 3};
  ASSERT_TRUE(WriteTaskFile(folder.path(), task));
  Result<WorkerTask> read = ReadTask(SlurpFile(folder / "task.json"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->input, task.input);
  EXPECT_EQ(read->output, task.output);
  EXPECT_EQ(read->parameters, task.parameters);
  EXPECT_EQ(read->max_posts, task.max_posts);
  EXPECT_EQ(read->threads, task.threads);
  EXPECT_FALSE(WriteTaskFile(folder / "missing", task));
  for (const char* text : {"", "{}", "[]", "{\"input\": 1}"}) EXPECT_FALSE(ReadTask(text)) << text;
}

}  // namespace
}  // namespace farhorizon
