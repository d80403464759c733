#include "core/base/error_kind.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(ErrorKind, IsReadFromListedNamesOnly) {
  for (const std::string_view name : kErrorKinds) {
    ASSERT_TRUE(ErrorKind::FromName(name)) << name;
    EXPECT_EQ(ErrorKind::FromName(name)->name(), name);
  }
  EXPECT_FALSE(ErrorKind::FromName("no-such-kind"));
  EXPECT_FALSE(ErrorKind::FromName(""));
}

TEST(ErrorKind, IsNoneByDefault) {
  EXPECT_TRUE(ErrorKind().empty());
  EXPECT_EQ(ErrorKind(), ErrorKind(""));
  EXPECT_NE(ErrorKind(), ErrorKind("io"));
}

}  // namespace
}  // namespace farhorizon
