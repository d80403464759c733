#include "core/geo/proj_session.h"

#include <proj.h>

#include "core/geo/reference_data.h"

namespace farhorizon {

void ProjDelete::operator()(pj_ctx* context) const { proj_context_destroy(context); }
void ProjDelete::operator()(PJconsts* object) const { proj_destroy(object); }

ProjSession::ProjSession() : context_(proj_context_create()) {
  SealContext(get());
  proj_log_level(get(), PJ_LOG_ERROR);
  proj_log_func(get(), &complaint_, [](void* data, int, const char* message) {
    *static_cast<std::string*>(data) = message;
  });
}

std::string ProjSession::Complaint() const {
  return complaint_.empty() ? "" : " (PROJ: " + complaint_ + ")";
}

}  // namespace farhorizon
