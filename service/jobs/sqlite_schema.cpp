#include "service/jobs/sqlite_schema.h"

#include <array>

namespace farhorizon {

namespace {

constexpr int kApplicationId = 0x46484A53;  // "FHJS"
// What makes version i + 1 of the tables out of version i. The file's user_version is the number of
// those that it has gone through; none is ever changed, because files exist that have.
constexpr const char* kVersion1 = R"(
CREATE TABLE jobs (
  id TEXT PRIMARY KEY,
  state TEXT NOT NULL CHECK (state IN ('accepted','running','successful','failed','dismissed')),
  filename TEXT NOT NULL,
  parameters TEXT NOT NULL,
  input_sha256 TEXT NOT NULL,
  input_bytes INTEGER NOT NULL,
  progress INTEGER NOT NULL DEFAULT 0 CHECK (progress BETWEEN 0 AND 100),
  message TEXT NOT NULL DEFAULT '',
  created_ms INTEGER NOT NULL,
  started_ms INTEGER,
  finished_ms INTEGER,
  updated_ms INTEGER NOT NULL,
  attempt INTEGER NOT NULL DEFAULT 0,
  crash_count INTEGER NOT NULL DEFAULT 0,
  failure_code TEXT,
  failure_kind TEXT,
  failure_message TEXT,
  timings TEXT NOT NULL DEFAULT '{}',
  CHECK ((finished_ms IS NOT NULL) = (state IN ('successful','failed','dismissed'))),
  CHECK ((failure_code IS NOT NULL) = (state = 'failed'))
) STRICT, WITHOUT ROWID;
CREATE INDEX jobs_by_state ON jobs (state, id);
CREATE INDEX jobs_by_input ON jobs (input_sha256);
CREATE TABLE artifacts (
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  name TEXT NOT NULL,
  media_type TEXT NOT NULL,
  bytes INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  PRIMARY KEY (job_id, name)
) STRICT, WITHOUT ROWID;
CREATE INDEX artifacts_by_object ON artifacts (sha256);
CREATE TABLE idempotency_keys (
  key TEXT PRIMARY KEY,
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  created_ms INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
CREATE INDEX idempotency_keys_by_job ON idempotency_keys (job_id);
)";
constexpr const char* kVersion2 = R"(
ALTER TABLE jobs ADD COLUMN assumptions TEXT NOT NULL DEFAULT '[]';
)";
constexpr const char* kVersion3 = R"(
ALTER TABLE jobs ADD COLUMN client TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN run INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN retries INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN crashes INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN not_before_ms INTEGER NOT NULL DEFAULT 0;
UPDATE jobs SET run = attempt;
CREATE INDEX jobs_by_client ON jobs (state, client, id);
CREATE INDEX jobs_by_end ON jobs (finished_ms, id) WHERE finished_ms IS NOT NULL;
CREATE TABLE garbage (sha256 TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;
CREATE TABLE store (
  one INTEGER PRIMARY KEY CHECK (one = 1),
  id TEXT NOT NULL,
  generation INTEGER NOT NULL DEFAULT 0,
  pings INTEGER NOT NULL DEFAULT 0
) STRICT;
INSERT INTO store (one, id) VALUES (1, lower(hex(randomblob(16))));
)";
constexpr const char* kVersion4 = R"(
ALTER TABLE artifacts ADD COLUMN gzip_sha256 TEXT;
ALTER TABLE artifacts ADD COLUMN gzip_bytes INTEGER;
CREATE INDEX artifacts_by_gzip ON artifacts (gzip_sha256) WHERE gzip_sha256 IS NOT NULL;
)";
// A priority is a number, so that an index has its order. Of the jobs that were accepted before,
// nobody has looked at the cost.
constexpr const char* kVersion5 = R"(
ALTER TABLE jobs ADD COLUMN priority INTEGER NOT NULL DEFAULT 1 CHECK (priority BETWEEN 0 AND 2);
ALTER TABLE jobs ADD COLUMN deadline_ms INTEGER;
ALTER TABLE jobs ADD COLUMN timeout_seconds INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN cost_memory_bytes INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN cost_seconds INTEGER NOT NULL DEFAULT 0;
CREATE INDEX jobs_by_priority ON jobs (priority, client, id) WHERE state = 'accepted';
CREATE INDEX jobs_by_deadline ON jobs (deadline_ms)
  WHERE state = 'accepted' AND deadline_ms IS NOT NULL;
)";
constexpr const char* kVersion6 = R"(
ALTER TABLE jobs ADD COLUMN process TEXT NOT NULL DEFAULT 'terrain-lod';
ALTER TABLE jobs ADD COLUMN answer TEXT NOT NULL DEFAULT '';
)";

