#include "service/cli/tile_list.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <string_view>
#include <system_error>

#include "service/handlers/http_message.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 12> kEndings = {".tif", ".tiff", ".asc",     ".grd",
                                                       ".xyz", ".hgt",  ".hgt.zip", ".dt0",
                                                       ".dt1", ".dt2",  ".dem",     ".img"};

bool IsOfADem(const std::string& file) {
  const std::string name = LowerCase(file);
  return name.front() != '.' && std::any_of(kEndings.begin(), kEndings.end(),
                                            [&](auto ending) { return name.ends_with(ending); });
}

// A folder of tiles has other files, too; but who expects one to be sent is told that it is not.
void SayWhatIsLeftOut(const std::string& folder, int files, int folders) {
  if (files + folders == 0) return;
  std::string endings;
  for (const std::string_view ending : kEndings) endings.append(" ").append(ending);
  std::fprintf(stderr,
               "farhorizon: of the folder %s, %d files and %d folders are left out: DEMs are taken "
               "to end in%s; name others themselves, or in --list\n",
               folder.c_str(), files, folders, endings.c_str());
}

Status AddFolder(const std::string& folder, std::vector<std::string>& tiles) {
  std::error_code failure;
  std::vector<std::string> found;
  int files = 0;
  int folders = 0;
  for (const auto& entry : fs::directory_iterator(folder, failure)) {
    std::error_code none;
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file(none) && IsOfADem(name)) {
      found.push_back(entry.path().string());
    } else if (name.front() != '.') {
      ++(entry.is_directory(none) ? folders : files);
    }
  }
  SayWhatIsLeftOut(folder, files, folders);
  if (failure) return Error{ErrorCode::kIo, "cannot read " + folder + ": " + failure.message()};
  std::sort(found.begin(), found.end());
  tiles.insert(tiles.end(), found.begin(), found.end());
  return Ok{};
}

void AddLines(std::istream& lines, std::vector<std::string>& tiles) {
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty() && line.front() != '#') tiles.push_back(line);
  }
}

}  // namespace

Result<std::vector<std::string>> ReadTileList(const std::vector<std::string>& words,
                                              const std::string& list) {
  std::vector<std::string> tiles;
  std::error_code failure;
  for (const std::string& word : words) {
    if (!fs::is_directory(word, failure)) {
      tiles.push_back(word);
    } else if (Status added = AddFolder(word, tiles); !added) {
      return std::move(added.error());
    }
  }
  if (list == "-") {
    AddLines(std::cin, tiles);
  } else if (!list.empty()) {
    std::ifstream file(list);
    if (!file) return Error{ErrorCode::kNotFound, "cannot read the list " + list};
    AddLines(file, tiles);
  }
  if (tiles.empty()) return Error{ErrorCode::kInvalidArgument, "there is no DEM to send"};
  std::set<std::string> names;
  for (const std::string& tile : tiles) {
    const std::string name = fs::path(tile).filename().string();
    if (names.insert(name).second) continue;
    return Error{ErrorCode::kInvalidArgument,
                 "two of the DEMs are called " + name +
                     ", and the artifacts of each go to a folder of its name; send them apart"};
  }
  return tiles;
}

}  // namespace farhorizon
