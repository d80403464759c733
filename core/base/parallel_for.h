#pragma once

#include <cstddef>
#include <functional>

#include "core/base/progress.h"

namespace farhorizon {

/// Calls work(begin, end, thread) for batches of `size` of the numbers below `count`, on `threads` threads, this one
/// among them, which take the batches in turn; work on different numbers must not touch the same things.
/// thread: below max(threads, 1), for sums that each thread keeps by itself.
/// False where the watch said stop; then not all of it is done. What work throws is thrown here.
/// The batches are the same for any number of threads.
inline constexpr std::size_t kBatch = 256;
bool ParallelForBatches(
    std::size_t count, std::size_t size, int threads, Stage stage, const Watch& watch,
    const std::function<void(std::size_t begin, std::size_t end, std::size_t thread)>& work);

}  // namespace farhorizon
