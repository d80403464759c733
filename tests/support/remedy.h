#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace farhorizon {

/// Runs the remedy that `message` names, from the name of `program` to OUT, on the file `in`.
/// Throws std::runtime_error where the message has none or the program fails.
inline void RunRemedy(const std::string& message, const std::string& program,
                      const std::filesystem::path& in, const std::filesystem::path& out) {
  const std::size_t begin = message.find(program + " ");
  if (begin == std::string::npos) throw std::runtime_error("no " + program + " in: " + message);
  std::size_t end = message.find_first_of(";,", begin);
  // Commas stand in expressions, too, but not after the last quotation mark.
  for (std::size_t quote = message.find('"', begin); quote != std::string::npos && quote < end;
       quote = message.find('"', quote + 1)) {
    quote = message.find('"', quote + 1);
    end = message.find_first_of(";, ", quote);
  }
  std::string command = message.substr(begin, end - begin);
  const auto replace = [&command](const std::string& word, const std::string& with) {
    const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
    for (std::size_t at = command.find(word); at != std::string::npos;
         at = command.find(word, at + 1)) {
      const std::size_t after = at + word.size();
      if (is_letter(command[at - 1]) || (after < command.size() && is_letter(command[after]))) {
        continue;
      }
      command.replace(at, word.size(), with);
      at += with.size() - 1;
    }
  };
  replace("OUT", out.string());
  replace("IN", in.string());
  command += " > " + out.string() + ".log 2>&1";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
}

}  // namespace farhorizon
