#include "service/text_list.h"

#include <algorithm>

namespace farhorizon {

std::vector<std::string> CommaList(std::string_view text) {
  std::vector<std::string> list;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view entry = text.substr(0, comma);
    const std::size_t first = entry.find_first_not_of(" \t");
    if (first != std::string_view::npos) {
      list.emplace_back(entry.substr(first, entry.find_last_not_of(" \t") - first + 1));
    }
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return list;
}

}  // namespace farhorizon
