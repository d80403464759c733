#include "service/jobs/postgres_schema.h"

#include <array>
#include <cstdint>
#include <string>

namespace farhorizon {

namespace {

// What makes version i + 1 of the tables out of version i. None is ever changed, because databases
// exist that have gone through it. Each only adds, and what it adds may be left out of a row:
// programs of the version before go on with the tables while processes are replaced one after the
// other (tests/load/run upgrade). Ids and clients are compared as bytes, as SQLite does it.
//
// Beside what SQLite's tables have: whose a run is, until when, and how many runs of the job were
// lost; and when each client was served, which no process knows alone. Of each change but a lease
// that is made anew, a trigger tells whoever listens.
constexpr const char* kVersion1 = R"(
CREATE TABLE jobs (
  id TEXT COLLATE "C" PRIMARY KEY,
  state TEXT NOT NULL CHECK (state IN ('accepted','running','successful','failed','dismissed')),
  filename TEXT NOT NULL,
  parameters TEXT NOT NULL,
  input_sha256 TEXT COLLATE "C" NOT NULL,
  input_bytes BIGINT NOT NULL,
  progress BIGINT NOT NULL DEFAULT 0 CHECK (progress BETWEEN 0 AND 100),
  message TEXT NOT NULL DEFAULT '',
  created_ms BIGINT NOT NULL,
  started_ms BIGINT,
  finished_ms BIGINT,
  updated_ms BIGINT NOT NULL,
  attempt BIGINT NOT NULL DEFAULT 0,
  crash_count BIGINT NOT NULL DEFAULT 0,
  failure_code TEXT,
  failure_kind TEXT,
  failure_message TEXT,
  timings TEXT NOT NULL DEFAULT '{}',
  assumptions TEXT NOT NULL DEFAULT '[]',
  client TEXT COLLATE "C" NOT NULL DEFAULT '',
  run BIGINT NOT NULL DEFAULT 0,
  retries BIGINT NOT NULL DEFAULT 0,
  crashes BIGINT NOT NULL DEFAULT 0,
  not_before_ms BIGINT NOT NULL DEFAULT 0,
  priority BIGINT NOT NULL DEFAULT 1 CHECK (priority BETWEEN 0 AND 2),
  deadline_ms BIGINT,
  timeout_seconds BIGINT NOT NULL DEFAULT 0,
  cost_memory_bytes BIGINT NOT NULL DEFAULT 0,
  cost_seconds BIGINT NOT NULL DEFAULT 0,
  process TEXT NOT NULL DEFAULT 'terrain-lod',
  answer TEXT NOT NULL DEFAULT '',
  owner TEXT COLLATE "C" NOT NULL DEFAULT '',
  holder TEXT NOT NULL DEFAULT '',
  lease_until TIMESTAMPTZ,
  lost BIGINT NOT NULL DEFAULT 0,
  CHECK ((finished_ms IS NOT NULL) = (state IN ('successful','failed','dismissed'))),
  CHECK ((failure_code IS NOT NULL) = (state = 'failed')),
  CHECK (state <> 'running' OR lease_until IS NOT NULL)
);
CREATE INDEX jobs_waiting ON jobs (client, id) WHERE state = 'accepted';
CREATE INDEX jobs_by_priority ON jobs (priority, client, id) WHERE state = 'accepted';
CREATE INDEX jobs_by_deadline ON jobs (deadline_ms)
  WHERE state = 'accepted' AND deadline_ms IS NOT NULL;
CREATE INDEX jobs_running ON jobs (client) WHERE state = 'running';
CREATE INDEX jobs_by_state ON jobs (state, id);
CREATE INDEX jobs_by_input ON jobs (input_sha256);
CREATE INDEX jobs_by_end ON jobs (finished_ms, id) WHERE finished_ms IS NOT NULL;
CREATE INDEX jobs_by_owner ON jobs (owner, id) WHERE owner <> '';
CREATE INDEX jobs_by_update ON jobs (updated_ms);
CREATE TABLE artifacts (
  job_id TEXT COLLATE "C" NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  name TEXT COLLATE "C" NOT NULL,
  media_type TEXT NOT NULL,
  bytes BIGINT NOT NULL,
  sha256 TEXT COLLATE "C" NOT NULL,
  gzip_sha256 TEXT COLLATE "C",
  gzip_bytes BIGINT,
  PRIMARY KEY (job_id, name)
);
CREATE INDEX artifacts_by_object ON artifacts (sha256);
CREATE INDEX artifacts_by_gzip ON artifacts (gzip_sha256) WHERE gzip_sha256 IS NOT NULL;
CREATE TABLE idempotency_keys (
  owner TEXT COLLATE "C" NOT NULL DEFAULT '',
  key TEXT COLLATE "C" NOT NULL,
  job_id TEXT COLLATE "C" NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  created_ms BIGINT NOT NULL,
  PRIMARY KEY (owner, key)
);
CREATE INDEX idempotency_keys_by_job ON idempotency_keys (job_id);
CREATE INDEX idempotency_keys_by_age ON idempotency_keys (created_ms);
CREATE TABLE garbage (sha256 TEXT COLLATE "C" PRIMARY KEY);
CREATE SEQUENCE turn;
CREATE TABLE turns (
  client TEXT COLLATE "C" PRIMARY KEY,
  turn BIGINT NOT NULL
);
CREATE INDEX turns_in_order ON turns (turn);
CREATE TABLE store (
  one BIGINT PRIMARY KEY CHECK (one = 1),
  id TEXT NOT NULL,
  generation BIGINT NOT NULL DEFAULT 0,
  pings BIGINT NOT NULL DEFAULT 0
);
INSERT INTO store (one, id) VALUES (1, replace(gen_random_uuid()::text, '-', ''));
CREATE FUNCTION tell_of_change() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  PERFORM pg_notify('farhorizon_jobs', 'changed ' || OLD.id);
  RETURN NULL;
END $$;
CREATE TRIGGER changes_are_told AFTER UPDATE OF updated_ms OR DELETE ON jobs
  FOR EACH ROW EXECUTE FUNCTION tell_of_change();
)";
constexpr const char* kVersion2 = R"(
CREATE TABLE uploads (
  id TEXT COLLATE "C" PRIMARY KEY,
  owner TEXT COLLATE "C" NOT NULL,
  client TEXT COLLATE "C" NOT NULL,
  filename TEXT NOT NULL,
  media_type TEXT NOT NULL,
  metadata TEXT NOT NULL,
  bytes BIGINT,
  offset_bytes BIGINT NOT NULL DEFAULT 0,
  turn BIGINT NOT NULL DEFAULT 0,
  sha256 TEXT COLLATE "C",
  created_ms BIGINT NOT NULL,
  expires_ms BIGINT NOT NULL,
  CHECK (offset_bytes BETWEEN 0 AND coalesce(bytes, offset_bytes))
);
CREATE INDEX uploads_by_client ON uploads (client);
CREATE INDEX uploads_by_end ON uploads (expires_ms);
CREATE INDEX uploads_by_object ON uploads (sha256) WHERE sha256 IS NOT NULL;
CREATE TABLE upload_parts (
  upload_id TEXT COLLATE "C" NOT NULL REFERENCES uploads (id) ON DELETE CASCADE,
  at_offset BIGINT NOT NULL,
  bytes BIGINT NOT NULL,
  sha256 TEXT COLLATE "C" NOT NULL,
  PRIMARY KEY (upload_id, at_offset)
);
CREATE INDEX upload_parts_by_object ON upload_parts (sha256);
)";
// The outbox of calls to subscribers (sql_callbacks.h). The trigger is how no change of a state can
// forget them; its times are the server's.
constexpr const char* kVersion3 = R"(
ALTER TABLE jobs ADD COLUMN source TEXT NOT NULL DEFAULT '';
CREATE TABLE callbacks (
  job_id TEXT COLLATE "C" NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  event TEXT NOT NULL CHECK (event IN ('in-progress','success','failure')),
  url TEXT NOT NULL,
  state TEXT NOT NULL DEFAULT 'armed'
    CHECK (state IN ('armed','due','delivered','given-up','dropped')),
  attempts BIGINT NOT NULL DEFAULT 0,
  since_ms BIGINT NOT NULL DEFAULT 0,
  due_ms BIGINT NOT NULL DEFAULT 0,
  PRIMARY KEY (job_id, event)
);
CREATE INDEX callbacks_by_time ON callbacks (due_ms) WHERE state = 'due';
CREATE FUNCTION call_subscribers() RETURNS trigger LANGUAGE plpgsql AS $$
DECLARE
  now_ms BIGINT := extract(epoch FROM clock_timestamp()) * 1000;
