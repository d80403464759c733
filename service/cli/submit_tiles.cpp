#include "service/cli/submit_tiles.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "core/io/file.h"
#include "core/io/sha256.h"
#include "service/cli/command.h"
#include "service/cli/remote_job.h"
#include "service/cli/tile_table.h"
#include "service/jobs/job.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Whether the same call may succeed later.
bool MayPass(const Error& error) {
  return error.code == ErrorCode::kResourceExhausted || error.code == ErrorCode::kCancelled ||
         error.kind == "connection";
}

void SetError(TileRow& row, const char* status, const Error& error) {
  row.status = MayPass(error) ? "unreached" : status;
  row.code = std::string(error.kind);
  row.detail = error.message;
}

class TilesRun {
 public:
  TilesRun(const JobClient& client, const TileSubmission& submission, Reporter& reporter)
      : client_(client),
        submission_(submission),
        reporter_(reporter),
        earlier_(TileTable::Read(TableFile())),
        table_(TableFile(), FirstRows()) {}

  Result<int> Run() {
    std::vector<std::thread> threads;
    const auto count = std::min<std::size_t>(static_cast<std::size_t>(submission_.at_once),
                                             submission_.tiles.size());
    for (std::size_t i = 0; i < count; ++i) threads.emplace_back([this] { Work(); });
    for (std::thread& thread : threads) thread.join();
    reporter_.Clear();
    if (Status written = table_.Write(); !written) return std::move(written.error());
    return Conclude();
  }

 private:
  [[nodiscard]] fs::path TableFile() const { return submission_.directory / "jobs.tsv"; }

  // What an earlier run knows of a job is not lost where this one is cut off.
  [[nodiscard]] std::vector<TileRow> FirstRows() const {
    std::vector<TileRow> rows;
    for (const std::string& dem : submission_.tiles) {
      const auto known = earlier_.find(dem);
      rows.push_back(known != earlier_.end() ? known->second : TileRow{dem, "", "waiting"});
    }
    return rows;
  }

  void Work() {
    for (std::size_t i = 0; (i = next_++) < submission_.tiles.size();) {
      if (client_.stop().stop_requested()) return;
      TileRow row{.dem = submission_.tiles[i]};
      RunTile(i, row);
      Store(i, row);
      const std::lock_guard lock(mutex_);
      const double share =
          static_cast<double>(++done_) / static_cast<double>(submission_.tiles.size());
      reporter_.Show("tiles", share, static_cast<int>(100 * share));
    }
  }

  void Store(std::size_t index, const TileRow& row) {
    const std::lock_guard lock(mutex_);
    // What cannot be written now is at the end, where it is an error.
    (void)table_.Set(index, row).has_value();
  }

  void RunTile(std::size_t index, TileRow& row) {
    const Result<std::string> sha256 = Sha256OfFile(row.dem);
    if (!sha256) return SetError(row, "refused", sha256.error());
    const fs::path name = fs::path(row.dem).filename();
    row.key = Sha256Hex("farhorizon submit\n" + *sha256 + "\n" + name.string() + "\n" +
                        EncodeQuery(submission_.parameters));
    const auto known = earlier_.find(row.dem);
    const bool same = known != earlier_.end() && known->second.key == row.key;
    const fs::path folder = submission_.directory / name;
    if (same) row.job = known->second.job;
    if (same && known->second.status == "successful" && HasArtifacts(folder)) {
      row.status = "successful";
      return;
    }
    if (!row.job.empty() && !Follow(index, row, folder)) row.job.clear();  // it was removed
    if (!row.job.empty()) return;
    const Result<json> sent = SendDem(client_, {row.dem, submission_.parameters, row.key});
    if (!sent) return SetError(row, "refused", sent.error());
    row.job = TextOf(*sent, "jobID");
    row.status = TextOf(*sent, "status");
    Store(index, row);
    Follow(index, row, folder);
  }

  // Waits for the job of `row` and fetches its artifacts; false where there is no such job.
  bool Follow(std::size_t index, TileRow& row, const fs::path& folder) {
    const auto heard = [&](const json& status) {
      const std::string now = TextOf(status, "status");
      if (now == row.status || now == "successful") return;
      row.status = now;
      Store(index, row);
    };
    const Result<json> end = WaitForEnd(client_, row.job, heard);
    if (!end && end.error().kind == "no-such-job") return false;
    if (!end) {
      SetError(row, "unreached", end.error());
      return true;
    }
    if (const Status success = SuccessOf(*end); !success) {
      SetError(row, "failed", success.error());
      row.status = TextOf(*end, "status");
      return true;
    }
    const Status fetched = FetchArtifacts(client_, row.job, folder, [](double) {});
    row.status = "successful";
    if (!fetched) SetError(row, "failed", fetched.error());
    return true;
  }

  [[nodiscard]] int Conclude() const {
    std::map<std::string, int> count;
    for (const TileRow& row : table_.rows()) ++count[row.status];
    const int all = static_cast<int>(table_.rows().size());
    std::fprintf(stderr, "farhorizon: %d of %d DEMs are done; %s says what became of each\n",
                 count["successful"], all, TableFile().c_str());
    if (count["successful"] == all) return kExitDone;
    if (client_.stop().stop_requested()) return kExitInterrupted;
    const int lost = count["refused"] + count["failed"] + count["dismissed"];
    return lost > 0 ? kExitData : kExitTryAgain;
  }

  const JobClient& client_;
  const TileSubmission& submission_;
  Reporter& reporter_;
  const std::map<std::string, TileRow> earlier_;
  std::mutex mutex_;  // of the table and the reporter
  TileTable table_;
  std::atomic<std::size_t> next_{0};
  int done_ = 0;
};

}  // namespace

Result<int> SubmitTiles(const JobClient& client, const TileSubmission& submission,
                        Reporter& reporter) {
  if (Status made = MakeFolder(submission.directory); !made) return std::move(made.error());
  return TilesRun(client, submission, reporter).Run();
}

}  // namespace farhorizon
