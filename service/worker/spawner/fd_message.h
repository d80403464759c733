#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/io/unique_fd.h"

namespace farhorizon {

/// A message of the sequenced-packet socket between the service and its spawner.
struct FdMessage {
  std::string text;
  std::vector<UniqueFd> descriptors;
};

constexpr std::size_t kLongestFdMessage = std::size_t{1} << 16U;
constexpr std::size_t kMostDescriptors = 4;

/// Sends `text`, not empty, with copies of `descriptors`. False where the other end is gone.
bool SendFds(int socket, std::string_view text, const std::vector<int>& descriptors);
/// Waits for a message. Its text is empty where the other end is gone.
FdMessage ReceiveFds(int socket);

}  // namespace farhorizon
