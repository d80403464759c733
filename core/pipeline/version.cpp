#include "core/pipeline/version.h"

namespace farhorizon {

const char* Version() { return FARHORIZON_VERSION; }

}  // namespace farhorizon
