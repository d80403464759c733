#include "service/handlers/json_sieve.h"

#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

struct Sieved {
  bool found = false;
  std::string text;
  std::string rest;
  std::string fault;
};

Sieved Sieve(const std::string& document, std::size_t pieces, std::size_t most = 1000) {
  Sieved result;
  JsonSieve sieve(
      {"inputs", "dem"},
      [&](std::string_view text) -> Status {
        result.text += text;
        return Ok{};
      },
      most);
  for (std::size_t at = 0; at < document.size(); at += pieces) {
    const Status fed = sieve.Feed(std::string_view(document).substr(at, pieces));
    if (!fed) {
      result.fault = fed.error().kind;
      break;
    }
  }
  result.found = sieve.found();
  result.rest = sieve.rest();
  return result;
}

TEST(JsonSieve, TakesTheTextAndLeavesTheRest) {
  for (const std::size_t pieces : {1U, 3U, 1000U}) {
    const Sieved plain =
        Sieve(R"({"inputs": {"a": "dem", "dem": "QUJD", "b": 1}, "c": []})", pieces);
    EXPECT_TRUE(plain.found);
    EXPECT_EQ(plain.text, "QUJD");
    EXPECT_EQ(plain.rest, R"({"inputs": {"a": "dem", "dem": "", "b": 1}, "c": []})");
    const Sieved qualified =
        Sieve(R"({"inputs":{"dem":{"mediaType":"x","value":"QU\/\u002bJD\r\n"}}})", pieces);
    EXPECT_EQ(qualified.text, "QU/+JD\r\n");
    EXPECT_EQ(qualified.rest, R"({"inputs":{"dem":{"mediaType":"x","value":""}}})");
  }
}

TEST(JsonSieve, TakesNoTextOfAnotherPlace) {
  for (const char* document :
       {R"({"dem": "QUJD"})", R"({"inputs": {"x": {"dem": "QUJD"}}})", R"(["inputs", "dem"])",
        R"({"inputs": [{"dem": "QUJD"}]})", R"({"inputs": {"dem": ["QUJD"]}})",
        R"({"inputs": {"dem": {"href": "QUJD"}}})", R"({"inputs": {"dem": {"value": ["QUJD"]}}})",
        R"({"inputs": {"d\u0065m": "QUJD"}})", R"({"inputs": "dem"})",
        R"({"a": "{\"inputs\": {\"dem\": \"QUJD\"}}"})"}) {
    const Sieved sieved = Sieve(document, 1);
    EXPECT_FALSE(sieved.found) << document;
    EXPECT_EQ(sieved.rest, document);
  }
}

TEST(JsonSieve, IsBounded) {
  EXPECT_EQ(Sieve(std::string(65, '['), 1).fault, "invalid-json");
  EXPECT_EQ(Sieve("[" + std::string(2000, ' '), 7).fault, "body-too-large");
  EXPECT_EQ(Sieve(R"({"inputs":{"dem":")" + std::string(5000, 'A') + "\"}}", 7).fault, "");
  for (const char* text : {"A\nB", "A\\bB", "A\\u00e9", "A\\uzzzz"}) {
    EXPECT_EQ(Sieve(R"({"inputs":{"dem":")" + std::string(text) + "\"}}", 1).fault, "invalid-json")
        << text;
  }
}

}  // namespace
}  // namespace farhorizon
