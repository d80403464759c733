#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/base/result.h"
#include "service/auth/api_key.h"

namespace farhorizon {

/// The keys of a service are a file of their own, a JSON document, and no table of its database:
/// one process alone may write to that, the service, while `farhorizon keys` works beside it. The
/// file is replaced as a whole, so readers see the old keys or the new ones; a replica on another
/// machine can be given a copy, and it has no text of a key.

/// All keys, those that were revoked too; kNotFound where there is no file.
/// Errors: kIo "data-directory" where it cannot be read, or is no file of keys.
Result<std::vector<ApiKey>> ReadKeys(const std::filesystem::path& file);

/// Replaces the file by what `change` makes of its keys (of none where there is no file), durably,
/// while no other call does. Makes the folder where it is missing. The file belongs to whom the
/// folder belongs, so that root can add keys of a service of another user.
/// Errors: those of `change`, after which nothing is written; kIo, kResourceExhausted.
Status ChangeKeys(const std::filesystem::path& file,
                  const std::function<Status(std::vector<ApiKey>& keys)>& change);

}  // namespace farhorizon
