#pragma once

#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "service/handlers/handler_context.h"
#include "service/jobs/callback.h"

namespace farhorizon {

/// The member `subscriber` of an execute request: URLs as texts, of which successUri has to be
/// there, each one that may be called; nobody without the member.
/// Errors: kInvalidArgument "invalid-parameter", "callback-not-allowed".
Result<Subscriber> ReadSubscriber(const HandlerContext& context, const nlohmann::json& request);

}  // namespace farhorizon
