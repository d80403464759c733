#include "service/handlers/echo_inputs.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/echo_task.h"

namespace farhorizon {
namespace {

using nlohmann::json;

// The outputs of an echo of these inputs, "name=text" one behind the other.
std::string Echoed(const json& inputs) {
  const Result<std::string> text = EchoTaskOf(inputs);
  if (!text) return text.error().kind;
  const Result<EchoTask> task = ReadEchoTask(*text);
  std::string all = std::to_string(task->pause_seconds);
  for (const EchoOutput& output : task->outputs) all += " " + output.name + "=" + output.text;
  return all;
}

TEST(EchoInputs, AreGivenBack) {
  EXPECT_EQ(Echoed({{"text", "a"}, {"pause", 5}}), "5 text=a");
  EXPECT_EQ(Echoed({{"text", {{"value", "a"}}}, {"numbers", {1, 2}}}), "0 numbers=[1,2] text=a");
  EXPECT_EQ(Echoed({{"object", {{"value", {{"a", 1}}}}}}), R"(0 object={"a":1})");
  EXPECT_EQ(Echoed({{"object", {{"value", "a"}}}}), R"(0 object={"value":"a"})");
  EXPECT_EQ(Echoed({{"box", {{"bbox", {1, 2, 3, 4}}, {"crs", "x"}}}}),
            R"(0 box={"bbox":[1,2,3,4],"crs":"x"})");
  EXPECT_EQ(Echoed({{"image", {{"value", "QUI="}, {"format", {{"mediaType", "image/tiff"}}}}}}),
            "0 image=QUI=");
}

TEST(EchoInputs, OfOtherKindsAreRefused) {
  for (const json& inputs :
       std::vector<json>{{{"text", 1}},
                         {{"pause", -1}},
                         {{"pause", 1.5}},
                         {{"numbers", {1.5}}},
                         {{"numbers", 1}},
                         {{"object", {1}}},
                         {{"box", {{"bbox", {1, 2, 3}}}}},
                         {{"box", {1, 2, 3, 4}}},
                         {{"image", "*"}},
                         {{"image", {{"value", "QUI="}, {"mediaType", "a/b"}}}},
                         {{"other", 1}}}) {
    EXPECT_EQ(Echoed(inputs), "invalid-parameter") << inputs;
  }
  EXPECT_EQ(Echoed({{"image", {{"href", "http://127.0.0.1/"}}}}), "href-not-allowed");
}

TEST(EchoInputs, BeginWithTheText) {
  EXPECT_EQ(EchoInputs().begin().key(), "text");
  EXPECT_TRUE(EchoInputs().contains("pause"));
  EXPECT_FALSE(EchoOutputs().contains("pause"));
}

}  // namespace
}  // namespace farhorizon