// Jobs of before belong to nobody: where keys are asked for, those with the scope admin see them.
constexpr const char* kVersion7 = R"(
ALTER TABLE jobs ADD COLUMN owner TEXT NOT NULL DEFAULT '';
CREATE INDEX jobs_by_owner ON jobs (owner, id) WHERE owner <> '';
ALTER TABLE idempotency_keys RENAME TO idempotency_keys_of_all;
DROP INDEX idempotency_keys_by_job;
CREATE TABLE idempotency_keys (
  owner TEXT NOT NULL DEFAULT '',
  key TEXT NOT NULL,
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  created_ms INTEGER NOT NULL,
  PRIMARY KEY (owner, key)
) STRICT, WITHOUT ROWID;
INSERT INTO idempotency_keys (key, job_id, created_ms)
  SELECT key, job_id, created_ms FROM idempotency_keys_of_all;
DROP TABLE idempotency_keys_of_all;
CREATE INDEX idempotency_keys_by_job ON idempotency_keys (job_id);
)";
constexpr const char* kVersion8 = R"(
CREATE TABLE uploads (
  id TEXT PRIMARY KEY,
  owner TEXT NOT NULL,
  client TEXT NOT NULL,
  filename TEXT NOT NULL,
  media_type TEXT NOT NULL,
  metadata TEXT NOT NULL,
  bytes INTEGER,
  offset_bytes INTEGER NOT NULL DEFAULT 0,
  turn INTEGER NOT NULL DEFAULT 0,
  sha256 TEXT,
  created_ms INTEGER NOT NULL,
  expires_ms INTEGER NOT NULL,
  CHECK (offset_bytes BETWEEN 0 AND coalesce(bytes, offset_bytes))
) STRICT, WITHOUT ROWID;
CREATE INDEX uploads_by_client ON uploads (client);
CREATE INDEX uploads_by_end ON uploads (expires_ms);
CREATE INDEX uploads_by_object ON uploads (sha256) WHERE sha256 IS NOT NULL;
CREATE TABLE upload_parts (
  upload_id TEXT NOT NULL REFERENCES uploads (id) ON DELETE CASCADE,
  at_offset INTEGER NOT NULL,
  bytes INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  PRIMARY KEY (upload_id, at_offset)
) STRICT, WITHOUT ROWID;
CREATE INDEX upload_parts_by_object ON upload_parts (sha256);
)";
// The outbox of calls to subscribers (sql_callbacks.h). The trigger is how no change of a state can
// forget them.
constexpr const char* kVersion9 = R"(
ALTER TABLE jobs ADD COLUMN source TEXT NOT NULL DEFAULT '';
CREATE TABLE callbacks (
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  event TEXT NOT NULL CHECK (event IN ('in-progress','success','failure')),
  url TEXT NOT NULL,
  state TEXT NOT NULL DEFAULT 'armed'
    CHECK (state IN ('armed','due','delivered','given-up','dropped')),
  attempts INTEGER NOT NULL DEFAULT 0,
  since_ms INTEGER NOT NULL DEFAULT 0,
  due_ms INTEGER NOT NULL DEFAULT 0,
  PRIMARY KEY (job_id, event)
) STRICT, WITHOUT ROWID;
CREATE INDEX callbacks_by_time ON callbacks (due_ms) WHERE state = 'due';
CREATE TRIGGER subscribers_are_called AFTER UPDATE OF state ON jobs
WHEN NEW.state <> OLD.state AND NEW.state <> 'accepted'
BEGIN
  UPDATE callbacks SET state = 'due', since_ms = NEW.updated_ms, due_ms = NEW.updated_ms
  WHERE job_id = NEW.id AND state = 'armed' AND event = CASE NEW.state
    WHEN 'running' THEN 'in-progress' WHEN 'successful' THEN 'success' ELSE 'failure' END;
  UPDATE callbacks SET state = 'dropped'
  WHERE job_id = NEW.id AND NEW.finished_ms IS NOT NULL
    AND (state = 'armed' OR (state = 'due' AND event = 'in-progress'));
