#include "service/worker/sandbox/layers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(SandboxLayers, AreNamed) {
  EXPECT_THAT(NamesOf({.landlock = 2, .seccomp = true}), ElementsAre("landlock", "seccomp"));
  EXPECT_THAT(NamesOf({}), ElementsAre());
}

TEST(CheckSandbox, TakesWhatIsThere) {
  const SandboxLayers some{.landlock = 2, .seccomp = true};
  EXPECT_TRUE(CheckSandbox("none", {}));
  EXPECT_TRUE(CheckSandbox("landlock", some));
  EXPECT_TRUE(CheckSandbox("landlock,seccomp", some));
  EXPECT_TRUE(CheckSandbox("all", {true, true, 7, true}));
}

TEST(CheckSandbox, NamesWhatIsMissingAndWhatToDo) {
  Status checked = CheckSandbox("all", {.landlock = 2, .seccomp = true});
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().kind, "sandbox-missing");
  EXPECT_THAT(checked.error().message, HasSubstr("namespaces: allow unprivileged user"));
  EXPECT_THAT(checked.error().message, HasSubstr("private-root"));
  EXPECT_THAT(checked.error().message, Not(HasSubstr("seccomp: ")));
}

TEST(CheckSandbox, RefusesOtherWords) {
  for (const char* text : {"", ",", "everything", "landlock, seccomp", "landlock;seccomp"}) {
    Status checked = CheckSandbox(text, {true, true, 7, true});
    ASSERT_FALSE(checked) << text;
    EXPECT_EQ(checked.error().kind, "invalid-config") << text;
  }
}

}  // namespace
}  // namespace farhorizon
