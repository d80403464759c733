// A request that writes to an upload has its turn until the next one begins, so that what a
// half-open connection still brings, or a process that was frozen, is never mixed with what the
// client has sent anew: whoever has no turn changes no row.
#include "service/jobs/sql_uploads.h"

#include "service/jobs/sql_queue.h"

namespace farhorizon {

namespace {

constexpr std::int64_t kMostUploadsRemoved = 100;

constexpr const char* kColumns =
    "id, owner, client, filename, media_type, metadata, bytes, offset_bytes, turn, sha256, "
    "created_ms, expires_ms";

// The uploads that count for the bounds: a job that has the same bytes counts for its own.
constexpr const char* kOfNoJob =
    "(sha256 IS NULL OR NOT EXISTS (SELECT 1 FROM jobs WHERE input_sha256 = uploads.sha256))";

Upload ReadUpload(const Statement& row) {
  Upload upload;
  upload.id = row.Text(0);
  upload.owner = row.Text(1);
  upload.client = row.Text(2);
  upload.filename = row.Text(3);
  upload.media_type = row.Text(4);
  upload.metadata = row.Text(5);
  if (!row.IsNull(6)) upload.bytes = row.Integer(6);
  upload.offset = row.Integer(7);
  upload.turn = row.Integer(8);
  if (!row.IsNull(9)) upload.sha256 = row.Text(9);
  upload.created_ms = row.Integer(10);
  upload.expires_ms = row.Integer(11);
  return upload;
}

struct Taken {
  std::int64_t uploads = 0;
  std::int64_t bytes = 0;
};

// Sums over the rows of `where`, with one parameter or none.
Taken Sum(const SqlDatabase& database, const std::string& where, const std::string* parameter,
          std::int64_t each) {
  Statement sum(database,
                "SELECT count(*), coalesce(sum(coalesce(bytes, CAST(? AS BIGINT))), 0) "
                "FROM uploads WHERE " +
                    where + kOfNoJob);
  sum.Bind(each);
  if (parameter != nullptr) sum.Bind(*parameter);
  sum.Step();
  return {sum.Integer(0), sum.Integer(1)};
}

Error Full(const std::string& whose, const Taken& taken, ErrorKind kind) {
  return {ErrorCode::kResourceExhausted,
          whose + " uploads without a job, " + std::to_string(taken.uploads) + " of " +
              std::to_string(taken.bytes) +
              " bytes, leave no room for this one; finish or delete some, or try again later",
          kind};
}

void DropParts(const SqlDatabase& database, const std::string& id, std::int64_t from) {
  constexpr const char* kWhere = "upload_parts WHERE upload_id = ? AND at_offset >= ?";
  Statement(database, std::string("INSERT INTO garbage SELECT DISTINCT sha256 FROM ") + kWhere +
                          " ON CONFLICT DO NOTHING")
      .Bind(id)
      .Bind(from)
      .Run();
  Statement(database, std::string("DELETE FROM ") + kWhere).Bind(id).Bind(from).Run();
}

}  // namespace

Status InsertUpload(const SqlDatabase& database, const Upload& upload, const UploadBounds& bounds) {
  LockQueue(database);  // nobody else takes the same room
  const std::int64_t bytes = upload.bytes.value_or(bounds.each);
  const Taken own = Sum(database, "client = ? AND ", &upload.client, bounds.each);
  if (own.uploads >= bounds.of_client || own.bytes + bytes > bounds.bytes_of_client) {
    return Full("your", own, "too-many-uploads");
  }
  const Taken all = Sum(database, "", nullptr, bounds.each);
  if (all.uploads >= bounds.all || all.bytes + bytes > bounds.bytes) {
    return Full("all clients'", all, "uploads-full");
  }
  Statement insert(database,
                   "INSERT INTO uploads (id, owner, client, filename, media_type, metadata, bytes, "
                   "created_ms, expires_ms) "
                   "VALUES (?, ?, ?, ?, ?, ?, nullif(CAST(? AS BIGINT), -1), ?, ?)");
  insert.Bind(upload.id).Bind(upload.owner).Bind(upload.client).Bind(upload.filename);
  insert.Bind(upload.media_type).Bind(upload.metadata).Bind(upload.bytes.value_or(-1));
  insert.Bind(upload.created_ms).Bind(upload.expires_ms).Run();
  return Ok{};
}

std::optional<Upload> SelectUpload(const SqlDatabase& database, const std::string& id,
                                   std::int64_t now_ms) {
  Statement row(database, std::string("SELECT ") + kColumns +
                              " FROM uploads WHERE id = ? AND expires_ms > ?");
  if (!row.Bind(id).Bind(now_ms).Step()) return std::nullopt;
  return ReadUpload(row);
}

std::vector<UploadPart> SelectParts(const SqlDatabase& database, const std::string& id) {
  Statement rows(database,
                 "SELECT at_offset, bytes, sha256 FROM upload_parts WHERE upload_id = ? "
                 "ORDER BY at_offset");
  rows.Bind(id);
  std::vector<UploadPart> parts;
  while (rows.Step()) parts.push_back({rows.Integer(0), rows.Integer(1), rows.Text(2)});
  return parts;
}

bool TakeTurn(const SqlDatabase& database, Upload& upload) {
  const std::int64_t bytes = upload.bytes.value_or(-1);
  Statement take(database,
                 "UPDATE uploads SET turn = turn + 1, "
                 "bytes = coalesce(bytes, nullif(CAST(? AS BIGINT), -1)) "
                 "WHERE id = ? AND offset_bytes = ? AND coalesce(bytes, CAST(? AS BIGINT)) = ? "
                 "RETURNING turn");
  take.Bind(bytes).Bind(upload.id).Bind(upload.offset).Bind(bytes).Bind(bytes);
  if (!take.Step()) return false;
  upload.turn = take.Integer(0);
  take.Run();
  return true;
}

bool AppendPart(const SqlDatabase& database, const Upload& upload, const UploadPart& part,
                std::int64_t expires_ms) {
  Statement move(database,
                 "UPDATE uploads SET offset_bytes = ?, expires_ms = ? "
                 "WHERE id = ? AND turn = ? AND offset_bytes = ?");
  move.Bind(part.offset + part.bytes).Bind(expires_ms);
  move.Bind(upload.id).Bind(upload.turn).Bind(upload.offset);
  if (move.Run() == 0) return false;
  DropParts(database, upload.id, part.offset);
  Statement insert(database,
                   "INSERT INTO upload_parts (upload_id, at_offset, bytes, sha256) "
                   "VALUES (?, ?, ?, ?)");
  insert.Bind(upload.id).Bind(part.offset).Bind(part.bytes).Bind(part.sha256).Run();
  return true;
}

void SettleUpload(const SqlDatabase& database, const std::string& id, const StoredObject& whole,
                  std::int64_t expires_ms) {
  Statement settle(database,
                   "UPDATE uploads SET sha256 = ?, expires_ms = ? "
                   "WHERE id = ? AND bytes = ? AND offset_bytes = bytes");
  settle.Bind(whole.sha256).Bind(expires_ms).Bind(id).Bind(whole.bytes);
  if (settle.Run() > 0) DropParts(database, id, 0);
}

bool RemoveUpload(const SqlDatabase& database, const std::string& id) {
  Statement row(database, "SELECT sha256 FROM uploads WHERE id = ?" + database.dialect().lock_rows);
  if (!row.Bind(id).Step()) return false;
  if (!row.IsNull(0)) {
    Statement(database, "INSERT INTO garbage VALUES (?) ON CONFLICT DO NOTHING")
        .Bind(row.Text(0))
        .Run();
  }
  DropParts(database, id, 0);
  Statement(database, "DELETE FROM uploads WHERE id = ?").Bind(id).Run();
  return true;
}

std::int64_t RemoveExpiredUploads(const SqlDatabase& database, std::int64_t now_ms) {
  std::vector<std::string> ids;
  {
    Statement rows(database, "SELECT id FROM uploads WHERE expires_ms <= ? LIMIT ?" +
                                 database.dialect().lock_free);
    rows.Bind(now_ms).Bind(kMostUploadsRemoved);
    while (rows.Step()) ids.push_back(rows.Text(0));
  }
  for (const std::string& id : ids) RemoveUpload(database, id);
  return static_cast<std::int64_t>(ids.size());
}

UploadCounts CountUploads(const SqlDatabase& database) {
  Statement sum(database,
                std::string("SELECT count(*), coalesce(sum(offset_bytes), 0) FROM uploads WHERE ") +
                    kOfNoJob);
  sum.Step();
  return {sum.Integer(0), sum.Integer(1)};
}

bool IsOfUpload(const SqlDatabase& database, const std::string& sha256) {
  Statement row(database,
                "SELECT 1 FROM upload_parts WHERE sha256 = ? UNION ALL "
                "SELECT 1 FROM uploads WHERE sha256 = ? LIMIT 1");
  return row.Bind(sha256).Bind(sha256).Step();
}

}  // namespace farhorizon
