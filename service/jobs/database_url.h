#pragma once

#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// Succeeds for what libpq understands. Errors: kInvalidArgument "invalid-config", with its words,
/// without a password.
Status CheckDatabaseUrl(const std::string& url);

/// A connection URI or string of libpq without what may be a password: for people to read. Of one
/// that libpq would not understand it leaves out more, never less.
std::string WithoutPassword(const std::string& url);

/// What libpq says of a connection to `url`, without the password or pieces of it.
std::string WithoutPassword(const std::string& message, const std::string& url);

}  // namespace farhorizon