END;
)";
constexpr const char* kVersion10 = R"(
ALTER TABLE artifacts ADD COLUMN zstd_sha256 TEXT;
ALTER TABLE artifacts ADD COLUMN zstd_bytes INTEGER;
CREATE INDEX artifacts_by_zstd ON artifacts (zstd_sha256) WHERE zstd_sha256 IS NOT NULL;
)";
constexpr std::array kVersions = {kVersion1, kVersion2, kVersion3, kVersion4, kVersion5,
                                  kVersion6, kVersion7, kVersion8, kVersion9, kVersion10};

std::int64_t CountOfTables(Database& database) {
  Statement count(database, "SELECT count(*) FROM sqlite_schema");
  count.Step();
  return count.Integer(0);
}

void Migrate(Database& database) {
  Transaction transaction(database);
  for (std::int64_t version = database.Pragma("user_version"); version < kSchemaVersion;
       ++version) {
    if (version == 0) {
      database.Execute(("PRAGMA application_id = " + std::to_string(kApplicationId)).c_str());
    }
    database.Execute(kVersions[static_cast<std::size_t>(version)]);
    database.Execute(("PRAGMA user_version = " + std::to_string(version + 1)).c_str());
  }
  transaction.Commit();
}

}  // namespace

const std::int64_t kSchemaVersion = static_cast<std::int64_t>(kVersions.size());

void PrepareSchema(Database& database) {
  const std::int64_t application = database.Pragma("application_id");
  const std::int64_t version = database.Pragma("user_version");
  // A first start that was cut off leaves a page without a table.
  const bool is_new = version == 0 && CountOfTables(database) == 0;
  if (!is_new && application != kApplicationId) {
    throw SqlFailure{{ErrorCode::kIo,
                      "job store: the file is no job store of farhorizon; put the right one "
                      "back, or give another data directory",
                      "job-store-unusable"}};
  }
  if (version > kSchemaVersion) {
    throw SqlFailure{{ErrorCode::kIo,
                      "job store: the file comes from a newer farhorizon (schema " +
                          std::to_string(version) + ", this one knows " +
                          std::to_string(kSchemaVersion) +
                          "); start that one, or put the backup from before it back",
                      "job-store-unusable"}};
  }
  database.Execute(
      "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;"
      "PRAGMA trusted_schema = OFF; PRAGMA mmap_size = 0; PRAGMA busy_timeout = 2000;");
  // Some builds of SQLite ignore the pragma, and durability depends on it.
  if (database.Pragma("synchronous") != 2) {
    throw SqlFailure{{ErrorCode::kIo, "cannot set synchronous=FULL"}};
  }
  // Before the migration, which would only spread the damage.
  Statement check(database, "PRAGMA quick_check(1)");
  if (!check.Step() || check.Text(0) != "ok") {
    throw SqlFailure{{ErrorCode::kIo, "quick_check says: " + check.Text(0)}};
  }
  while (check.Step()) {
  }
  Migrate(database);
}

}  // namespace farhorizon
