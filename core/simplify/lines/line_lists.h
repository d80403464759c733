#pragma once

#include <cstdint>
#include <vector>

#include "core/simplify/mesh/table.h"

namespace farhorizon {

/// A list of lines for each vertex, in one pool of linked nodes.
/// Memory: 4 bytes a vertex, 8 a node; nodes that are erased are used again.
class LineLists {
 public:
  explicit LineLists(std::int32_t vertices) : first_(vertices, kEnd) {}

  void Add(std::int32_t vertex, std::int32_t line) {
    std::int32_t node = free_;
    if (node == kEnd) {
      node = nodes_.size();
      nodes_.push_back({});
    } else {
      free_ = nodes_[node].next;
    }
    nodes_[node] = {line, first_[vertex]};
    first_[vertex] = node;
  }
  /// Erases the lines for which drop(line) holds; the others stay in order.
  template <typename Drop>
  void EraseIf(std::int32_t vertex, Drop drop) {
    std::int32_t* at = &first_[vertex];
    while (*at != kEnd) {
      const std::int32_t node = *at;
      if (drop(nodes_[node].line)) {
        *at = nodes_[node].next;
        nodes_[node].next = free_;
        free_ = node;
      } else {
        at = &nodes_[node].next;
      }
    }
  }
  /// Requires: `visit` adds to no list.
  template <typename Visit>
  void ForEach(std::int32_t vertex, Visit visit) const {
    for (std::int32_t n = first_[vertex]; n != kEnd; n = nodes_[n].next) visit(nodes_[n].line);
  }
  /// Empties the vertex's list into `lines`.
  void Take(std::int32_t vertex, std::vector<std::int32_t>& lines) {
    lines.clear();
    EraseIf(vertex, [&](std::int32_t line) {
      lines.push_back(line);
      return true;
    });
  }

 private:
  static constexpr std::int32_t kEnd = -1;
  struct Node {
    std::int32_t line;
    std::int32_t next;
  };

  Table<std::int32_t> first_;  // per vertex
  Table<Node> nodes_;
  std::int32_t free_ = kEnd;
};

}  // namespace farhorizon
