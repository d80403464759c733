#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/io/unique_fd.h"
#include "service/jobs/storage_file.h"

namespace farhorizon {

/// A stored object, open for reading from its start.
struct OpenObject {
  UniqueFd fd;
  std::int64_t bytes = 0;
};

/// The name and the size of a stored object.
struct StoredObject {
  std::string sha256;
  std::int64_t bytes = 0;
};

/// Lists of objects.
enum class ObjectList {
  kAll,       ///< but strays
  kIncoming,  ///< of these, those of which it is not said yet that a row names them
  kStray,     ///< set aside: no row knew them
};

/// Write-once files named by the SHA-256 of their content: uploads and artifacts.
///
/// Properties, which the conformance suite holds every implementation to:
/// (1) An object that PutFile has answered is durable and reads back byte for byte until Remove.
/// (2) A reader never finds a part of an object. (3) Putting the same bytes twice stores them once;
/// the second time replaces what may have been damaged since. (4) An object that was put, but not
/// kept, when the process was killed is incoming afterwards; after a power cut it may not be.
/// Threads: safe; Requires: nobody removes an object while another thread puts it.
class ObjectStore {
 public:
  ObjectStore() = default;
  virtual ~ObjectStore() = default;
  ObjectStore(const ObjectStore&) = delete;
  ObjectStore& operator=(const ObjectStore&) = delete;

  /// Stores the file's bytes as an incoming object. Afterwards `file` is gone or unchanged.
  /// Requires: a regular file, no link. Errors: kIo, kResourceExhausted "no-space".
  virtual Result<StoredObject> PutFile(const std::filesystem::path& file) = 0;
  /// Takes the objects off the list of the incoming. To be called once a row names them.
  virtual void Keep(const std::vector<std::string>& names) = 0;

  /// Errors: kNotFound.
  virtual Result<OpenObject> Open(const std::string& sha256) = 0;

  /// Copies the object to the new file `target`, for a program that must not reach the store.
  /// Errors: kNotFound; kIo "input-corrupt" where the stored bytes have another SHA-256.
  virtual Status CopyTo(const std::string& sha256, const std::filesystem::path& target) = 0;

  /// Removes the object if the store has it.
  virtual Status Remove(const std::string& sha256) = 0;
  /// The same for many: all but some are gone where it fails.
  virtual Status RemoveAll(const std::vector<std::string>& names);
  /// Makes the object a stray.
  virtual Status SetAside(const std::string& sha256) = 0;
  /// Makes a stray an object again.
  virtual Status TakeBack(const std::string& sha256) = 0;
  virtual Result<std::vector<std::string>> List(ObjectList which) = 0;

  /// Says that the bytes that Open gave are not those of the name: a store that keeps copies gets
  /// the object anew the next time.
  virtual void Distrust(const std::string& /*sha256*/) {}

  /// A line of text beside the objects, which says whose they are. Errors: kNotFound.
  virtual Result<std::string> Label() = 0;
  virtual Status SetLabel(const std::string& label) = 0;
  /// Sets the label where there is none. Returns the one that is there afterwards: of several that
  /// call this at once, all get the same.
  virtual Result<std::string> ClaimLabel(const std::string& label) = 0;

  /// Succeeds if an object can be stored now, or could some seconds ago. Errors: those of PutFile.
  virtual Status CheckWrites() = 0;
  /// What the storage has left. Cost: no write.
  virtual Result<DiskRoom> Room() = 0;
};

/// Copies all bytes of `from` to `to`; their SHA-256 and number. Errors: those of StorageError.
Result<StoredObject> CopyAndHash(int from, int to);

/// Opens a file that has an object's bytes. Errors: kNotFound; those of StorageError.
Result<OpenObject> OpenObjectFile(const std::filesystem::path& file);

/// Copies the object to the new file `target`. Errors: as ObjectStore::CopyTo.
Status CopyObject(const OpenObject& object, const std::string& sha256,
                  const std::filesystem::path& target);

/// True for a SHA-256 in lower-case hexadecimal.
bool IsSha256(const std::string& text);

}  // namespace farhorizon
