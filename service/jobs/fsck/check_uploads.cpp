#include "service/jobs/fsck/check_uploads.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "service/jobs/sql_uploads.h"

namespace farhorizon {

namespace {

bool IsGood(const FsckRun& run, const std::string& sha256, std::int64_t bytes) {
  const auto found = run.good.find(sha256);
  return found != run.good.end() && found->second == bytes;
}

bool IsWhole(const FsckRun& run, const Database& database, const Upload& upload) {
  if (!upload.sha256.empty()) return IsGood(run, upload.sha256, upload.offset);
  std::int64_t end = 0;
  for (const UploadPart& part : SelectParts(database, upload.id)) {
    if (part.offset != end || !IsGood(run, part.sha256, part.bytes)) return false;
    end += part.bytes;
  }
  return end == upload.offset;
}

}  // namespace

void CheckUploads(FsckRun& run, Database& database) {
  std::vector<std::string> ids;
  Statement rows(database, "SELECT id FROM uploads");
  while (rows.Step()) ids.push_back(rows.Text(0));
  for (const std::string& id : ids) {
    const std::optional<Upload> upload = SelectUpload(database, id, 0);
    if (!upload || IsWhole(run, database, *upload)) continue;
    if (run.options.repair) {
      Transaction transaction(database);
      RemoveUpload(database, id);
      transaction.Commit();
    }
    run.Fault("upload " + id + ": bytes of it are lost or damaged; its client begins anew",
              run.options.repair);
  }
}

}  // namespace farhorizon
