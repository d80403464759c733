#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's own
class App;
}

namespace farhorizon {

/// The command that the command line names; returns the exit status. Set while CLI11 parses.
using SelectedCommand = std::function<int()>;

/// An argument of a command, for the parser and for help.
struct Argument {
  std::string names;  ///< "-o,--output"; a name without dashes is positional
  const char* type;   ///< how help calls the value
  std::string help;
  bool required = false;
};

/// A command of the program, or the program itself, that arguments are added to: a handle on
/// CLI11's. A file that includes CLI11 takes seven seconds more to compile, so only this header's
/// body and run.cpp do.
/// Requires: CLI11's object, and what the values are written to, outlive the parse.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  /// A command of this one, of which the command line then has to name one.
  [[nodiscard]] Command AddCommand(const char* name, const char* help);

  void Add(const Argument& argument, std::string& value);
  /// Calls `take` with the value.
  void Add(const Argument& argument, const std::function<void(const std::string&)>& take);
  void Add(const Argument& argument, double& value);
  void Add(const Argument& argument, std::optional<double>& value);
  /// A number from `least` to `greatest`, which help says.
  void Add(const Argument& argument, double& value, double least, double greatest);
  void Add(const Argument& argument, int& value, int least, int greatest);
  /// One of `choices`. The argument's help names them.
  void AddChoice(const Argument& argument, std::string& value, std::vector<std::string> choices);
  /// An argument that may be given more than once. Calls `take` with all its values.
  void AddList(const Argument& argument,
               const std::function<void(const std::vector<std::string>&)>& take);
  /// An argument without a value.
  void AddSwitch(const char* names, const char* help, bool& value);
  void AddSwitch(const char* names, const char* help, std::function<void()> take);

  /// What stands below the arguments in help.
  void SetFooter(const std::string& text);
  /// Leaves the command out of help.
  void Hide();
  /// Sets `selected` to `run` where the command line names this command.
  void Select(SelectedCommand& selected, std::function<int()> run);

 private:
  CLI::App* app_;
};

}  // namespace farhorizon
