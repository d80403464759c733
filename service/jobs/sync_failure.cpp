#include "service/jobs/sync_failure.h"

#include <unistd.h>
#include <utility>

#include "service/log.h"

namespace farhorizon {

namespace {

std::function<void()>& LastCall() {
  static std::function<void()> call;
  return call;
}

}  // namespace

void BeforeSyncEnd(std::function<void()> call) { LastCall() = std::move(call); }

void EndAfterFailedSync(const std::string& what) {
  Log(LogLevel::kError,
      "the disk failed to keep what was written; the service ends, because nothing that it would "
      "answer could be trusted: look at the disk, then start it again",
      {{"error", what}});
  if (LastCall()) LastCall()();
  ::_exit(kExitDisk);
}

}  // namespace farhorizon
