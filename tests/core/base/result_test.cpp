#include "core/base/result.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(Result, CarriesEitherTheValueOrTheError) {
  Result<int> value = 7;
  ASSERT_TRUE(value);
  EXPECT_EQ(*value, 7);
  Result<int> failure = Error{ErrorCode::kIo, "disk gone"};
  EXPECT_FALSE(failure);
  EXPECT_EQ(failure.error().message, "disk gone");
}

TEST(Result, OfConstIsReadAlike) {
  const Result<int> value = 7;
  const Result<int> failure = Error{ErrorCode::kIo, "disk gone"};
  EXPECT_EQ(*value, 7);
  EXPECT_EQ(failure.error().message, "disk gone");
  EXPECT_THROW(*failure, InternalError);
  EXPECT_THROW((void)value.error(), InternalError);
}

TEST(Result, ReadingTheValueOfAFailureIsOurBug) {
  Result<int> failure = Error{ErrorCode::kIo, "disk gone"};
  EXPECT_THROW(*failure, InternalError);
}

TEST(Result, IsReadWhereItIsConst) {
  const Result<int> value = 7;
  EXPECT_EQ(*value, 7);
  EXPECT_THROW(static_cast<void>(value.error()), InternalError);
  const Result<int> failure = Error{ErrorCode::kIo, "disk gone"};
  EXPECT_EQ(failure.error().message, "disk gone");
}

TEST(ErrorCode, IsKnownByItsName) {
  for (const ErrorCode code :
       {ErrorCode::kInvalidArgument, ErrorCode::kNotFound, ErrorCode::kUnsupportedData,
        ErrorCode::kResourceExhausted, ErrorCode::kCancelled, ErrorCode::kIo}) {
    EXPECT_EQ(ErrorCodeFromName(ErrorCodeName(code)), code);
  }
  EXPECT_FALSE(ErrorCodeFromName("unknown"));
}

TEST(Error, WithinPutsTheStepInFront) {
  Error error{ErrorCode::kIo, "file is empty", "truncated"};
  const Error outer = std::move(error).WithContext("read DEM");
  EXPECT_EQ(outer.message, "read DEM: file is empty");
  EXPECT_EQ(outer.kind, "truncated");
}

TEST(ErrorCodeFromName, ReadsBackEveryName) {
  for (const ErrorCode code :
       {ErrorCode::kInvalidArgument, ErrorCode::kNotFound, ErrorCode::kUnsupportedData,
        ErrorCode::kResourceExhausted, ErrorCode::kCancelled, ErrorCode::kIo}) {
    EXPECT_EQ(ErrorCodeFromName(ErrorCodeName(code)), code);
  }
  EXPECT_EQ(ErrorCodeFromName("unknown"), std::nullopt);
  EXPECT_EQ(ErrorCodeFromName(""), std::nullopt);
}

}  // namespace
}  // namespace farhorizon
