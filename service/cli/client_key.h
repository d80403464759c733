#pragma once

#include <string>

#include "core/base/result.h"
#include "service/http/client.h"

namespace farhorizon {

/// The key that a client sends to the service at `url`: the one in `file`, or where that is empty
/// the one in FARHORIZON_KEY; empty without one. Never one of the command line, which every user of
/// the machine can read. Says on standard error where the key is going to travel in clear.
/// Errors: kInvalidArgument, kNotFound where there is no key; none of the messages has it.
Result<std::string> ReadClientKey(const std::string& file, const ServiceUrl& url);

}  // namespace farhorizon
