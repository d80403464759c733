#include "core/base/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace farhorizon {

bool ParallelForBatches(std::size_t count, std::size_t size, int threads, Stage stage,
                        const RunControl& control,
                        const std::function<void(std::size_t, std::size_t, std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  const auto run = [&](std::size_t thread) {
    while (!control.StopRequested()) {
      const std::size_t begin = next.fetch_add(size);
      if (begin >= count) return;
      const std::size_t end = std::min(begin + size, count);
      work(begin, end, thread);
      if (thread == 0) control.Report(stage, static_cast<double>(end) / static_cast<double>(count));
    }
  };
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(std::max(threads, 1)));
  {
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < failures.size(); ++i) {
      helpers.emplace_back([i, &run, &failures] {
        try {
          run(i);
        } catch (...) {
          failures[i] = std::current_exception();
        }
      });
    }
    run(0);
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  if (control.StopRequested()) return false;
  control.Report(stage, 1);
  return true;
}

}  // namespace farhorizon