BEGIN
  UPDATE farhorizon.callbacks SET state = 'due', since_ms = now_ms, due_ms = now_ms
  WHERE job_id = NEW.id AND state = 'armed' AND event = CASE NEW.state
    WHEN 'running' THEN 'in-progress' WHEN 'successful' THEN 'success' ELSE 'failure' END;
  UPDATE farhorizon.callbacks SET state = 'dropped'
  WHERE job_id = NEW.id AND NEW.finished_ms IS NOT NULL
    AND (state = 'armed' OR (state = 'due' AND event = 'in-progress'));
  RETURN NULL;
END $$;
CREATE TRIGGER subscribers_are_called AFTER UPDATE OF state ON jobs
  FOR EACH ROW WHEN (NEW.state <> OLD.state AND NEW.state <> 'accepted')
  EXECUTE FUNCTION call_subscribers();
)";
constexpr const char* kVersion4 = R"(
ALTER TABLE artifacts ADD COLUMN zstd_sha256 TEXT COLLATE "C";
ALTER TABLE artifacts ADD COLUMN zstd_bytes BIGINT;
CREATE INDEX artifacts_by_zstd ON artifacts (zstd_sha256) WHERE zstd_sha256 IS NOT NULL;
)";
constexpr std::array kVersions = {kVersion1, kVersion2, kVersion3, kVersion4};
constexpr auto kLatest = static_cast<std::int64_t>(kVersions.size());

