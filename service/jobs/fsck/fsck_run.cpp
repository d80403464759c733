#include "service/jobs/fsck/fsck_run.h"

#include "service/jobs/fsck/check_objects.h"

namespace farhorizon {

void FsckRun::Fault(const std::string& line, bool mended) {
  ++sum.faults;
  if (mended) ++sum.mended;
  options.say(line + (mended ? ": mended" : ""));
}

bool FsckRun::SetAside(const std::filesystem::path& file, const char* why) const {
  return options.repair && MoveAside(file, directory.root / "stray" / why);
}

}  // namespace farhorizon
