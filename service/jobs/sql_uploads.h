#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "service/jobs/object_store.h"
#include "service/jobs/sql.h"
#include "service/jobs/upload.h"

namespace farhorizon {

// The rows of uploads. Each function is for a transaction; what it does to an upload it does alone,
// for it changes the upload's own row first. Throws: SqlFailure.

/// Errors: kResourceExhausted "too-many-uploads" where the client has as many as it may, or as many
///   bytes; "uploads-full" where all clients together have.
Status InsertUpload(const SqlDatabase& database, const Upload& upload, const UploadBounds& bounds);

/// nullopt where it is not there, or its time has passed.
std::optional<Upload> SelectUpload(const SqlDatabase& database, const std::string& id,
                                   std::int64_t now_ms);
/// In their order.
std::vector<UploadPart> SelectParts(const SqlDatabase& database, const std::string& id);

/// Gives the turn to a request that begins at `upload.offset`: the one that had it stores nothing
/// more. Sets upload.turn, and in the row upload.bytes. False where the offset is another by now,
/// or the length was another before.
bool TakeTurn(const SqlDatabase& database, Upload& upload);

/// Stores a part that ends the upload for now, in place of the parts from its offset on, for the
/// request that has the turn; upload.offset is the end so far. False where another has it.
bool AppendPart(const SqlDatabase& database, const Upload& upload, const UploadPart& part,
                std::int64_t expires_ms);

/// Names the object that has all of a complete upload, in place of its parts.
void SettleUpload(const SqlDatabase& database, const std::string& id, const StoredObject& whole,
                  std::int64_t expires_ms);

/// Removes the row; its objects become garbage. False without such a row.
bool RemoveUpload(const SqlDatabase& database, const std::string& id);
/// The same for the uploads whose time has passed, at most a hundred; returns how many.
std::int64_t RemoveExpiredUploads(const SqlDatabase& database, std::int64_t now_ms);

UploadCounts CountUploads(const SqlDatabase& database);

/// Whether the object is a part of an upload, or all of one.
bool IsOfUpload(const SqlDatabase& database, const std::string& sha256);

}  // namespace farhorizon
