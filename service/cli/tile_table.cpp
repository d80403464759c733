#include "service/cli/tile_table.h"

#include <array>
#include <fstream>
#include <sstream>

#include "core/io/file.h"

namespace farhorizon {

namespace {

constexpr const char* kColumns = "dem\tjob\tstatus\tcode\tdetail\tkey";
// A lost second of the table costs nothing: the idempotency keys are in no file.
constexpr std::chrono::seconds kInterval{1};

std::string Cell(std::string text) {
  for (char& c : text) {
    if (c == '\t' || c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

}  // namespace

std::map<std::string, TileRow> TileTable::Read(const std::filesystem::path& file) {
  std::map<std::string, TileRow> rows;
  std::ifstream lines(file);
  std::string line;
  if (!std::getline(lines, line) || line != kColumns) return rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    TileRow row;
    for (std::string* cell : {&row.dem, &row.job, &row.status, &row.code, &row.detail, &row.key}) {
      std::getline(cells, *cell, '\t');
    }
    rows[row.dem] = row;
  }
  return rows;
}

Status TileTable::Set(std::size_t index, TileRow row) {
  rows_.at(index) = std::move(row);
  const auto now = std::chrono::steady_clock::now();
  if (now - written_ < kInterval) return Ok{};
  written_ = now;
  return Write();
}

Status TileTable::Write() const {
  std::string text = std::string(kColumns) + "\n";
  for (const TileRow& row : rows_) {
    for (const std::string* cell : {&row.dem, &row.job, &row.status, &row.code, &row.detail}) {
      text += Cell(*cell) + "\t";
    }
    text += row.key + "\n";
  }
  return WriteFile(file_, text);
}

}  // namespace farhorizon
