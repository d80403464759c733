#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/base/result.h"
#include "service/jobs/object_store.h"
#include "service/s3/s3_credentials.h"
#include "service/s3/s3_location.h"

namespace farhorizon {

/// Where objects are in a bucket, and where their copies are on this machine.
struct S3StoreOptions {
  S3Location location;
  std::filesystem::path credentials;  ///< as S3Credentials has it
  std::filesystem::path cache;        ///< a folder of this process alone
  std::int64_t cache_bytes = 0;
  std::int64_t least_free_bytes = 0;                              ///< that copies leave on the disk
  std::chrono::milliseconds patience = std::chrono::seconds(10);  ///< as ObjectCache::Make has it
};

/// Objects in a bucket of S3-compatible storage, which any number of processes share:
///   objects/SHA256    the bytes
///   incoming/SHA256   empty: put, and not yet kept. Put before the object, and removed after it
///   stray/SHA256      a stray; made by a copy within the bucket, for S3 has no rename
///   identity          the label
///   probe             what CheckWrites writes
/// So a put has one request more than its bytes need, a batch of Keep one, one of removals two.
/// What a kill leaves half done is an incoming name, with an object or without, or parts of an
/// upload, which are no object; a second put of the same bytes replaces an object, never a part of
/// it. Objects are put unconditionally, so that damaged ones heal; the label alone is put with
/// If-None-Match.
///
/// Reads go by an ObjectCache, which PutFile fills too: what is sent is not fetched again.
/// Errors of all calls: kIo "storage" where the bucket is out of reach, fails or refuses the keys.
///
/// The client is libcurl with its own signing, not GDAL's /vsis3/, which has no conditional put,
/// sends no sum of a body and tells a missing key from other failures by no more than errno. On
/// npm's s3rver, over loopback, 300 MB are put in 2.7 s and got in 0.45, by /vsis3/ in 3.4 and 1.1;
/// 20 kB in 3.6 and 2.4 ms, and in 3.9 and 2.2.
/// Errors: kIo "storage" where the bucket is not there, or refuses these keys, with the remedy.
Result<std::unique_ptr<ObjectStore>> OpenS3ObjectStore(const S3StoreOptions& options);

}  // namespace farhorizon
