#pragma once

#include <cstddef>
#include <functional>

#include "core/base/run_control.h"

namespace farhorizon {

/// The usual size of a batch. Any size is sound: smaller batches share the work more evenly, larger
/// ones are taken less often.
inline constexpr std::size_t kBatch = 256;

/// Calls work(begin, end, thread) for each batch of `size` successive numbers below `count`.
///
/// The batches are shared by `threads` threads, one of which is the caller's; each takes the next
/// one when it has finished the last. The batches are the same for any number of threads. thread: a
/// number below max(threads, 1), for results that each thread collects by itself. Returns false if
/// the control requested a stop; some batches have then not been worked on.
/// Requires: calls of `work` for different batches do not write to the same things.
/// Errors: an exception that `work` throws is thrown here, after all threads have ended.
bool ParallelForBatches(
    std::size_t count, std::size_t size, int threads, Stage stage, const RunControl& control,
    const std::function<void(std::size_t begin, std::size_t end, std::size_t thread)>& work);

}  // namespace farhorizon
