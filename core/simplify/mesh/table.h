#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace farhorizon {

/// A vector whose indices are the ids of vertices, half-edges, triangles or lines.
template <typename Value>
class Table {
 public:
  Table() = default;
  explicit Table(std::int32_t size, Value value = {})
      : values_(static_cast<std::size_t>(size), value) {}

  Value& operator[](std::int32_t id) { return values_[static_cast<std::size_t>(id)]; }
  const Value& operator[](std::int32_t id) const { return values_[static_cast<std::size_t>(id)]; }
  [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(values_.size()); }
  void resize(std::int32_t size, Value value = {}) {
    values_.resize(static_cast<std::size_t>(size), value);
  }
  void assign(std::int32_t size, Value value) {
    values_.assign(static_cast<std::size_t>(size), value);
  }
  void reserve(std::int64_t size) { values_.reserve(static_cast<std::size_t>(size)); }
  void shrink_to_fit() { values_.shrink_to_fit(); }
  void push_back(Value value) { values_.push_back(std::move(value)); }
  [[nodiscard]] auto begin() { return values_.begin(); }
  [[nodiscard]] auto end() { return values_.end(); }
  [[nodiscard]] auto begin() const { return values_.begin(); }
  [[nodiscard]] auto end() const { return values_.end(); }

 private:
  std::vector<Value> values_;
};

}  // namespace farhorizon
