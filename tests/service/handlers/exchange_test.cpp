#include "service/handlers/exchange.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

class Faulty : public Exchange {
 public:
  Status Take(std::string_view) override { return Ok{}; }
  HttpResponse Finish() override { throw std::runtime_error("secret"); }
};

TEST(FinishExchange, AnswersForAnExceptionWithoutItsText) {
  Faulty exchange;
  const HttpResponse response = FinishExchange(exchange, {});
  EXPECT_EQ(response.status, 500);
  EXPECT_NE(response.body.find("internal-error"), std::string::npos);
  EXPECT_EQ(response.body.find("secret"), std::string::npos);
}

}  // namespace
}  // namespace farhorizon
