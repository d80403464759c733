// The stages where they leave the process: a worker's messages, a job's status and its schema.
#include <string>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/stage.h"
#include "service/handlers/status_info.h"
#include "service/worker/worker_protocol.h"
#include "tests/support/json_schema.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::IsEmpty;

std::vector<std::string> StageNames() {
  std::vector<std::string> names;
  for (const Stage stage : kStages) names.emplace_back(StageName(stage));
  return names;
}

json Schema() {
  return json::parse(
      SlurpFile(std::string(FARHORIZON_SOURCE_DIR) + "/proto/schemas/status-info.schema.json"));
}

TEST(Stages, AreThoseOfTheSchema) {
  const std::vector<std::string> stages = StageNames();
  const json schema = Schema();
  EXPECT_EQ(schema["properties"]["timings"]["propertyNames"]["enum"], json(stages));
  // What a job that is not at a stage says.
  std::vector<std::string> messages = {"waiting", "waiting to run again", "starting"};
  messages.insert(messages.end(), stages.begin(), stages.end());
  messages.insert(messages.end(), {"done", "dismissed", "removed"});
  EXPECT_EQ(schema["else"]["properties"]["message"]["enum"], json(messages));
}

TEST(Stages, AJobSaysNoOtherUnlessItFailed) {
  const json schema = Schema();
  const auto offences = [&schema](const Job& job) {
    return SchemaOffences(json(StatusInfo(job, "http://localhost")), schema);
  };
  Job job;
  job.id = "01980000-0000-7000-8000-000000000000";
  job.filename = "dem.tif";
  job.state = JobState::kRunning;
  for (const std::string& stage : StageNames()) {
    job.message = stage;
    job.timings[stage] = 1.5;
    EXPECT_THAT(offences(job), IsEmpty()) << stage;
  }
  job.message = "views";
  EXPECT_THAT(offences(job), testing::ElementsAre("$.message: enum"));
  job.state = JobState::kFailed;
  EXPECT_THAT(offences(job), IsEmpty()) << "why it failed is free text";
  job.timings["views"] = 1;
  EXPECT_THAT(offences(job), testing::ElementsAre("$.timings.views: enum"));
}

TEST(Stages, AWorkersMessageHasAStageOfTheListAndAShare) {
  for (const Stage stage : kStages) {
    const auto read = ReadMessage(WriteMessage(WorkerProgress{stage, 0.25}));
    ASSERT_TRUE(read) << StageName(stage);
    const auto* progress = std::get_if<WorkerProgress>(&*read);
    ASSERT_NE(progress, nullptr);
    EXPECT_EQ(progress->stage, stage);
    EXPECT_EQ(progress->done, 0.25);
    EXPECT_TRUE(ReadMessage(WriteMessage(WorkerDone{{{StageName(stage), 1.5}}})));
  }
  for (const char* line : {R"({"stage": "views", "done": 0.5})", R"({"stage": "", "done": 0.5})",
                           R"({"done": 0.5})", R"({"stage": "sweep", "done": 1.5})",
                           R"({"stage": "sweep"})", R"({"timings": {"views": 1}})"}) {
    EXPECT_FALSE(ReadMessage(line)) << line;
  }
}

}  // namespace
}  // namespace farhorizon