std::int64_t VersionOf(const PostgresDatabase& database) {
  Statement version(database, "SELECT version FROM farhorizon.schema_version");
  return version.Step() ? version.Integer(0) : 0;
}

[[noreturn]] void Refuse(const std::string& why) {
  throw SqlFailure{{ErrorCode::kIo, "job store: " + why, "job-store-unusable"}};
}

}  // namespace

void PreparePostgresSchema(PostgresDatabase& database) {
  Statement encoding(database, "SELECT current_setting('server_encoding')");
  if (!encoding.Step() || encoding.Text(0) != "UTF8") {
    Refuse("the encoding of the database is " + encoding.Text(0) +
           "; make one with ENCODING 'UTF8' TEMPLATE template0");
  }
  Transaction transaction(database);
  database.Execute(
      "SET LOCAL lock_timeout = 60000; SET LOCAL statement_timeout = 600000;"
      "SELECT pg_advisory_xact_lock(1179142739);"
      "CREATE SCHEMA IF NOT EXISTS farhorizon;"
      "CREATE TABLE IF NOT EXISTS farhorizon.schema_version (version BIGINT NOT NULL)");
  const std::int64_t version = VersionOf(database);
  if (version > kLatest) {
    Refuse("the tables are those of a newer farhorizon (schema " + std::to_string(version) +
           ", this one knows " + std::to_string(kLatest) + "); start that one");
  }
  for (std::int64_t next = version; next < kLatest; ++next) {
    database.Execute(kVersions.at(static_cast<std::size_t>(next)));
  }
  if (version == 0) database.Execute("INSERT INTO farhorizon.schema_version VALUES (0)");
  if (version < kLatest) {
    Statement(database, "UPDATE farhorizon.schema_version SET version = ?").Bind(kLatest).Run();
  }
  transaction.Commit();
}

}  // namespace farhorizon
